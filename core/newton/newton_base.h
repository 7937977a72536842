// What Newton methods share: residual, solve, update, and the units of round-off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/small_size.h"
#include "core/newton/broyden.h"
#include "core/newton/newton.h"

namespace irk {

template <class Real>
double roundOff() {
  return static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
}

// Increments below this many units of round-off cannot be reduced further.
inline constexpr double kRoundOffUnits = 10;
// A contraction remembered from the step before ends the iteration after its first increment only if that is at most
// one tolerance. In a phase in which the equations are linear the remembered contraction is round-off, and would accept
// any increment; the step after that phase has another one (a box on an oscillating table, Stribeck friction with a
// width of 1e-2, embedded, 1e-7: one increment of 1e6 tolerances, and an acceleration wrong by 9.81 in two stages).
inline constexpr double kTrustedFirst = 1;
// After the first iteration an increment counts as converged only if it is itself at most this many tolerances. Start
// values may be far off: then a much smaller second increment does not show that the solution is near (transamp,
// radau_ia_20, 1e-2: increments of 3e5 and 28 tolerances, and an error of 5e4).
inline constexpr double kTrustedIncrement = 10;
// Increments that stop contracting below this many units of round-off are round-off of the residual.
inline constexpr double kStagnationUnits = 1e4;

// Fixed steps cannot be shortened: Newton's method may use this many times max_iterations.
inline constexpr int kFixedStepFactor = 4;

// Weights divide by the tolerance: round-off in the error norm is eps / tolerance.
template <class Real>
double unitRoundOff(const IntegratorOptions& options) {
  return roundOff<Real>() / std::max(options.tolerances.rtol, options.tolerances.atol);
}

/// The bound for eta |dw|, in tolerances, HW II (IV.8).
struct IncrementLimit {
  double kappa;
  bool by_round_off;  ///< a smaller kappa is wanted, but increments do not become smaller than round-off
  double least;       ///< lower bound of kappa: round-off, or kappa itself if the caller has chosen it

  /// kappa after `accepted` steps. The remaining error of Newton's method has the same sign in step after step, and no
  /// error estimate shows it: N steps would leave N kappa tolerances. From kMany steps on kappa therefore falls as
  /// kMany / N.
  double after(std::int64_t accepted) const {
    constexpr std::int64_t kMany = 1000;
    if (accepted <= kMany) return kappa;
    return std::max(least, kappa * static_cast<double>(kMany) / static_cast<double>(accepted));
  }
};
/// kappa shrinks with s: at high order an inaccurate solution of the stage equations spoils the step.
template <class Real>
IncrementLimit incrementLimit(const IntegratorOptions& options, Index stages) {
  const double floor = kRoundOffUnits * unitRoundOff<Real>(options);
  const double s = static_cast<double>(stages);
  const double rtol = std::max(options.tolerances.rtol, options.tolerances.atol);
  const double kappa = options.newton.kappa;
  // The difference of a step and its halves, divided by 2^q - 1, hides what Newton's method leaves in them.
  constexpr double kHidden = 0.1;
  const double part = options.step.estimate == ErrorEstimate::kRichardson ? kHidden : 1;
  const double wanted = kappa > 0 ? kappa : part * std::min(0.03, std::pow(rtol, (s - 1) / (s + 1)));
  const double limit = std::max(floor, wanted);
  return {limit, floor > wanted, kappa > 0 ? limit : floor};
}

/// The parts that all iterations share: residual, solve, update.
template <class Real>
class NewtonBase : public Newton<Real> {
 protected:
  NewtonBase(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : options_(options),
        round_off_(unitRoundOff<Real>(options)),
        first_(scheme.first),
        R_(sizes.n(), scheme.s),
        W0_(sizes.n(), scheme.s),
        row_weights_(sizes.n()) {}

  /// Begins a new step; keeps its start values for restarts.
  void begin(NewtonContext<Real>& c, const Mat<Real>& W) {
    copyFew(W.data(), W.size(), W0_.data());
    c.norm.rowWeights(static_cast<double>(c.eq.h()), row_weights_);
  }

  /// Evaluates a new Jacobian if one is asked for, or if there is none.
  void refresh(NewtonContext<Real>& c, const Mat<Real>& W) {
    auto& shared = c.matrix.shared();
    const bool wanted = shared.stale() && c.use == JacobianUse::kRefreshIfStale;
    if (shared.version() == 0 || wanted) shared.evaluate(c.eq, W);
  }

  /// Evaluates R(W); returns false if it is not finite.
  bool residual(NewtonContext<Real>& c, const Mat<Real>& W) { return c.eq.residual(W, R_); }

  /// Solves for the increment, applies it, and returns its norm; NaN if not finite. Not inlined: iterations of small
  /// systems are 1 to 7 % faster.
  template <class Matrix>
  [[gnu::noinline]] double update(NewtonContext<Real>& c, Matrix& matrix, Mat<Real>& W,
                                  BroydenUpdates<Real>* updates = nullptr) {
    matrix.solve(R_.rightCols(R_.cols() - first_));
    VecView<Real> increment = implicit();
    if (updates) updates->apply(increment);
    Real* const __restrict w = W.col(first_).data();
    const Real* const __restrict d = increment.data();
    withSize<unrolledSizes<Real>(9)>(increment.size(), [&](auto n) {
      for (Index i = 0; i < n; ++i) w[i] -= d[i];
    });
    return c.norm.increment(R_, first_, row_weights_);
  }
  VecView<Real> implicit() { return {R_.col(first_).data(), R_.rows() * (R_.cols() - first_)}; }

  const IntegratorOptions& options_;
  double round_off_;
  Index first_;
  Mat<Real> R_;   // residual, then increment
  Mat<Real> W0_;  // start values, for restarts
  Vec<double> row_weights_;
};

}  // namespace irk
