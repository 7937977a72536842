// The error estimate by embedded weights of the method's own tableau.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/small_product.h"
#include "core/estimates/embedded.h"
#include "core/estimates/step_attempt.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

/// The step's result minus that of the weights b_hat in the same stages, for y' = f(t, y) and w = (a, k):
///   e = h sum_i (b_hat_i - b_i) f_i,  e_v and e_x alike,  e_u = h^2 sum_j (A^T (b_hat - b))_j a_j,  since sum b_hat
///   = 1.
/// For stiff components e is far above the step's error, and without bound where A has an explicit first stage. It is
/// filtered as in HW II (IV.8.20), by (I - h mu J)^-1 with mu as in EmbeddedEstimate; for the residual r that is
///   (D0 + h mu D1 + h^2 mu^2 D2) w = D0 (e_v, e_x, 0) / (h mu) - D2 e_u,
///   E_v = h mu w_v, E_x = h mu w_x, E_u = e_u + h mu E_v: the filtered errors.
/// The right-hand side is the change of r from the step's start to (u0 - e_u, v0, x0; w0 + (e_v, e_x, 0) / (h mu)). It
/// leaves out g of index 3, as EmbeddedEstimate does. z does not count: the weights say nothing of it.
template <class Real>
class TableauWeights final : public StepAttempt<Real> {
 public:
  explicit TableauWeights(const StepAttemptSetup<Real>& setup)
      : TableauWeights(setup, setup.scheme(), setup.system.sizes()) {}

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override {
    AttemptResult result{stepper_.attempt(stepper_.stages(), from, h, to), 0};
    if (result.outcome != Outcome::kSuccess) return result;
    result.outcome = estimate(from, h);
    if (result.outcome != Outcome::kSuccess) return result;
    result.error = norm_.magnitude(error_, static_cast<double>(h));
    if (!std::isfinite(result.error)) result.outcome = Outcome::kNotFinite;
    result.error = worse(result.error, order_, result.mode_error, 1);
    return result;
  }
  void forget() override { stepper_.forget(); }
  int order() const override { return order_; }
  Index worstComponent() const override { return norm_.worst(error_, zero_, 1, ones_); }
  StepPieces<Real> pieces(const State<Real>& from) const override {
    return {{{{&from, &stepper_.stages()}, {nullptr, nullptr}}}, 1};
  }

 private:
  TableauWeights(const StepAttemptSetup<Real>& setup, const Scheme<Real>& scheme, const Sizes& sizes)
      : system_(setup.system),
        norm_(setup.norm),
        sizes_(sizes),
        order_(std::min(scheme.tableau.order, scheme.tableau.order_hat)),
        mu_(filterWeight(scheme)),
        stepper_(setup.system, scheme, setup.options, setup.jacobian, setup.norm, setup.counters),
        own_(setup.jacobian, setup.options.solver,
             {Mat<Real>::Constant(1, 1, mu_), nullptr, setup.system.rowPowers(), sizes}, setup.counters,
             SolverOf::kFilter),
        once_(scheme.tableau.b_hat - scheme.b),
        twice_(scheme.A_transposed * once_),
        scales_(sizes.n()),
        rates_(sizes.n()),
        r_(sizes.n()),
        e_(sizes.n(), 1),
        at_(sizes),
        error_(sizes),
        zero_(sizes),
        ones_(Vec<double>::Ones(sizes.components())) {}

  // mu of the implicit stages only; an explicit first stage is left out.
  static Real filterWeight(const Scheme<Real>& scheme) {
    Tableau<Real> implicit = scheme.tableau;
    implicit.A = scheme.implicitA();
    implicit.b = scheme.b.tail(scheme.implicitStages()).eval();
    return EmbeddedEstimate<Real>::weight(implicit);
  }

  // Sets r_ to the residual at `state`, with scaled rows.
  void evaluate(const State<Real>& state) {
    system_.evaluate(Level::kFormulated, pointOf(state), VecView<Real>(r_.data(), r_.size()));
    r_.array() *= scales_.array();
  }

  // Sets error_ for the solved step.
  Outcome estimate(const State<Real>& from, const Real& h) {
    const Index nu = sizes_.nu, nx = sizes_.nx, n = sizes_.n();
    const Real* const W = stepper_.stages().W.data();
    const Real step = h * mu_;
    rowScales(system_.rowPowers(), h, scales_);
    inlinedProduct(W, n, n, once_, rates_.data(), n);
    inlinedProduct(W, n, nu, twice_, error_.u.data(), nu);
    error_.u *= h * h;
    at_ = from;
    evaluate(at_);
    e_.col(0) = -r_;
    at_.u -= error_.u;
    at_.w.head(nu + nx) += rates_.head(nu + nx) / mu_;
    evaluate(at_);
    e_.col(0) += r_;
    for (Index i = 0; i < sizes_.nz; ++i) {
      if (system_.errorPowers().z[static_cast<std::size_t>(i)] == 2) e_(nu + nx + i, 0) = Real(0);
    }
    if (!e_.allFinite()) return Outcome::kNotFinite;
    if (!stepper_.matrix().solveReal(h, mu_, e_.data())) {
      const Outcome outcome = own_.prepare(h);
      if (outcome != Outcome::kSuccess) return outcome;
      own_.solve(e_);
    }
    error_.v = step * e_.col(0).head(nu);
    error_.u += step * error_.v;
    error_.x = step * e_.col(0).segment(nu, nx);
    return Outcome::kSuccess;
  }

  const System<Real>& system_;
  const ErrorNorm<Real>& norm_;
  Sizes sizes_;
  int order_;
  Real mu_;
  Stepper<Real> stepper_;
  NewtonMatrix<Real> own_;        // used where the stages' solver does not have the factors
  Vec<Real> once_, twice_;        // s: b_hat - b, and A^T (b_hat - b)
  Vec<Real> scales_, rates_, r_;  // n
  Mat<Real> e_;                   // n x 1
  State<Real> at_, error_, zero_;
  Vec<double> ones_;
};

}  // namespace

Strategy<ErrorEstimate> tableauEstimate() {
  return {.id = {{"tableau"}},
          .meaning = "embedded weights b_hat of a tableau file, filtered by one real solve, HW II (IV.8.20)",
          .needs = {.kept_jacobian = true, .embedded_weights = true, .instead = "estimate 'richardson'"},
          .looks_further = true,
          .make = makes<StepAttemptMaker, TableauWeights>()};
}

}  // namespace irk
