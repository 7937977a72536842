// Bases in which a Runge-Kutta matrix A is block triangular or block diagonal.
#pragma once

#include <complex>
#include <vector>

#include "irk/scalar.h"

namespace irk {

/// A = Q T Q^-1 with 1 x 1 and 2 x 2 blocks on the diagonal of T, and its blocks.
template <class Real>
struct BlockForm {
  Mat<Real> Q, Q_inverse, T;
  bool diagonal = false;  ///< T is block diagonal (eigenvectors), else block upper triangular
  struct Block {
    Index start;
    Index size;              ///< 1 real, 2 a complex pair
    std::complex<Real> mu;   ///< eigenvalue of A
    Real sigma;              ///< y1 + i sigma y2 diagonalizes a 2 x 2 block
  };
  std::vector<Block> blocks;
};

/// Real Schur form: Q orthogonal.
template <class Real>
BlockForm<Real> schurForm(const Mat<Real>& A);
/// Real eigenbasis [Re v, Im v]. Throws Misuse for a defective A.
template <class Real>
BlockForm<Real> eigenForm(const Mat<Real>& A);

}  // namespace irk
