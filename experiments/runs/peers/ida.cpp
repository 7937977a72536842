// SUNDIALS IDA, variable-order BDF for F(t, y, y') = 0 with y = (u, v, x, z): the rows are u' - v and the residual
// with a = v', k = x'. As its manual recommends: a dense solver with the exact Jacobian dF/dy + cj dF/dy', rtol and a
// vector of atol, no step beyond the end; multipliers and unknowns of index 2 are excluded from the error test.
//
// They are excluded from Newton's test, too: their increments are those of v divided by h, which never fall below the
// tolerance when h is small (Petzold & Loetstedt, SIAM J. Sci. Stat. Comput. 7, 1986). In exchange Newton's tolerance
// is tightened. (With the defaults IDA fails at the first step of slider_crank_flexible at rtol = 1e-8, and needs six
// times the steps for the pendulum in index 1.) The suite makes the start consistent; IDACalcIC can do so for index 1
// only. Hindmarsh et al., ACM TOMS 31 (2005).
#include <ida/ida.h>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/sundials.h"

namespace irk {
namespace {

using sundials::kTrySmallerStep;

// Limits of Newton's method; IDA's defaults are 0.33 of the tolerance and 4 iterations.
constexpr double kNewtonTolerance = 0.0033;
constexpr int kNewtonIterations = 8;
// An absolute tolerance so large that the component passes every test.
constexpr double kNoTest = 1e100;

struct IdaApi {
  IRK_SUNDIALS_API(IDA)
};

class Ida final : public Peer {
 public:
  explicit Ida(const PeerSetup& setup)
      : system_(setup.system),
        sizes_(system_.sizes()),
        derivatives_(setup.derivatives),
        differentiator_(system_, derivatives_),
        D_(Pattern::dense(sizes_.n())),
        d_(sizes_.discrete),
        workspace_(sizes_.components()),
        yp_(workspace_.add(Vec<double>::Zero(sizes_.components()))) {
    void* const memory = IDACreate(workspace_.context());
    IRK_SUNDIALS(IDAInit(memory, residual, 0, workspace_.y(), yp_));
    Vec<double> atol = setup.atol;
    if (excludeAlgebraic(setup.determined, atol)) {
      IRK_SUNDIALS(IDASetNonlinConvCoef(memory, kNewtonTolerance));
      IRK_SUNDIALS(IDASetMaxNonlinIters(memory, kNewtonIterations));
    }
    solver_.setUp(memory, setup, workspace_.add(atol), workspace_, this, jacobian, roots);
  }

  StartReport start(State<double>& state, double t_end, StartCheck check) override {
    const StartReport report = ConsistentStart<double>(system_, derivatives_, true).apply(state, check);
    if (report.outcome != Outcome::kSuccess) return report;
    VecView<double> y(workspace_.values(), sizes_.components());
    VecView<double> yp(N_VGetArrayPointer(yp_), sizes_.components());
    y << state.u, state.v, state.x, state.z();
    yp << state.v, state.a(), state.k(), Vec<double>::Zero(sizes_.nz);
    d_ = state.d;
    residual_count_ = jacobian_count_ = 0;
    IRK_SUNDIALS(IDAReInit(solver_.memory(), state.t, workspace_.y(), yp_));
    solver_.begin(t_end);
    return {};
  }

  Outcome step(State<double>& state) override {
    const int flag = IDASolve(solver_.memory(), solver_.end(), &state.t, workspace_.y(), yp_, sundials::kOneStep);
    if (flag >= 0) {
      const auto p = point(state.t, workspace_.y(), yp_);
      state.u = p.u;
      state.v = p.v;
      state.x = p.x;
      state.w << p.a, p.k, p.z;
    }
    return solver_.finish(flag);
  }

  bool foundRoot(Index i) const override { return solver_.foundRoot(i); }
  void setDiscrete(const Vec<double>& d) override { d_ = d; }
  void count(Counters& counters) const override {
    counters.residuals += residual_count_;
    counters.jacobians += jacobian_count_;
    solver_.count(counters);
  }
  std::string message() const override { return workspace_.message(); }

