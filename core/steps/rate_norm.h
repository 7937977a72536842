// The effect on a step of a difference in (a, k), in the error norm.
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

  /// The norm of h times `dw`. Multipliers do not count, since they jump with the mode; u, v, x do not jump. Not
  /// inlined: elsewhere the compiler would contract other products and sums, and the bits would differ.
  [[gnu::noinline]] double operator()(const Vec<Real>& dw, const Real& h) {
    norm_.rowWeights(static_cast<double>(h), weights_);
    double sum = 0;
    for (Index i = 0; i < sizes_.nu + sizes_.nx; ++i) {
      const double e = static_cast<double>(dw[i]);
      sum += weights_[i] * e * e;
    }
    return std::sqrt(sum / static_cast<double>(sizes_.components()));
  }
  /// The norm of h times the largest change from `w` to one of the stages W.
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
