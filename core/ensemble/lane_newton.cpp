#include "core/ensemble/lane_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.h"

namespace irk {
namespace {

// As in core/newton/simplified_newton.cpp.

// x^n by squaring, n >= 0.
Lanes power(Lanes x, int n) {
  Lanes result = 1.0;
  for (; n > 0; n /= 2, x *= x) {
    if (n % 2 == 1) result *= x;
  }
  return result;
}

Lanes etaOf(const Lanes& theta) {
  return select(less(theta, 1.0), theta / (1.0 - theta), std::numeric_limits<double>::infinity());
}

}  // namespace

LaneNewton::LaneNewton(const Scheme<double>& scheme, const Sizes& sizes, const std::vector<int>& row_powers,
                       const IntegratorOptions& options, double mu)
    : s_(scheme.s),
      stop_(incrementLimit<double>(options)),
      round_off_(unitRoundOff<double>(options)),
      keep_below_(options.newton.keep_jacobian_below),
      limit_(options.newton.max_iterations),
      jacobian_(sizes),
      matrix_(sizes, row_powers, scheme.A, mu),
      eta_(1.0),
      theta_(1.0),
      W0_(static_cast<std::size_t>(sizes.n() * scheme.s)),
      R_(W0_.size()),
      R0_(W0_.size()),
      change_(W0_.size()),
      moved_(W0_.size()) {}

void LaneNewton::restart(std::size_t i) {
  differentiated_.set(i, false);
  factorized_.set(i, false);
  eta_.set(i, 1);
  theta_.set(i, 1);
  slowest_.set(i, 0);
}

void LaneNewton::forget(const LaneMask& which) {
  eta_ = select(which, 1.0, eta_);
  theta_ = select(which, 1.0, theta_);
  slowest_ = select(which, 0.0, slowest_);
}

// Differentiates in all lanes, because the arithmetic is the same as for one.
void LaneNewton::differentiate(Context& c, const LaneMask& which) {
  if (!which.any()) return;
  c.stages.differentiate(c.W, which, jacobian_);
  c.counters.jacobians.add(which);
  c.counters.dual_residuals.add(which, c.stages.dualEvaluations());
  jacobian_t_ = select(which, c.from.t, jacobian_t_);
  differentiated_ = differentiated_ | which;
  stale_ = stale_ & ~which;
  factorized_ = factorized_ & ~which;
}

// Returns the lanes that have factors.
LaneMask LaneNewton::prepare(Context& c, const LaneMask& which) {
  const LaneMask wanted = which & ~(factorized_ & equal(factors_h_, c.h));
  if (!wanted.any()) return which;
  const LaneFactors factors = matrix_.factorize(jacobian_, c.h, wanted);
  c.counters.factorizations.add(wanted);
  factors_h_ = select(wanted, c.h, factors_h_);
  factorized_ = (factorized_ | wanted) & ~factors.failed();
  new_filter_ = new_filter_ | wanted;
  if (!factors.failed().any()) return which;
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (factors.singular[i]) c.result.outcome[i] = Outcome::kSingular;
    if (factors.not_finite[i]) c.result.outcome[i] = Outcome::kNotFinite;
  }
  return which & ~factors.failed();
}

LaneMatrix& LaneNewton::filterMatrix(const LaneMask& which, LaneCounters& counters) {
  if (matrix_.hasOwnFilter()) counters.factorizations.add(which & new_filter_);
  new_filter_ = new_filter_ & ~which;
  return matrix_;
}

void LaneNewton::fail(Context& c, const LaneMask& which, Outcome outcome) {
  forEachLane(which, [&](std::size_t i) { c.result.outcome[i] = outcome; });
  forget(which);
}

// One correction in the lanes of `running`; lanes in which it is not finite are removed from the mask. Returns its
// norm.
Lanes LaneNewton::update(Context& c, LaneMask& running) {
  c.counters.newton_iterations.add(running);
  c.counters.residuals.add(running, s_);
  LaneMask good = c.stages.residual(c.W, R_);
  matrix_.solve(R_.data());
  c.counters.solves.add(running & good);
  const Lanes norm = c.norm.increment(R_.data(), s_);
  good = good & finite(norm);
  for (std::size_t i = 0; i < R_.size(); ++i) c.W[i] = select(running, c.W[i] - R_[i], c.W[i]);
  const LaneMask bad = running & ~good;
  if (bad.any()) fail(c, bad, Outcome::kNotFinite);
  running = running & good;
  return norm;
}

