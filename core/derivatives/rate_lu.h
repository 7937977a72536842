// LU of D0 = dr/d(a, k, z) alone; dense or sparse, depending on the pattern.
#pragma once

#include <algorithm>
#include <memory>

#include "core/base/constants.h"
#include "core/derivatives/differentiator.h"
#include "core/linear/dense_lu.h"
#include "core/linear/sparse_lu.h"

namespace irk {

/// Owns a copy of the factorized matrix. Allocates only when the pattern changes.
template <class Real>
class RateLu {
 public:
  /// Returns kSuccess, kSingular or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] Outcome factorize(const Linearization<Real>& D) {
    if (!sameShape(pattern_, D.pattern)) adopt(D.pattern);
    std::copy_n(D.d0.data(), D.d0.size(), sparse_ ? sparse_->values() : dense_->values());
    if (!sparse_) return dense_->factorize();
    const Outcome outcome = sparse_->factorize();
    const bool singular = outcome == Outcome::kSuccess && sparse_->reciprocalCondition() < kSingularPivot;
    return singular ? Outcome::kSingular : outcome;
  }
  /// Solves in place; x has n entries.
  void solve(Vec<Real>& x) { sparse_ ? sparse_->solve(x.data()) : dense_->solve(x.data()); }

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
};

}  // namespace irk
