// Sparse factors of several matrices side by side: one pass of vector instructions solves with all.
#pragma once

#include <span>
#include <vector>

#include "core/linear/sparse_lu.h"

namespace irk {

/// A solve with sparse factors waits for its own last result in every column; solves with other
/// matrices of the same pattern and pivots do not depend on it, and go along in the other lanes of a
/// vector register. Copies the factors; those of real matrices come first. Allocates in its
/// constructor, and where factors grow to more than twice what the analysis has foreseen.
class InterleavedLu {
 public:
  /// Right-hand side and solution of one matrix: re + i sigma im for a complex one, n entries each.
  struct Lane {
    double* re;
    double* im;    ///< nullptr for a real matrix
    double sigma;
    double inverse_sigma;
  };

  InterleavedLu(const SparseAnalysis& analysis, std::size_t matrices);

  /// False where the factors do not share their pivots: then each is to be solved by itself.
  [[nodiscard]] bool assign(std::span<const SparseLu<double>> real,
                            std::span<const SparseLu<std::complex<double>>> complex);
  /// In place, a lane for each matrix of the last `assign`, which was true, in its order.
  void solve(std::span<const Lane> lanes);

 private:
  /// Up to 8 matrices. Of each entry the real parts, padded to `width`, then the imaginary ones.
  struct Group {
    std::size_t first, lanes, width;
    std::vector<double> l, u, inverse_diagonal;
  };
  template <int kWidth>
  void solveGroup(const Group& group, std::span<const Lane> lanes);

  const SparsePivots* pivots_ = nullptr;  // of the first matrix and all
  std::vector<int> versions_;             // of the pivots when they were last compared
  bool shared_ = false;                   // then
  std::vector<Group> groups_;
  std::vector<double> work_;
};

}  // namespace irk
