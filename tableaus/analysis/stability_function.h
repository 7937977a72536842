// The stability function R(z) = 1 + z b^T (I - z A)^-1 1 as a ratio of polynomials. HW II, IV.3.
#pragma once

#include <complex>
#include <vector>

#include "irk/tableau.h"
#include "tableaus/families/precise.h"

namespace irk {

/// R = N / D without common factors.
struct StabilityFunction {
  /// Coefficients of N and D, ascending, those of z^0 being 1. R is a quotient of the determinants of I - z A + z 1
  /// b^T and I - z A, HW II (IV.3.3).
  Vec<BigFloat> numerator, denominator;
  std::vector<std::complex<double>> zeros, poles;  ///< as many as their degrees
  int order;              ///< largest q with e^z - R(z) = O(z^(q+1)); at least the method's order
  double error_constant;  ///< C of e^z - R(z) = C z^(q+1) + ..., HW II (IV.3.5)
  bool order_resolved;    ///< false: the digits do not distinguish C from 0; order is a lower bound, C is NaN

  Index numeratorDegree() const { return numerator.size() - 1; }
  Index denominatorDegree() const { return denominator.size() - 1; }
  /// Whether R is the Pade approximation of its degrees: HW II, Theorem IV.3.11.
  bool isPade() const { return order_resolved && order == numeratorDegree() + denominatorDegree(); }
  /// R at z -> infinity; if N has the higher degree, +inf or -inf as for z -> -infinity.
  double atInfinity() const;
};

/// For coefficients accurate to `tolerance`; differences within it count as zero. Requires A s x s and b with s
/// entries, s >= 1, all finite.
StabilityFunction stabilityFunction(const Tableau<BigFloat>& tableau, double tolerance);

}  // namespace irk
