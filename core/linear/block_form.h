// Bases in which a Runge-Kutta matrix A is block triangular or block diagonal.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "irk/scalar.h"

namespace irk {

/// A = Q T Q^-1, where T has 1 x 1 and 2 x 2 blocks on its diagonal. All matrices are s x s. The stages are columns of
/// n x s matrices: Y = R to_basis and R = Y from_basis.
template <class Real>
struct BlockForm {
  Mat<Real> to_basis, from_basis;  ///< Q^-T and Q^T
  Mat<Real> T, T2;                 ///< T and T^2
  bool diagonal = false;           ///< true: T is block diagonal (eigenbasis); false: block upper triangular (Schur)
  struct Block {
    Index start;            ///< its first row in T
    Index size;             ///< 1: a real eigenvalue; 2: a complex pair
    std::complex<Real> mu;  ///< eigenvalue of A
    Real sigma;             ///< y1 + i sigma y2 diagonalizes a 2 x 2 block
  };
  std::vector<Block> blocks;
};

/// The real Schur form: Q is orthogonal. Defined for every A. In double the process keeps forms by their A, as those of
/// eigenForm: 0.3 MB each with 100 stages, some kB with 13.
template <class Real>
std::shared_ptr<const BlockForm<Real>> schurForm(const Mat<Real>& A);
/// The real eigenbasis, with columns Re v, Im v for a complex eigenvector v. Throws Misuse for a defective A.
template <class Real>
std::shared_ptr<const BlockForm<Real>> eigenForm(const Mat<Real>& A);

}  // namespace irk
