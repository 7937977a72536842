// Newton methods that stop on the increment: simplified Newton, and with Broyden's updates.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/newton/evidence.h"
#include "core/newton/newton.h"
#include "core/newton/newton_base.h"
#include "core/options/fixed_steps.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

// x^n by squaring, n >= 0.
double power(double x, int n) {
  double result = 1;
  for (; n > 0; n /= 2, x *= x) {
    if (n % 2 == 1) result *= x;
  }
  return result;
}

// Broyden's updates cost dot products. If the last step contracted better than this, its iterations are too few for
// them.
constexpr double kWorthUpdates = 0.1;
// With fewer unknowns the updates cost more than an iteration (van_der_pol: a tenth of the run).
constexpr Index kUpdatesFrom = 3;

// theta before any step has shown one: assumes no contraction.
constexpr double kUnknownTheta = 1;

/// HW II (IV.8): simplified Newton with the increment test
///   eta |dw| <= kappa,  eta = theta / (1 - theta),  theta = |dw_m| / |dw_{m-1}|.
/// In the first iteration theta is unknown; the last step's eta, raised to 0.8, takes its place if the increment is
/// below the tolerance. Later increments must be as small (kTrustedIncrement). Nor does an
/// adaptive step end unless its residual has fallen (ResidualEvidence). With Broyden's updates the reported theta is
/// the first one, that of the matrix itself.
///
/// The first theta shows how fast the error of the start values decays. That error need not contain the components that
/// the matrix solves worst; they show from the third increment on. Where kappa is limited by round-off (tight
/// tolerances, fixed steps), the theta of the last step's last increment therefore counts as well, because the
/// remaining error of the stage equations has the same sign in many steps and no error estimate shows it. Until a step
/// has had a third increment, no step ends after the second.
template <class Real>
class SimplifiedNewton : public NewtonBase<Real> {
  using Base = NewtonBase<Real>;

 public:
  SimplifiedNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : Base(options, sizes, scheme),
        limit_(incrementLimit<Real>(options)),
        adaptive_(!hasFixedSteps(options.step)),
        evidence_(sizes) {}

  NewtonResult solve(NewtonContext<Real>& c, Mat<Real>& W) override {
    auto& shared = c.matrix.shared();
    this->refresh(c, W);
    const bool had_old = !shared.evaluatedAt(c.eq.from().t);
    this->begin(c, W);
    const Patience patience = adaptive_ ? Patience::kNone : Patience::kToTheLimit;
    NewtonResult result = iterate(c, W, had_old ? Patience::kNone : patience);
    if (result.outcome != Outcome::kSuccess && had_old) {
      ++c.counters.newton_restarts;
      W = this->W0_;
      shared.evaluate(c.eq, W);
      const int before = result.iterations;
      result = iterate(c, W, patience);
      result.iterations += before;
    }
    const double keep_below = shared.keepBelow(this->options_.newton.keep_jacobian_below);
    if (result.outcome != Outcome::kSuccess || result.theta > keep_below) shared.markStale();
    return result;
  }
  void forget() override {
    eta_ = theta_ = 1;
    slowest_ = kUnknownTheta;
  }

 protected:
  std::optional<BroydenUpdates<Real>> updates_;

 private:
  // What happens when an increment is as large as the one before. One of them does not prove divergence, because the
  // increments before may have missed the components that the matrix solves worst. A shorter step or a new Jacobian
  // costs less than to find out. Where there is neither, the iteration goes on.
  enum class Patience { kNone, kToTheLimit };

