// LU of D0 = dr/d(a, k, z) alone; dense or sparse, depending on the pattern. And the scaling by which it is judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/constants.h"
#include "core/derivatives/differentiator.h"
#include "core/linear/dense_lu.h"
#include "core/linear/sparse_lu.h"

namespace irk {

/// Scales the rows of a matrix D and then its columns by powers of two, so that the largest entry of each is in [1, 2).
/// Its rank then does not depend on the units of equations and unknowns: D = (-1 1e9; 0 1) is regular. A row that is
/// zero up to round-off, each entry below 1e-15 of the largest one of its column, is zero.
template <class Real>
class Equilibration {
 public:
  /// D becomes R D C; `values` are its entries in the order of the pattern.
  void apply(const Pattern& pattern, Real* values) {
    const auto forEach = [&](auto&& f) {
      for (Index j = 0; j < pattern.n; ++j) {
        const auto c = static_cast<std::size_t>(j);
        for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
          f(static_cast<Index>(pattern.row[static_cast<std::size_t>(k)]), j, values[k]);
        }
      }
    };
    using std::abs;
    const auto largestOfColumns = [&] {
      columns_.setZero(pattern.n);
      forEach([&](Index, Index j, const Real& d) { columns_[j] = std::max<Real>(columns_[j], abs(d)); });
    };
    largestOfColumns();
    rows_.setZero(pattern.n);
    forEach([&](Index i, Index j, const Real& d) {
      if (abs(d) > Real(kSingularPivot.value) * columns_[j]) rows_[i] = std::max<Real>(rows_[i], abs(d));
    });
    takeReciprocals(rows_);
    forEach([&](Index i, Index, Real& d) { d *= rows_[i]; });
    largestOfColumns();
    takeReciprocals(columns_);
    forEach([&](Index, Index j, Real& d) { d *= columns_[j]; });
  }
  /// D x = r is (R D C) y = R r with x = C y.
  void scaleRight(Vec<Real>& r) const { r.array() *= rows_.array(); }
  void scaleBack(Vec<Real>& y) const { y.array() *= columns_.array(); }

 private:
  // Powers of two; that of zero is zero.
  static void takeReciprocals(Vec<Real>& sizes) {
    for (Real& size : sizes) {
      const double value = static_cast<double>(size);
      if (value > 0 && std::isfinite(value)) size = Real(std::exp2(-std::ilogb(value)));
    }
  }

  Vec<Real> rows_, columns_;
};

/// Owns a copy of the factorized matrix. Allocates only when the pattern changes.
template <class Real>
class RateLu {
 public:
  /// Returns kSuccess, kSingular or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] Outcome factorize(const Linearization<Real>& D) {
    if (!sameShape(pattern_, D.pattern)) adopt(D.pattern);
    std::copy_n(D.d0.data(), D.d0.size(), sparse_ ? sparse_->values() : dense_->values());
    if (!sparse_) return dense_->factorize();
    equilibration_.apply(*pattern_, sparse_->values());
    const Outcome outcome = sparse_->factorize();
    const bool singular = outcome == Outcome::kSuccess && sparse_->reciprocalCondition() < kSingularPivot;
    return singular ? Outcome::kSingular : outcome;
  }
  /// Solves in place; x has n entries.
  void solve(Vec<Real>& x) {
    if (!sparse_) return dense_->solve(x.data());
    equilibration_.scaleRight(x);
    sparse_->solve(x.data());
    equilibration_.scaleBack(x);
  }

 private:
  void adopt(std::shared_ptr<const Pattern> pattern) {
    pattern_ = std::move(pattern);
    dense_.reset();
    sparse_.reset();
    if (pattern_->full) {
      dense_ = std::make_unique<DenseLu<Real>>(pattern_->n);
    } else {
      sparse_ = std::make_unique<SparseLu<Real>>(
          std::make_shared<const SparseAnalysis>(pattern_->column_start, pattern_->row));
    }
  }

  std::shared_ptr<const Pattern> pattern_;
  std::unique_ptr<DenseLu<Real>> dense_;
  std::unique_ptr<SparseLu<Real>> sparse_;
  Equilibration<Real> equilibration_;  // of the sparse one
};

}  // namespace irk
