// Properties that a tableau has, regardless of what it declares: simplifying assumptions, stability, structure.
#pragma once

#include "irk/tableau.h"

namespace irk {

/// Residuals of Butcher's simplifying assumptions (HW II, IV.5), entry k-1 for the k-th condition:
///   B(k)  sum_i b_i c_i^(k-1) = 1/k                              k = 1 .. 2s+1
///   C(k)  sum_j a_ij c_j^(k-1) = c_i^k / k             every i   k = 1 .. s+1
///   D(k)  sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k) / k  every j   k = 1 .. s+1
/// Each entry is the largest over i or j. A residual is divided by the sum of its terms' magnitudes if that exceeds
/// 1.
struct SimplifyingResiduals {
  Vec<double> B, C, D;
};

/// Computed in 80 digits from the given coefficients.
struct TableauAnalysis {
  double tolerance;  ///< residuals up to this size count as zero
  SimplifyingResiduals residuals;
  int p, q, r;                  ///< largest numbers with B(p), C(q), D(r)
  int proven_order;             ///< min(p, 2q+2, q+r+1), Butcher's theorem; at most 2s
  Vec<double> row_sum_errors;   ///< s: |sum_j a_ij - c_i|
  double reciprocal_condition;  ///< of A, 1-norm; 0 if A is singular
  bool regular;                 ///< reciprocal condition above the tolerance
  bool stiffly_accurate;        ///< a_sj = b_j; with C(1) and sum b = 1, c_s = 1 follows
  bool explicit_first_stage;    ///< first row of A is zero
  double symplecticity_error;   ///< max |b_i a_ij + b_j a_ji - b_i b_j|
  bool symplectic;
  bool algebraically_stable;  ///< b >= 0, (b_i a_ij + b_j a_ji - b_i b_j) positive semidefinite
};

/// 50 eps with eps = 10^(1 - digits), for coefficients with this many decimal digits. Measured residuals of correctly
/// rounded tableaus are below 0.4 eps up to s = 100; published ones are often off by a few eps.
double toleranceOfDigits(int digits);

/// The same for coefficients rounded to Real; for BigFloat with the number of digits in tableau files.
template <class Real>
double roundingTolerance();

/// Real: double, BigFloat. Throws Misuse unless A is s x s, b and c have s entries, s >= 1, and all are finite.
template <class Real>
TableauAnalysis analyzeTableau(const Tableau<Real>& tableau, double tolerance = roundingTolerance<Real>());

}  // namespace irk
