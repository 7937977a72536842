// Gauss' quadrature in any precision.
#pragma once

#include <cmath>
#include <limits>

#include "irk/scalar.h"

namespace irk {

/// Nodes and weights of Gauss' formula with n nodes, for double or BigFloat with the working digits. Boost's are
/// constants that are computed once, in the digits of the first call.
template <class Real>
class GaussRule {
 public:
  /// Newton's method on the Legendre polynomial from cos(pi (i + 3/4) / (n + 1/2)): Press et al., Numerical Recipes
  /// (2007), 4.6.1. n >= 1.
  explicit GaussRule(int n) : x_(n), w_(n) {
    for (int i = 0; i < n; ++i) {
      Real x = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope;
      for (int step = 0; step < kMostSteps; ++step) {
        Real p = 1, before = 0;
        for (int k = 0; k < n; ++k) {
          const Real next = ((2 * k + 1) * x * p - k * before) / (k + 1);
          before = p;
          p = next;
        }
        slope = n * (x * p - before) / (x * x - 1);
        const Real change = p / slope;
        x -= change;
        using std::abs;
        if (abs(change) < std::numeric_limits<Real>::epsilon()) break;
      }
      x_[i] = x;
      w_[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }

  /// The integral of f from `from` to `to`.
  Real operator()(const auto& f, const Real& from, const Real& to) const {
    const Real middle = (from + to) / 2, half = (to - from) / 2;
    Real sum = 0;
    for (Index i = 0; i < x_.size(); ++i) sum += w_[i] * f(Real(middle + half * x_[i]));
    return half * sum;
  }

 private:
  static constexpr int kMostSteps = 20;
  Vec<Real> x_, w_;
};

}  // namespace irk