  NewtonResult iterate(NewtonContext<Real>& c, Mat<Real>& W, Patience patience) {
    NewtonResult result;
    result.outcome = c.matrix.prepare(c.eq.h());
    if (result.outcome != Outcome::kSuccess) return result;
    const int limit = this->options_.newton.max_iterations * (adaptive_ ? 1 : kFixedStepFactor.whole());
    const double kappa = limit_.after(c.counters.steps_accepted, c.norm.index3());
    const double last = std::max(eta_, roundOff<Real>());
    double eta = last, of_step = eta;
    double previous = 0, before_previous = 0;
    bool doubted = false;  // whether the residual has not followed the increments so far
    if (updates_) updates_->begin(theta_ > kWorthUpdates, this->row_weights_);
    for (int m = 0; m < limit; ++m) {
      ++result.iterations;
      ++c.counters.newton_iterations;
      if (!this->residual(c, W)) return fail(result, Outcome::kNotFinite);
      if (m == 0 && adaptive_) evidence_.keep(this->R_);
      if (m == 1 && adaptive_) doubted = evidence_.left(c, this->R_, this->row_weights_, kappa) > kSlowContraction;
      const double norm = this->update(c, c.matrix, W, updates_ ? &*updates_ : nullptr);
      if (!std::isfinite(norm)) return fail(result, Outcome::kNotFinite);
      if (m > 0) {
        const double theta = previous > 0 ? norm / previous : 0;
        // An increment of round-off is at least as large as the exact one: its theta is only an upper bound.
        const bool is_bound = m > 1 && norm <= kRoundOffUnits * this->round_off_;
        if (!updates_ || m == 1) result.theta = theta_ = is_bound ? std::min(theta, result.theta) : theta;
        // Increments at round-off no longer contract; above round-off this is divergence.
        const bool may_stagnate = theta >= kSlowContraction && norm <= kStagnationUnits * this->round_off_;
        if (may_stagnate && norm >= kSlowContraction * before_previous) {
          return doubted && !isRoundOffOfLast(c, W) ? fail(result, Outcome::kNewtonFailed) : result;
        }
        eta = of_step = etaOf(theta);
        // Where eta |dw| is small enough already, so is its product with any power of theta < 1.
        const bool slow =
            adaptive_ && !(eta * norm <= kappa && theta < 1) && power(theta, limit - 1 - m) * eta * norm > kappa;
        const bool stuck = theta >= kStuck && patience == Patience::kNone;
        if (!may_stagnate && (stuck || slow)) {
          if (!isRoundOff(c, W, norm)) return fail(result, Outcome::kNewtonFailed);
          if (doubted && !isRoundOffOfLast(c, W)) return fail(result, Outcome::kNewtonFailed);
          result.round_off = norm;
          return result;
        }
        if (m > 1 && slowest_ == kUnknownTheta) slowest_ = theta;
        if (limit_.by_round_off) eta = etaOf(std::max(theta, slowest_));
        if (m > 1) slowest_ = theta;
      } else if (std::min(last, 1.0) * norm <= kappa || norm <= kRoundOffUnits * this->round_off_) {
        eta = of_step = std::pow(last, 0.8);  // if min(last, 1) is too large, so is this
      }
      const bool trusted = norm <= kTrustedIncrement;
      if ((trusted && eta * norm <= kappa) || norm <= kRoundOffUnits * this->round_off_) {
        doubted = adaptive_ && (m == 0 || doubted) && !hasFallen(c, W, norm, kappa);
        if (!doubted) {
          eta_ = std::isfinite(eta) ? eta : of_step;
          return result;
        }
      }
      before_previous = previous;
      previous = norm;
      if (updates_) updates_->learn(this->implicit());
    }
    return fail(result, Outcome::kNewtonFailed);
  }
  // Whether the residual has fallen by as much as the last increment, if it is the last, has to contract.
  bool hasFallen(NewtonContext<Real>& c, const Mat<Real>& W, double norm, double kappa) {
    const double left = evidence_.leftBy(c, W, this->row_weights_, kappa);
    return left <= kSlowContraction && etaOf(left) * norm <= kappa;
  }
  static double etaOf(double theta) {
    return theta < 1 ? theta / (1 - theta) : std::numeric_limits<double>::infinity();
  }
  // Whether an increment that no longer contracts is round-off of the residual.
  bool isRoundOff(NewtonContext<Real>& c, const Mat<Real>& W, double norm) {
    return adaptive_ && norm <= kLargestRoundOff && norm <= kRoundOffUnits * measuredFloor(c, W);
  }
  // Round-off of an increment: half the second difference of the residual for a change of w in the last digits of the
  // sums that it enters, which is all round-off since the linear part cancels; Moré & Wild, SIAM J. Sci. Comput. 33
  // (2011). What the matrix leaves of a first difference is no measure: a matrix that contracts by 1/2 leaves half of
  // the change. With a singular matrix in front of k, or with large terms that cancel, the residual has much more
  // round-off than eps. 0 if it cannot be measured.
  double measuredFloor(NewtonContext<Real>& c, const Mat<Real>& W) {
    if (!this->residual(c, W)) return 0;
    before_ = this->R_;
    lastDigits(c, W);
    changed_ = W + change_;
    if (!this->residual(c, changed_)) return 0;
    before_ -= Real(0.5) * this->R_;
    changed_ = W - change_;
    if (!this->residual(c, changed_)) return 0;
    this->R_ = before_ - Real(0.5) * this->R_;
    c.matrix.solve(this->R_.rightCols(this->R_.cols() - this->first_));
    return c.norm.increment(this->R_, this->first_, this->row_weights_);
  }
  // Whether the residual of the last stage is round-off: where the matrix makes all increments too small to tell.
  bool isRoundOffOfLast(NewtonContext<Real>& c, const Mat<Real>& W) {
    lastDigits(c, W);
    return evidence_.isRoundOff(c, W, change_, this->row_weights_, changed_);
  }
  // Sets change_ to last digits of w, and of u, v, x to which h^2 a, h a and h k are added; with alternating signs.
  void lastDigits(const NewtonContext<Real>& c, const Mat<Real>& W) {
    using std::abs;
    const State<Real>& from = c.eq.from();
    const Index nu = from.u.size(), nx = from.x.size();
    const Real h = c.eq.h(), eps = Real(kLastDigits.value) * Eigen::NumTraits<Real>::epsilon();
    change_.resize(W.rows(), W.cols());
    for (Index j = 0; j < W.cols(); ++j) {
      for (Index i = 0; i < W.rows(); ++i) {
        Real size = abs(W(i, j));
        if (i < nu) size += abs(from.v[i]) / h + abs(from.u[i]) / (h * h);
        if (i >= nu && i < nu + nx) size += abs(from.x[i - nu]) / h;
        change_(i, j) = (i + j) % 2 == 0 ? Real(eps * size) : Real(-eps * size);
      }
    }
  }
  NewtonResult fail(NewtonResult result, Outcome outcome) {
    forget();
    result.outcome = outcome;
    return result;
  }

