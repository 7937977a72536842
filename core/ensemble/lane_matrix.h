// The Newton matrices of eight systems in the eigenbasis of A, and the real one of the error estimate.
#pragma once

#include <array>
#include <complex>
#include <type_traits>
#include <vector>

#include "core/ensemble/lane_lu.h"
#include "core/linear/block_form.h"
#include "irk/system.h"

namespace irk {

/// Sizes index vectors of lanes.
constexpr std::size_t count(Index n) { return static_cast<std::size_t>(n); }

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
  void solveFilter(Lanes* r) { real_[filter_].solve(r); }
  /// Whether A has no such eigenvalue.
  bool hasOwnFilter() const { return own_filter_; }

 private:
  struct Block {
    Index start;  // its first column in the basis
    std::complex<double> mu;
    std::size_t lu;  // its place in real_ or complex_
    bool pair;
  };
  template <class Value, class SecondOrder>
  LaneFactors factorize(LaneLu<Value>& lu, const LaneJacobian& jacobian, const Lanes& h, const std::complex<double>& mu,
                        const LaneMask& which, SecondOrder) const;
  // Where entry (i, j) in the basis is in y_.
  std::size_t place(Index i, Index j) const { return count(columns_[count(j)].first + i * columns_[count(j)].stride); }

  Index n_, s_;
  std::vector<int> row_powers_;
  bool scaled_;                        // whether any row is scaled
  std::vector<Lanes> scales_;          // h^-power of the rows
  Mat<double> to_basis_, from_basis_;  // column j: the weights of all columns in column j
  std::vector<Block> blocks_;
  std::vector<LaneLu<Lanes>> real_;
  std::vector<LaneLu<ComplexLanes>> complex_;
  std::size_t filter_;
  double filter_mu_;
  bool own_filter_;
  struct Column {
    Index first, stride;
  };
  std::vector<Column> columns_;  // in y_: two real columns of a pair of eigenvalues are one complex column
  std::vector<Lanes> y_;
};

/// h^power in each lane, power >= 0.
inline Lanes powerOf(const Lanes& h, int power) {
  Lanes f = 1.0;
  for (int i = 0; i < power; ++i) f *= h;
  return f;
}

/// Reads entries (i, m) of a matrix by columns of n numbers.
inline auto entriesOf(const Lanes* matrix, Index n) {
  return [matrix, n](Index i, Index m) -> const Lanes& { return matrix[i + m * n]; };
}

/// Calls write(i, j, x) with x = sum_m read(i, m) C(m, j) for i < rows and all columns j of C.
template <class Read, class Write>
[[gnu::always_inline]] inline void laneProduct(Index rows, const Mat<double>& C, const Read& read, const Write& write) {
  withSize<5>(C.rows(), [&](auto s) {
    const double* const entries = C.data();
    const Index columns = C.cols();
    for (Index i = 0; i < rows; ++i) {
      const auto row = [&](const auto& in) {
        for (Index j = 0; j < columns; ++j) {
          const double* const c = entries + j * s;
          Lanes sum = c[0] * in(0);
          for (Index m = 1; m < s; ++m) sum += c[m] * in(m);
          write(i, j, sum);
        }
      };
      if constexpr (std::is_same_v<decltype(s), Index>) {
        row([&](Index m) { return read(i, m); });
      } else {
        std::array<Lanes, count(decltype(s)::value)> in_registers;
        for (Index m = 0; m < s; ++m) in_registers[count(m)] = read(i, m);
        row([&](Index m) { return in_registers[count(m)]; });
      }
    }
  });
}

}  // namespace irk
