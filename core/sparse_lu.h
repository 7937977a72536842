// Sparse LU: KLU orders a pattern once for any number of matrices, and chooses their pivots; with
// these a matrix is factorized again and solved here. Davis & Palamadai Natarajan, ACM TOMS 37 (2010),
// algorithm 907.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "core/outcome.h"
#include "core/scalar.h"

namespace irk {

/// The order of elimination of a pattern. Immutable: shared by factorizations and threads.
class SparseAnalysis {
 public:
  /// Compressed columns of an n x n pattern, rows ascending.
  SparseAnalysis(std::vector<int> column_start, std::vector<int> row);
  ~SparseAnalysis();
  SparseAnalysis(const SparseAnalysis&) = delete;
  SparseAnalysis& operator=(const SparseAnalysis&) = delete;

  Index n() const { return static_cast<Index>(column_start.size()) - 1; }
  const std::vector<int> column_start, row;

 private:
  template <class T>
  friend class SparseLu;
  struct Symbolic;
  std::unique_ptr<Symbolic> symbolic_;
};

/// T: double or std::complex<double>; any other scalar is refused by its constructor (Misuse).
/// Allocates in its constructor; KLU allocates where it pivots anew, and this class where they fill
/// more than twice as much as the analysis has foreseen. KLU's own refactorization
/// and solve, which divide complex numbers in every row, take 1.9 and 1.4 times as long (complex,
/// pentadiagonal, n = 100 and 2000).
template <class T>
class SparseLu {
 public:
  explicit SparseLu(std::shared_ptr<const SparseAnalysis> analysis);

  /// To be filled before `factorize`, in the order of the pattern.
  T* values() { return values_.data(); }

  /// With the pivots of the last factorization where they still serve, else
  /// with new ones. kSuccess, kSingular, kNotFinite.
  [[nodiscard]] Outcome factorize();

  /// In place; x has n entries, contiguous.
  void solve(T* x);

  /// min |u_ii| / max |u_ii|, a cheap estimate of the reciprocal condition.
  double reciprocalCondition() const { return condition_; }
  /// How often pivots were chosen.
  int pivotings() const { return pivotings_; }

 private:
  bool refactorize();
  bool pivot();

  std::shared_ptr<const SparseAnalysis> analysis_;
  Vec<T> values_;
  /// Factors L U = S A(p, q) of the permuted matrix, S its row scales, by columns: those of L below
  /// and those of U above the diagonal, rows ascending.
  using Size = typename Eigen::NumTraits<T>::Real;
  struct Factors {
    std::vector<int> l_start, l_row, u_start, u_row;
    std::vector<T> l, u, inverse_pivot;
    std::vector<int> p, q, row_of;        // row_of: the inverse of p
    std::vector<Size> scale;              // of the permuted rows, as when the pivots were chosen
    std::vector<int> source, target;      // of a column's values: where they come from and go
    std::vector<int> source_start;
    std::vector<double> klu_scale, re, im;  // scratch of `pivot`
  };
  Factors f_;
  std::vector<T> work_;
  bool pivoted_ = false;
  double condition_ = 0, chosen_at_ = 0;  // reciprocal; the latter when the pivots were chosen
  int pivotings_ = 0;
};

}  // namespace irk
