// Sparse LU: KLU orders a pattern once for any number of matrices, and chooses their pivots; with
// these a matrix is factorized again and solved here. Davis & Palamadai Natarajan, ACM TOMS 37 (2010),
// algorithm 907.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "irk/outcome.h"
#include "irk/scalar.h"

namespace irk {

struct SparsePivots;

/// The order of elimination of a pattern. Immutable: shared by factorizations and threads.
class SparseAnalysis {
 public:
  /// Compressed columns of an n x n pattern, rows ascending.
  SparseAnalysis(std::vector<int> column_start, std::vector<int> row);
  ~SparseAnalysis();
  SparseAnalysis(const SparseAnalysis&) = delete;
  SparseAnalysis& operator=(const SparseAnalysis&) = delete;

  Index n() const { return static_cast<Index>(column_start.size()) - 1; }
  /// Entries of L and of U that this order leads to if all pivots are on the diagonal.
  std::size_t lowerEntries() const;
  std::size_t upperEntries() const;
  /// Room for twice as many.
  void reserve(SparsePivots& pivots) const;
  const std::vector<int> column_start, row;

 private:
  template <class T>
  friend class SparseLu;
  struct Symbolic;
  std::unique_ptr<Symbolic> symbolic_;
};

/// Factors L U = S A(p, q) but for their values: the order of elimination with its pivots, the scales S of
/// the permuted rows, and the pattern, by columns: that of L below and that of U above the diagonal,
/// rows ascending.
struct SparsePivots {
  std::vector<int> l_start, l_row, u_start, u_row;
  std::vector<int> p, q;
  std::vector<double> scale;
  std::vector<int> source_start, source, target;  ///< a column's values: where they come from and go

  bool operator==(const SparsePivots&) const = default;
};

namespace detail {

/// Pivots beside the diagonal fill more than the analysis foresees: there is room for twice as much.
template <class Entry>
void fit(std::vector<Entry>& x, std::size_t size) {
  if (x.capacity() < size) x.reserve(2 * size);
  x.resize(size);
}

}  // namespace detail

/// T: double or std::complex<double>; any other scalar is refused by its constructor (Misuse).
/// Allocates in its constructor; KLU allocates where it pivots anew, and this class where they fill more
/// than twice as much as the analysis has foreseen. KLU's own refactorization
/// and solve, which divide complex numbers in every row, take 1.9 and 1.4 times as long (complex,
/// pentadiagonal, n = 100 and 2000).
template <class T>
class SparseLu {
 public:
  explicit SparseLu(std::shared_ptr<const SparseAnalysis> analysis);

  /// To be filled before `factorize`, in the order of the pattern.
  T* values() { return values_.data(); }

  /// With the pivots of the last factorization where they still serve, else with the `others` of a like
  /// matrix where they do, else with new ones; `rather`: with the others first. kSuccess, kSingular,
  /// kNotFinite.
  [[nodiscard]] Outcome factorize(const SparsePivots* others = nullptr, bool rather = false);

  /// In place; x has n entries, contiguous.
  void solve(T* x);

  /// min |u_ii| / max |u_ii|, a cheap estimate of the reciprocal condition.
  double reciprocalCondition() const { return condition_; }
  /// How often pivots were chosen.
  int pivotings() const { return pivotings_; }

  /// Of the last factorization, if any; `version` changes with them and is 0 without. The values of L and
  /// U in their order, and the inverses of the diagonal of U.
  const SparsePivots& pivots() const { return pivots_; }
  int version() const { return pivoted_ ? version_ : 0; }
  const std::vector<T>& lower() const { return l_; }
  const std::vector<T>& upper() const { return u_; }
  const std::vector<T>& inverseDiagonal() const { return inverse_diagonal_; }

 private:
  using Real = typename Eigen::NumTraits<T>::Real;

  bool refactorize();
  bool adopt(const SparsePivots& pivots);
  bool pivot();

  std::shared_ptr<const SparseAnalysis> analysis_;
  Vec<T> values_;
  SparsePivots pivots_;
  std::vector<T> l_, u_, inverse_diagonal_;
  std::vector<T> work_;
  std::vector<int> row_of_;      // scratch of `pivot`
  std::vector<double> re_, im_;
  bool pivoted_ = false;
  int version_ = 0;
  double condition_ = 0, chosen_at_ = 0;  // reciprocal; the latter when the pivots were chosen
  int pivotings_ = 0;
};

}  // namespace irk