// HW II (IV.8): converged when eta |dw| <= kappa. In the first iteration the last step's eta, raised to 0.8, takes the
// place of the contraction; the fifth power of that bound needs no root.
void LaneNewton::iterate(Context& c, const LaneMask& which) {
  LaneMask running = prepare(c, which);
  LaneMask converged;
  Lanes previous;
  const Lanes floor = kRoundOffUnits.value * round_off_;
  for (int m = 0; m < limit_ && running.any(); ++m) {
    const Lanes norm = update(c, running);
    LaneMask done = lessOrEqual(norm, floor);
    LaneMask ends;
    if (m == 0) {
      const Lanes eta = largest(eta_, roundOff<double>());
      const LaneMask small = lessOrEqual(power(eta, 4) * power(norm / c.kappa, 5), 1.0);
      done = (done | (small & lessOrEqual(norm, kTrustedIncrement.value))) & running;
      if (done.any()) eta_ = select(done, pow(eta, 0.8), eta_);
    } else {
      const Lanes theta = select(less(0.0, previous), norm / previous, 0.0);
      theta_ = select(running, theta, theta_);
      ends =
          running & lessOrEqual(kSlowContraction.value, theta) & lessOrEqual(norm, kStagnationUnits.value * round_off_);
      Lanes eta = etaOf(theta);
      const LaneMask slow = less(c.kappa, power(theta, limit_ - 1 - m) * eta * norm);
      const LaneMask hopeless = running & ~ends & (lessOrEqual(kStuck.value, theta) | slow);
      if (stop_.by_round_off) eta = etaOf(largest(theta, slowest_));
      if (m > 1) slowest_ = select(running & ~ends & ~hopeless, theta, slowest_);
      const LaneMask small = lessOrEqual(eta * norm, c.kappa) & lessOrEqual(norm, kTrustedIncrement.value);
      done = (done | small) & running & ~ends & ~hopeless;
      eta_ = select(done, eta, eta_);
      if (hopeless.any()) {
        const LaneMask rounded = isRoundOff(c, hopeless, norm);
        c.result.round_off = select(rounded, norm, c.result.round_off);
        ends = ends | rounded;
        fail(c, hopeless & ~rounded, Outcome::kNewtonFailed);
        running = running & ~(hopeless & ~rounded);
      }
    }
    converged = converged | done | ends;
    running = running & ~(done | ends);
    previous = norm;
  }
  if (running.any()) fail(c, running, Outcome::kNewtonFailed);
  c.result.solved = c.result.solved | converged;
}

// Whether an increment that no longer contracts is round-off of the residual, see SimplifiedNewton::isRoundOff.
LaneMask LaneNewton::isRoundOff(Context& c, const LaneMask& which, const Lanes& norm) {
  LaneMask small = which & lessOrEqual(norm, kLargestRoundOff.value);
  if (!small.any()) return small;
  c.counters.residuals.add(small, 2 * s_);
  c.counters.solves.add(small);
  small = small & c.stages.residual(c.W, R0_);
  c.stages.lastDigits(c.W, change_);
  for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = c.W[i] + change_[i];
  small = small & c.stages.residual(moved_, R_);
  for (std::size_t i = 0; i < R_.size(); ++i) R_[i] -= R0_[i];
  matrix_.solve(R_.data());
  for (std::size_t i = 0; i < R_.size(); ++i) R_[i] -= change_[i];
  return small & lessOrEqual(norm, kRoundOffUnits.value * c.norm.increment(R_.data(), s_));
}

LaneSolved LaneNewton::solve(LaneStages& stages, const LaneNorm& norm, const LaneState& from, const Lanes& h,
                             const LaneMask& which, const Lanes& kappa, std::vector<Lanes>& W, LaneCounters& counters) {
  LaneSolved result;
  Context c{stages, norm, from, h, kappa, W, counters, result};
  differentiate(c, which & (stale_ | ~differentiated_));
  const LaneMask had_old = ~equal(jacobian_t_, from.t);
  if ((which & had_old).any()) W0_ = W;
  theta_ = select(which, 0.0, theta_);
  iterate(c, which);
  const LaneMask again = which & had_old & ~result.solved;
  if (again.any()) {
    counters.newton_restarts.add(again);
    assign(again, W0_.data(), W.data(), W.size());
    theta_ = select(again, 0.0, theta_);
    differentiate(c, again);
    iterate(c, again);
  }
  stale_ = stale_ | (which & (~result.solved | less(keep_below_, theta_)));
  return result;
}

}  // namespace irk
