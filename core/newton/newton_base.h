// What Newton methods share: residual, solve, update, and the units of round-off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/constants.h"
#include "core/base/small_size.h"
#include "core/base/threads.h"
#include "core/newton/broyden.h"
#include "core/newton/newton.h"

namespace irk {

template <class Real>
double roundOff() {
  return static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
}

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
  /// error estimate shows it: N steps would leave N kappa tolerances. From kManySteps on kappa therefore falls as
  /// kManySteps / N.
  /// In index 3 accelerations are second differences of positions, and what is left in them enters the error estimate
  /// as h^-1: there it is kHiddenPart of that, unless the caller has chosen kappa.
  double after(std::int64_t accepted, bool index3) const {
    const auto steps = static_cast<double>(accepted);
    const double first = index3 ? std::max(least, kHiddenPart * kappa) : kappa;
    return steps <= kManySteps ? first : std::max(least, first * kManySteps / steps);
  }
};
template <class Real>
IncrementLimit incrementLimit(const IntegratorOptions& options) {
  const double floor = kRoundOffUnits * unitRoundOff<Real>(options);
  const double kappa = options.newton.kappa;
  const double part = options.step.estimate == ErrorEstimate::kRichardson ? kHiddenPart.value : 1;
  const double wanted = kappa > 0 ? kappa : part * kNewtonPart;
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
    copyOnThreads(options_.threads, W.data(), W.size(), W0_.data());
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
    inParts(options_.threads, increment.size(), [w, d](Index first, Index last) {
      withSize<unrolledSizes<Real>(9)>(last - first, [=](auto n) {
        for (Index i = 0; i < n; ++i) w[first + i] -= d[first + i];
      });
    });
    return c.norm.increment(R_, first_, row_weights_, options_.threads);
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
