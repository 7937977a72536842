// The effect of differences of (a, k) on a step, in the error norm.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/stages/error_norm.h"

namespace irk {

/// Owns scratch; keeps references.
template <class Real>
class RateNorm {
 public:
  RateNorm(const Sizes& sizes, const ErrorNorm<Real>& norm)
      : sizes_(sizes), norm_(norm), change_(sizes.n()), weights_(sizes.n()) {}

  /// h times `dw`. Multipliers jump with the mode and do not count; u, v, x do not jump. Not inlined: in another
  /// context the compiler would contract other products and sums.
  [[gnu::noinline]] double operator()(const Vec<Real>& dw, const Real& h) {
    norm_.rowWeights(static_cast<double>(h), weights_);
    double sum = 0;
    for (Index i = 0; i < sizes_.nu + sizes_.nx; ++i) {
      const double e = static_cast<double>(dw[i]);
      sum += weights_[i] * e * e;
    }
    return std::sqrt(sum / static_cast<double>(sizes_.components()));
  }
  /// h times the largest change from `w` to one of the stages W.
  double largestChange(const Mat<Real>& W, const Vec<Real>& w, const Real& h) {
    double most = 0;
    for (Index i = 0; i < W.cols(); ++i) {
      change_ = W.col(i) - w;
      most = std::max(most, (*this)(change_, h));
    }
    return most;
  }

 private:
  Sizes sizes_;
  const ErrorNorm<Real>& norm_;
  Vec<Real> change_;
  Vec<double> weights_;
};

}  // namespace irk
