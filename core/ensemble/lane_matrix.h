// The Newton matrices of eight systems in the eigenbasis of A, and the real one of the error estimate.
#pragma once

#include <vector>

#include "core/ensemble/lane_lu.h"
#include "core/linear/block_form.h"
#include "irk/system.h"

namespace irk {

/// Sizes index vectors of lanes.
inline std::size_t count(Index n) { return static_cast<std::size_t>(n); }

/// (D0, D1, D2) of eight systems, n x n each, by columns. D1 has the columns of (v, x), D2 those of u; others are 0.
struct LaneJacobian {
  explicit LaneJacobian(const Sizes& sizes);
  Sizes sizes;
  std::vector<Lanes> d0, d1, d2;
};

/// Block (i, j) = delta_ij D0 + h A_ij D1 + h^2 (A^2)_ij D2, rows scaled by h^-power: one real or complex matrix per
/// eigenvalue of A, as of the solver `eigen` (core/stage_solvers/decoupled.h). Owns factors and scratch.
class LaneMatrix {
 public:
  /// `filter`: mu of the error estimate's matrix D0 + h mu D1 + h^2 mu^2 D2, which is one of the others if A has this
  /// eigenvalue.
  LaneMatrix(const Sizes& sizes, const std::vector<int>& row_powers, const Mat<double>& A, double filter);

  /// New factors for the lanes of `which`.
  LaneFactors factorize(const LaneJacobian& jacobian, const Lanes& h, const LaneMask& which);
  /// In place: scaled residuals of all stages to increments, column j (n entries) = stage j.
  void solve(Lanes* r);
  /// In place, n entries: with the matrix of the error estimate.
  void solveFilter(Lanes* r) const { real_[filter_].solve(r); }
  /// Whether A has no such eigenvalue.
  bool hasOwnFilter() const { return own_filter_; }

 private:
  struct Block {
    Index start;  // its first column in the basis
    std::complex<double> mu;
    std::size_t lu;  // its place in real_ or complex_
    bool pair;
  };
  template <class Set>
  void fill(const LaneJacobian& jacobian, const Lanes& h, const std::complex<double>& mu, const Set& set) const;

  Index n_, s_;
  std::vector<int> row_powers_;
  Mat<double> to_basis_, from_basis_;  // row j: what each column adds to column j
  std::vector<Block> blocks_;
  std::vector<LaneLu<Lanes>> real_;
  std::vector<LaneLu<ComplexLanes>> complex_;
  std::size_t filter_;
  double filter_mu_;
  bool own_filter_;
  std::vector<Lanes> y_;
  std::vector<ComplexLanes> eta_;
};

/// h^power in each lane, power >= 0.
inline Lanes powerOf(const Lanes& h, int power) {
  Lanes f = 1.0;
  for (int i = 0; i < power; ++i) f *= h;
  return f;
}

/// out := in C for n x s `in` and `out` (not aliased) by columns: column j of `out` is the sum of C(m, j) times column
/// m.
void laneProduct(const Lanes* in, Index rows, Index leading, const Mat<double>& C, Lanes* out);

}  // namespace irk