  IncrementLimit limit_;
  bool adaptive_;
  ResidualEvidence<Real> evidence_;
  Mat<Real> before_, change_, changed_;  // of `measuredFloor`; empty until its first use
  double eta_ = 1, theta_ = 1;
  double slowest_ = kUnknownTheta;  // theta of the last step's last increment, the third or a later one
};

/// Simplified Newton with Broyden's updates of the matrix.
template <class Real>
class BroydenNewton final : public SimplifiedNewton<Real> {
 public:
  BroydenNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : SimplifiedNewton<Real>(options, sizes, scheme) {
    if (sizes.n() >= kUpdatesFrom) this->updates_.emplace(sizes.n(), scheme.implicitStages(), options.threads);
  }
};

}  // namespace

Strategy<NewtonKind> simplifiedNewton() {
  return {.id = NewtonKind::kSimplified,
          .meaning = "increment test in the error norm, HW II (IV.8)",
          .make = makes<NewtonMaker, SimplifiedNewton>()};
}

Strategy<NewtonKind> broydenNewton() {
  return {.id = NewtonKind::kBroyden,
          .meaning = "simplified; Broyden's updates of the matrix (QNERR) from 3 unknowns on",
          .make = makes<NewtonMaker, BroydenNewton>()};
}

}  // namespace irk
