// Sparse LU by KLU: one symbolic analysis of a pattern for any number of matrices, and numeric
// refactorization. Davis & Palamadai Natarajan, ACM TOMS 37 (2010), algorithm 907.
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
/// Allocates in its constructor; KLU allocates where it pivots anew.
template <class T>
class SparseLu {
 public:
  explicit SparseLu(std::shared_ptr<const SparseAnalysis> analysis);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;

  /// To be filled before `factorize`, in the order of the pattern.
  T* values() { return values_.data(); }

  /// With the pivots of the last factorization where they still serve, else
  /// with new ones. kSuccess, kSingular, kNotFinite.
  [[nodiscard]] Outcome factorize();

  /// In place; x has n entries, contiguous.
  void solve(T* x);

  /// min |u_ii| / max |u_ii|, a cheap estimate of the reciprocal condition.
  double reciprocalCondition() const;
  /// How often pivots were chosen.
  int pivotings() const { return pivotings_; }

 private:
  bool refactorize();
  bool pivot();

  std::shared_ptr<const SparseAnalysis> analysis_;
  Vec<T> values_;
  struct Numeric;
  std::unique_ptr<Numeric> numeric_;
  int pivotings_ = 0;
};

}  // namespace irk
