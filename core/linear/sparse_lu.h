// Sparse LU. KLU orders a pattern once for any number of matrices and chooses their pivots. Refactorization with
// these pivots, and solves, are done here. Davis & Palamadai Natarajan, ACM TOMS 37 (2010), algorithm 907.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "irk/outcome.h"
#include "irk/scalar.h"

namespace irk {

struct SparsePivots;

/// The order of elimination for a pattern. Immutable; may be shared by factorizations and threads.
class SparseAnalysis {
 public:
  /// Takes the compressed columns of an n x n pattern, rows ascending. Throws Misuse if KLU cannot analyse it.
  SparseAnalysis(std::vector<int> column_start, std::vector<int> row);
  ~SparseAnalysis();
  SparseAnalysis(const SparseAnalysis&) = delete;
  SparseAnalysis& operator=(const SparseAnalysis&) = delete;

  Index n() const { return static_cast<Index>(column_start.size()) - 1; }
  /// Numbers of entries of L and of U if all pivots are on the diagonal.
  std::size_t lowerEntries() const;
  std::size_t upperEntries() const;
  /// Reserves memory for twice as many entries.
  void reserve(SparsePivots& pivots) const;
  const std::vector<int> column_start, row;

 private:
  template <class T>
  friend class PivotChoice;
  struct Symbolic;
  std::unique_ptr<Symbolic> symbolic_;
};

/// The factors L U = S A(p, q) without their values: the permutations p and q, the scales S of the permuted rows,
/// and the patterns of L below and of U above the diagonal, by columns, rows ascending.
struct SparsePivots {
  std::vector<int> l_start, l_row, u_start, u_row;
  std::vector<int> p, q;
  std::vector<double> scale;
  std::vector<int> source_start, source, target;  ///< by column: entries of A, and their rows in the permuted A

  bool operator==(const SparsePivots&) const = default;
};

namespace detail {

/// Resizes x; reserves twice the size when x has to grow. Pivots off the diagonal fill more than the analysis
/// predicts, and more may follow.
template <class Entry>
void fit(std::vector<Entry>& x, std::size_t size) {
  if (x.capacity() < size) x.reserve(2 * size);
  x.resize(size);
}

}  // namespace detail

/// Pivots are kept as long as the ratio of the smallest to the largest one is at least this part of the ratio at the
/// time of their choice.
inline constexpr double kSmallerPivot = 1e-3;
/// Pivots of another matrix are taken if no entry of L exceeds this: then KLU might have chosen them itself.
inline constexpr double kMostMultiplier = 1e3;

/// KLU's choice of pivots for a matrix. T is double or std::complex<double>; for any other scalar the constructor
/// throws Misuse. Allocates in its constructor; `choose` lets KLU allocate, and allocates where the pivots fill more
/// than twice as much as the analysis predicts.
template <class T>
class PivotChoice {
 public:
  explicit PivotChoice(std::shared_ptr<const SparseAnalysis> analysis);

  /// The entries of the matrix, in the order of the pattern. Fill all of them before `choose`, which keeps them.
  T* values() { return values_.data(); }
  const Vec<T>& entries() const { return values_; }

  /// Returns false if the matrix is singular or not finite.
  [[nodiscard]] bool choose(SparsePivots& pivots);

 private:
  std::shared_ptr<const SparseAnalysis> analysis_;
  Vec<T> values_;
  std::vector<int> row_of_;
  std::vector<double> re_, im_;
};

/// Sparse LU of an n x n matrix. T is double or std::complex<double>; for any other scalar the constructor throws
/// Misuse. Allocates in its constructor; later only KLU allocates, when it chooses new pivots, and this class, when
/// these fill more than twice as much as the analysis predicts. KLU's own refactorization and solve, which divide
/// complex numbers in every row, take 1.9 and 1.4 times as long (complex, pentadiagonal, n = 100 and 2000).
template <class T>
class SparseLu {
 public:
  explicit SparseLu(std::shared_ptr<const SparseAnalysis> analysis);

  /// The entries, in the order of the pattern. Fill all of them before `factorize`, which keeps them.
  T* values() { return choice_.values(); }

  /// Factorizes with the pivots of the last factorization if they are still good; else with `others`, the pivots of
  /// a similar matrix, if they are good; else with new pivots. `rather`: tries `others` first. Returns kSuccess,
  /// kSingular or kNotFinite.
  [[nodiscard]] Outcome factorize(const SparsePivots* others = nullptr, bool rather = false);

  /// Solves in place; x has n contiguous entries. The last factorization must have succeeded.
  void solve(T* x);

  /// min |u_ii| / max |u_ii|: a cheap estimate of the reciprocal condition.
  double reciprocalCondition() const { return condition_; }
  /// How many times KLU has chosen pivots.
  int pivotings() const { return pivotings_; }

  /// Pivots of the last factorization. `version` changes with them; it is 0 if there are none.
  const SparsePivots& pivots() const { return pivots_; }
  int version() const { return pivoted_ ? version_ : 0; }

 private:
  using Real = typename Eigen::NumTraits<T>::Real;

  bool refactorize();
  bool adopt(const SparsePivots& pivots);
  bool pivot();

  std::shared_ptr<const SparseAnalysis> analysis_;
  PivotChoice<T> choice_;
  SparsePivots pivots_;
  std::vector<T> l_, u_, inverse_diagonal_;
  std::vector<T> work_;
  bool pivoted_ = false;
  int version_ = 0;
  double condition_ = 0, chosen_at_ = 0;  // reciprocal conditions: now, and when the pivots were chosen
  int pivotings_ = 0;
};

}  // namespace irk
