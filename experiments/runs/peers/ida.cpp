// SUNDIALS IDA, variable-order BDF for F(t, y, y') = 0 with y = (u, v, x, z): the rows are u' - v and the residual
// with a = v', k = x'. As its manual recommends: the exact Jacobian dF/dy + cj dF/dy', dense, banded or with KLU
// depending on its pattern, rtol and a vector of atol, no step beyond the end; multipliers and unknowns of index 2 are
// excluded from the error test.
//
// They are excluded from Newton's test, too: their increments are those of v divided by h, which never fall below the
// tolerance when h is small (Petzold & Loetstedt, SIAM J. Sci. Stat. Comput. 7, 1986). In exchange Newton's tolerance
// is tightened. (With the defaults IDA fails at the first step of slider_crank_flexible at rtol = 1e-8, and needs six
// times the steps for the pendulum in index 1.) The suite makes the start consistent; IDACalcIC can do so for index 1
// only. Hindmarsh et al., ACM TOMS 31 (2005).
#include <ida/ida.h>

#include <algorithm>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/sundials.h"

namespace irk {
namespace {

using sundials::statusOf;

// Limits of Newton's method; IDA's defaults are 0.33 of the tolerance and 4 iterations.
constexpr double kNewtonTolerance = 0.0033;
constexpr int kIdaIterations = 8;
// An absolute tolerance so large that the component passes every test.
constexpr double kNoTest = 1e100;

struct IdaApi {
  IRK_SUNDIALS_API(IDA, IDALsJacFn, IDARootFn)
};

// Excludes multipliers and unknowns of index 2 from the norm. Returns whether there are any.
bool excludeAlgebraic(const PeerLayout& layout, Vec<double>& atol) {
  bool any = false;
  for (std::size_t i = 0; i < layout.unknowns.size(); ++i) {
    const auto unknown = layout.unknowns[i];
    const bool index2 = unknown != PeerUnknown::kDifferential && layout.index[i] > 1;
    if (!index2 && unknown != PeerUnknown::kMultiplier) continue;
    atol[static_cast<Index>(i)] = kNoTest;
    any = true;
  }
  return any;
}

PeerSetup withoutAlgebraic(PeerSetup setup) {
  excludeAlgebraic(setup.problem.layout(), setup.atol);
  return setup;
}

class Ida final : public Peer {
 public:
  explicit Ida(const PeerSetup& setup)
      : problem_(setup.problem),
        n_(problem_.layout().n),
        solver_(withoutAlgebraic(setup), this, jacobian, roots),
        yp_(solver_.workspace().add(Vec<double>::Zero(n_))) {}

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    const N_Vector y = solver_.workspace().y();
    std::copy_n(start.y, n_, N_VGetArrayPointer(y));
    std::copy_n(start.yp, n_, N_VGetArrayPointer(yp_));
    if (!solver_.memory()) create(start.t);
    return solver_.run(
        start.t, t_end, accepted, [&](double t) { return IDAReInit(solver_.memory(), t, y, yp_); },
        [&](double* t) { return IDASolve(solver_.memory(), t_end, t, y, yp_, sundials::kOneStep); },
        [&](double t) {
          return PeerStep{t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp_)};
        });
  }

  void count(Counters& counters) const override { solver_.count(counters); }
  std::string message() const override { return solver_.workspace().message(); }

 private:
  void create(double t) {
    auto& workspace = solver_.workspace();
    void* const memory = IDACreate(workspace.context());
    IRK_SUNDIALS(IDAInit(memory, residual, t, workspace.y(), yp_));
    solver_.own(memory);
    Vec<double> atol = Vec<double>::Zero(n_);
    if (!excludeAlgebraic(problem_.layout(), atol)) return;
    IRK_SUNDIALS(IDASetNonlinConvCoef(memory, kNewtonTolerance));
    IRK_SUNDIALS(IDASetMaxNonlinIters(memory, kIdaIterations));
  }

  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
    auto& problem = static_cast<Ida*>(self)->problem_;
    return statusOf(problem.residual(t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), N_VGetArrayPointer(r)));
  }
  static int jacobian(double t, double cj, N_Vector y, N_Vector yp, N_Vector, SUNMatrix to, void* self, N_Vector,
                      N_Vector, N_Vector) {
    auto& ida = *static_cast<Ida*>(self);
    return ida.solver_.fill(to, [&](PeerJacobian& J) {
      return ida.problem_.jacobian(t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), cj, J);
    });
  }
  static int roots(double t, N_Vector y, N_Vector yp, double* g, void* self) {
    auto& problem = static_cast<Ida*>(self)->problem_;
    problem.switching(t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), g);
    return sundials::statusOfRoots(t, g, problem.layout().switches);
  }

  PeerProblem& problem_;
  Index n_;
  sundials::Solver<IdaApi> solver_;
  N_Vector yp_;
};

}  // namespace

std::unique_ptr<Peer> makeIda(const PeerSetup& setup) { return std::make_unique<Ida>(setup); }

}  // namespace irk
