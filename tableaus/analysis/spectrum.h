// Eigenvalues of small real matrices in 80 digits, and the condition of their eigenvectors.
#pragma once

#include <complex>
#include <vector>

#include "irk/scalar.h"
#include "tableaus/families/precise.h"

namespace irk {

/// The number re + i im. The two of a complex pair are neighbours, the one with positive im first.
struct Eigenvalue {
  BigFloat re, im;

  std::complex<double> rounded() const;
};

/// The n eigenvalues of a real n x n matrix, n >= 0. Throws std::runtime_error if the QR iteration does not converge
/// (no such matrix is known).
std::vector<Eigenvalue> eigenvalues(const Mat<BigFloat>& matrix);

/// The zeros, real ones and complex pairs, of a_0 + a_1 x + ... + a_n x^n with a_0 and a_n not zero: the eigenvalues
/// of its companion matrix, with x scaled so that |a_0| = |a_n|.
std::vector<Eigenvalue> polynomialZeros(const Vec<BigFloat>& ascending);

struct Spectrum {
  std::vector<Eigenvalue> values;
  double gap;  ///< smallest |lambda_i - lambda_j|, over the largest |lambda|; 1 if n = 1
  /// The condition of the matrix of unit eigenvectors in the 2-norm; inf from 1e38 on, which 80 digits do not
  /// resolve.
  double eigenvector_condition;
  bool repeated;   ///< gap <= sqrt(tolerance), the distance by which rounding splits a double eigenvalue
  bool defective;  ///< repeated, with eigenvectors that coincide within the same limit
};

/// For a real n x n matrix, n >= 1, with coefficients accurate to `tolerance`.
Spectrum spectrum(const Mat<BigFloat>& matrix, double tolerance);

}  // namespace irk