 private:
  Point<double> point(double t, N_Vector y, N_Vector yp) const {
    const double* const at = N_VGetArrayPointer(y);
    const double* const rate = N_VGetArrayPointer(yp);
    const Index nu = sizes_.nu, nx = sizes_.nx;
    return {t,
            {at, nu},
            {at + nu, nu},
            {at + 2 * nu, nx},
            {rate + nu, nu},
            {rate + 2 * nu, nx},
            {at + 2 * nu + nx, sizes_.nz},
            {d_.data(), d_.size()}};
  }

  // Excludes multipliers and unknowns of index 2 from the norm. Returns whether there are any.
  bool excludeAlgebraic(bool determined, Vec<double>& atol) const {
    bool any = false;
    for (Index i = 0; i < sizes_.nz; ++i) {
      const int power = system_.errorPowers().z[static_cast<std::size_t>(i)];
      const bool index2 = !determined || power > 0;
      if (!index2 && i >= sizes_.constraints) continue;
      atol[sizes_.components() - sizes_.nz + i] = kNoTest;
      any = true;
    }
    return any;
  }

  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
    auto& ida = *static_cast<Ida*>(self);
    ++ida.residual_count_;
    const Index nu = ida.sizes_.nu, n = ida.sizes_.n();
    double* const rows = N_VGetArrayPointer(r);
    VecView<double>(rows, nu) =
        ConstVec<double>(N_VGetArrayPointer(yp), nu) - ConstVec<double>(N_VGetArrayPointer(y) + nu, nu);
    VecView<double> rest(rows + nu, n);
    ida.system_.evaluate(Level::kFormulated, ida.point(t, y, yp), rest);
    return rest.allFinite() ? 0 : kTrySmallerStep;
  }

  // Columns u, v, x, z of the rows u' - v and r: dr/du = D2, dr/d(v, x) = D1 + cj D0, dr/dz = D0.
  static int jacobian(double t, double cj, N_Vector y, N_Vector yp, N_Vector, SUNMatrix J, void* self, N_Vector,
                      N_Vector, N_Vector) {
    auto& ida = *static_cast<Ida*>(self);
    ++ida.jacobian_count_;
    const Index nu = ida.sizes_.nu, nx = ida.sizes_.nx, nz = ida.sizes_.nz, n = ida.sizes_.n();
    ida.differentiator_.evaluate(Level::kFormulated, ida.point(t, y, yp), ida.D_);
    Eigen::Map<Mat<double>> all(SUNDenseMatrix_Data(J), nu + n, nu + n);
    all.topRows(nu).setZero();
    all.topLeftCorner(nu, nu).diagonal().setConstant(cj);
    all.block(0, nu, nu, nu).diagonal().setConstant(-1);
    auto r = all.bottomRows(n);
    r.leftCols(nu) = ida.D_.dense2().leftCols(nu);
    r.middleCols(nu, nu + nx) = ida.D_.dense1().leftCols(nu + nx) + cj * ida.D_.dense0().leftCols(nu + nx);
    r.rightCols(nz) = ida.D_.dense0().rightCols(nz);
    return r.allFinite() ? 0 : kTrySmallerStep;
  }

  static int roots(double t, N_Vector y, N_Vector yp, double* g, void* self) {
    const auto& ida = *static_cast<Ida*>(self);
    ida.system_.switching(ida.point(t, y, yp), {g, ida.sizes_.switches});
    return 0;
  }

  const System<double>& system_;
  Sizes sizes_;
  DerivativeSource derivatives_;
  Differentiator<double> differentiator_;
  Linearization<double> D_;
  Vec<double> d_;
  sundials::Workspace workspace_;
  N_Vector yp_;
  sundials::Solver<IdaApi> solver_;
  std::int64_t residual_count_ = 0, jacobian_count_ = 0;
};

}  // namespace

std::unique_ptr<Peer> makeIda(const PeerSetup& setup) { return std::make_unique<Ida>(setup); }

}  // namespace irk
