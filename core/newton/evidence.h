// What a first increment shows of the matrix that has made it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/constants.h"
#include "core/newton/newton.h"

namespace irk {

/// A matrix may be far larger than the derivatives at the stages: that of a contact, of a force of friction or of 1/x
/// at the step's start, of which the stages are free. Then the first increment is as small as in a solved step,
/// whatever the residual is, and so is all that the same matrix filters: the error estimate, the defect. What the
/// increment was to remove is the residual. So it is measured without the matrix, in the last stage: in the second
/// iteration, which evaluates it anyway, and where a small increment would end the iteration in spite of it.
///
/// The measure of a stage is that of an increment of w by r_i / (D0)_ii, in tolerances: the error of the step if the
/// matrix were D0. Rows without (D0)_ii, as those of constraints, do not count.
template <class Real>
class ResidualEvidence {
 public:
  explicit ResidualEvidence(const Sizes& sizes)
      : components_(sizes.components()),
        before_(sizes.n()),
        now_(sizes.n()),
        diagonal_(static_cast<std::size_t>(sizes.n())) {}

  /// Keeps the residuals of the start values. `R`: n x s.
  void keep(const Mat<Real>& R) { before_ = R.col(R.cols() - 1); }

  /// What the residuals R have left of the start values' one in the last stage: a part of it, or 0 if one of both is
  /// below `kappa` tolerances. `squares`: ErrorNorm::rowWeights.
  double left(NewtonContext<Real>& c, const Mat<Real>& R, const Vec<double>& squares, double kappa) {
    now_ = R.col(R.cols() - 1);
    return partOf(sizeOf(c, before_, squares), sizeOf(c, now_, squares), kappa);
  }
  /// The same of the residual of the stages W, which is evaluated if it is needed; infinite if it is not finite.
  double leftBy(NewtonContext<Real>& c, const Mat<Real>& W, const Vec<double>& squares, double kappa) {
    const double before = sizeOf(c, before_, squares);
    if (before <= kappa) return 0;
    if (!c.eq.lastResidual(W, now_)) return std::numeric_limits<double>::infinity();
    return partOf(before, sizeOf(c, now_, squares), kappa);
  }

  /// Whether the residual of the last stage of W is round-off: that of its change with last digits of W, `digits`.
  /// `scratch`: n x s.
  bool isRoundOff(NewtonContext<Real>& c, const Mat<Real>& W, const Mat<Real>& digits, const Vec<double>& squares,
                  Mat<Real>& scratch) {
    if (!c.eq.lastResidual(W, now_)) return false;
    const double size = sizeOf(c, now_, squares);
    before_ = now_;
    for (const int sign : {1, -1}) {
      scratch = W + Real(sign) * digits;
      if (!c.eq.lastResidual(scratch, now_)) return false;
      before_ -= Real(0.5) * now_;
    }
    return size <= kRoundOffUnits * sizeOf(c, before_, squares);
  }

 private:
  static double partOf(double before, double now, double kappa) {
    return before <= kappa || now <= kappa ? 0 : now / before;
  }
  // In tolerances.
  double sizeOf(NewtonContext<Real>& c, const Vec<Real>& r, const Vec<double>& squares) {
    const Linearization<Real>& at = c.matrix.shared().at().front();
    findDiagonal(at.pattern);
    double sum = 0;
    for (Index i = 0; i < r.size(); ++i) {
      const Index k = diagonal_[static_cast<std::size_t>(i)];
      const double d = k < 0 ? 0 : static_cast<double>(at.d0[k]);
      if (d == 0) continue;
      const double change = static_cast<double>(r[i]) / d;
      sum += squares[i] * change * change;
    }
    return std::sqrt(sum / static_cast<double>(components_));
  }
  void findDiagonal(const std::shared_ptr<const Pattern>& pattern) {
    if (pattern_ == pattern) return;
    pattern_ = pattern;
    std::fill(diagonal_.begin(), diagonal_.end(), -1);
    for (Index j = 0; j < pattern->n; ++j) {
      pattern->forEachInBlock(j, 1, j, 1, [&](Index k) { diagonal_[static_cast<std::size_t>(j)] = k; });
    }
  }

  Index components_;
  Vec<Real> before_, now_;  // residuals of the last stage
  std::shared_ptr<const Pattern> pattern_;
  std::vector<Index> diagonal_;  // of each row: the entry of D0 on the diagonal, or -1
};

}  // namespace irk
