// Eigenvalues of small real matrices in 80 digits, and how well eigenvectors are conditioned.
#pragma once

#include <complex>
#include <vector>

#include "irk/scalar.h"
#include "tableaus/families/precise.h"

namespace irk {

/// re + i im. Pairs stand together, the positive im first.
struct Eigenvalue {
  mp80 re, im;

  std::complex<double> rounded() const;
};

/// The n eigenvalues of a real n x n matrix, n >= 0. Throws std::runtime_error if the QR iteration
/// does not end (none is known).
std::vector<Eigenvalue> eigenvalues(const Mat<mp80>& matrix);

/// The real zeros and pairs of zeros of a_0 + a_1 x + ... + a_n x^n, with a_0 and a_n not zero: the
/// eigenvalues of its companion matrix, x scaled so that |a_0| = |a_n|.
std::vector<Eigenvalue> polynomialZeros(const Vec<mp80>& ascending);

struct Spectrum {
  std::vector<Eigenvalue> values;
  double gap;  ///< smallest |lambda_i - lambda_j|, over the largest |lambda|; 1 if n = 1
  /// 2-norm, of the matrix of unit eigenvectors; inf from 1e38 on, where 80 digits cannot tell.
  double eigenvector_condition;
  bool repeated;   ///< gap <= sqrt(tolerance): rounding splits a double eigenvalue by so much
  bool defective;  ///< repeated, and its eigenvectors coincide to the same measure
};

/// Of a real n x n matrix, n >= 1, with coefficients right to `tolerance`.
Spectrum spectrum(const Mat<mp80>& matrix, double tolerance);

}  // namespace irk
