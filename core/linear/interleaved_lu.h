// Sparse LU of several matrices side by side: one pass with vector instructions factorizes or solves for all of them.
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_lu.h"

namespace irk {

/// Factorizes matrices S (D0 + m D1 + m^2 D2) of one pattern, which differ in the number m, with one order of pivots,
/// and solves with them. In sparse factors each column waits for the one before; other matrices do not, and use the
/// other lanes of a vector register. Neither the matrices nor their permutations are stored several times. Several
/// threads share the matrices among them; the results do not depend on their number. Allocates in its constructor, and
/// where pivots fill more than twice as much as the analysis predicts.
class InterleavedLu {
 public:
  /// The entries of D0, D1 and D2 in the order of the pattern, and the diagonal of S.
  struct Pencil {
    const double *d0, *d1, *d2, *row_scales;
  };
  /// Right-hand side and solution for one matrix, n entries each: re for a real matrix, re + i sigma im for a
  /// complex one. The caller owns the numbers.
  struct Lane {
    double* re;
    double* im;  ///< nullptr for a real matrix
    double sigma;
    double inverse_sigma;
  };

  /// `threads`: at least 1.
  InterleavedLu(std::shared_ptr<const SparseAnalysis> analysis, std::size_t matrices, int threads = 1);

  /// One matrix for each m; a real m makes a real matrix. Keeps the pivots of the last factorization if they are good
  /// for all of them, else takes those that KLU chooses for the first matrix. Returns false if no pivots are good for
  /// all: a matrix is singular, not finite, or too different from the first; then factorize each alone.
  [[nodiscard]] bool factorize(const Pencil& pencil, std::span<const std::complex<double>> m);

  /// Solves in place, one lane for each matrix in the order of m. The last factorization must have succeeded.
  void solve(std::span<const Lane> lanes);

  /// Solves in place with the first matrix alone, which must be real; x has n entries.
  void solveFirst(double* x);

  /// How many times KLU has chosen pivots.
  int pivotings() const { return pivotings_; }

 private:
  /// Up to 8 matrices, for one thread at a time. Each entry holds the real parts, padded to `width`, then the imaginary
  /// parts.
  struct Group {
    Group(std::size_t first, std::size_t lanes, const SparseAnalysis& analysis);
    std::size_t first, lanes, width;
    std::vector<double> l, u, inverse_diagonal;
    std::vector<double> chosen_at;  // by lane: the reciprocal condition when the pivots were chosen
    std::vector<double> work;       // a column or right-hand side of all lanes
    bool good = false;              // whether the last factorization has succeeded
  };
  bool choosePivots(const Pencil& pencil, std::complex<double> m);
  bool refactorize(const Pencil& pencil, std::span<const std::complex<double>> m, bool fresh);
  template <int kWidth>
  bool refactorizeGroup(Group& group, const Pencil& pencil, std::span<const std::complex<double>> m, bool fresh);
  template <int kWidth>
  void solveGroup(Group& group, std::span<const Lane> lanes);

  std::shared_ptr<const SparseAnalysis> analysis_;
  PivotChoice<std::complex<double>> choice_;
  SparsePivots pivots_;
  bool pivoted_ = false;
  int pivotings_ = 0;
  std::vector<Group> groups_;
  std::vector<double> l_, u_, inverse_diagonal_;  // of the first matrix, if it is real: a contiguous copy
  int threads_;
};

}  // namespace irk
