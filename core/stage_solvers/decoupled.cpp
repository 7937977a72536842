#include "core/stage_solvers/decoupled.h"

#include <algorithm>
#include <memory>

#include "core/base/small_product.h"
#include "core/base/threads.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// An eigenvalue of A from the Schur form and the same one from the eigenbasis differ by round-off. They count as
// equal up to this multiple of eps.
constexpr double kSameEigenvalue = 1e4;
// Sparse blocks that have no common order of pivots are factorized one by one for so many factorizations.
constexpr int kApart = 10;

}  // namespace

template <class Real, template <class> class Lu>
Decoupled<Real, Lu>::Decoupled(const StageSolverSetup<Real>& setup)
    : setup_(setup),
      form_(*setup_.form),
      outcomes_(form_.blocks.size()),
      scales_(setup.pattern->n),
      Y_(setup.pattern->n, setup.A.rows()),
      D1Y_(setup.pattern->n, form_.diagonal ? 0 : setup.A.rows()),
      D2Y_(setup.pattern->n, D1Y_.cols()) {
  if constexpr (kSparse) {
    if (!setup_.analysis) {
      setup_.analysis = std::make_shared<const SparseAnalysis>(setup.pattern->column_start, setup.pattern->row);
    }
    if (form_.diagonal && form_.blocks.size() > 1) {
      together_.emplace(setup_.analysis, form_.blocks.size(), setup_.threads);
      lane_m_.resize(form_.blocks.size());
      for (const Index size : {1, 2}) {  // real blocks first
        for (std::size_t k = 0; k < form_.blocks.size(); ++k) {
          const auto& block = form_.blocks[k];
          if (block.size != size) continue;
          double* const re = Y_.col(block.start).data();
          double* const im = size == 1 ? nullptr : re + Y_.rows();
          lane_block_.push_back(k);
          lanes_.push_back({re, im, block.sigma, 1 / block.sigma});
        }
      }
      return;
    }
  }
  if constexpr (kInverts) {
    if (BlockInverses::pay(setup.pattern->n, setup.A.rows())) {
      inverses_.emplace(form_, setup_.row_powers, setup.pattern->n);
      return;
    }
  }
  makeFactors();
}

template <class Real, template <class> class Lu>
void Decoupled<Real, Lu>::makeFactors() {
  eta_.assign(form_.diagonal ? form_.blocks.size() : 1, Vec<Complex>(setup_.pattern->n));
  const auto add = [&](const auto& shape) {
    for (const auto& block : form_.blocks) {
      lu_index_.push_back(block.size == 1 ? real_lu_.size() : complex_lu_.size());
      if (block.size == 1) {
        real_lu_.emplace_back(shape);
      } else {
        complex_lu_.emplace_back(shape);
      }
    }
  };
  if constexpr (kSparse) {
    add(setup_.analysis);
    setup_.analysis->reserve(pivots_);
  } else {
    add(setup_.pattern->n);
  }
}

// Tries to factorize all sparse blocks with one order of pivots. If no order serves all, as at the start of a system
// whose rows are scaled by powers of h, the next factorizations do not try.
template <class Real, template <class> class Lu>
bool Decoupled<Real, Lu>::factorizeTogether() {
  gathered_ = false;
  if (!together_ || apart_-- > 0) return false;
  for (std::size_t i = 0; i < lane_m_.size(); ++i) lane_m_[i] = h_ * form_.blocks[lane_block_[i]].mu;
  if constexpr (kSparse) {
    gathered_ = together_->factorize({at_->d0.data(), at_->d1.data(), at_->d2.data(), scales_.data()}, lane_m_);
  }
  apart_ = gathered_ ? 0 : kApart;
  if (!gathered_ && lu_index_.empty()) makeFactors();
  return gathered_;
}

// The blocks are independent of each other, so that any number of threads gives the same bits. Sparse blocks try the
// pivots of the first block.
template <class Real, template <class> class Lu>
Outcome Decoupled<Real, Lu>::factorize(std::span<const Linearization<Real>> at, const Real& h) {
  at_ = &at.front();
  h_ = h;
  rowScales(setup_.row_powers, h, scales_);
  if (factorizeTogether()) return Outcome::kSuccess;
  const std::size_t blocks = form_.blocks.size();
  std::size_t done = 0;
  if constexpr (kSparse) {
    if (version_ == 0) outcomes_[done++] = factorizeBlock(0);
    const auto copy = [this](const auto& first) {
      news_ = version_ != first.version();
      if (news_) pivots_ = first.pivots();
      version_ = first.version();
    };
    form_.blocks.front().size == 1 ? copy(real_lu_.front()) : copy(complex_lu_.front());
  }
  onThreads(setup_.threads, blocks - done, [&](std::size_t k) { outcomes_[done + k] = factorizeBlock(done + k); });
  const auto failed =
      std::find_if(outcomes_.begin(), outcomes_.end(), [](Outcome o) { return o != Outcome::kSuccess; });
  return failed == outcomes_.end() ? Outcome::kSuccess : *failed;
}

template <class Real, template <class> class Lu>
Outcome Decoupled<Real, Lu>::factorizeBlock(std::size_t index) {
  const auto& block = form_.blocks[index];
  const Linearization<Real>& D = *at_;
  const Complex m1 = h_ * block.mu;
  const Complex m2 = m1 * m1;
  const auto re = [&](Index k, Index row) {
    return Real(scales_[row] * (D.d0[k] + m1.real() * D.d1[k] + m2.real() * D.d2[k]));
  };
  const auto entry = [&](Index k, Index row) {
    return Complex(re(k, row), Real(scales_[row] * (m1.imag() * D.d1[k] + m2.imag() * D.d2[k])));
  };
  const auto factorized = [&](auto& lu, const auto& entryAt) {
    if constexpr (kSparse) {
      setup_.pattern->forEach([&, values = lu.values()](Index k, Index row) { values[k] = entryAt(k, row); });
      return lu.factorize(version_ == 0 ? nullptr : &pivots_, news_);
    } else {
      const Index n = setup_.pattern->n;
      for (Index j = 0; j < n; ++j) {
        lu.fillColumn(j, [&](Index i) { return entryAt(j * n + i, i); });
      }
      return lu.factorize();
    }
  };
  if constexpr (kInverts) {
    if (inverses_) return inverses_->invert(index, D, h_, scales_);
  }
  return block.size == 1 ? factorized(real_lu_[lu_index_[index]], re)
                         : factorized(complex_lu_[lu_index_[index]], entry);
}

// Subtracts the contributions of the blocks to the right of this one, which are solved already, from its rows.
template <class Real, template <class> class Lu>
template <class Size>
void Decoupled<Real, Lu>::coupleRows(const typename BlockForm<Real>::Block& block, Size n) {
  for (Index i = block.start; i < block.start + block.size; ++i) {
    Real* const y = Y_.data() + i * n;
    for (Index m = block.start + block.size; m < Y_.cols(); ++m) {
      const Real f1 = h_ * form_.T(i, m);
      const Real f2 = h_ * h_ * form_.T2(i, m);
      const Real *const d1 = D1Y_.data() + m * n, *const d2 = D2Y_.data() + m * n;
      for (Index k = 0; k < n; ++k) y[k] -= f1 * d1[k] + f2 * d2[k];
    }
  }
}

// Multiplies D1 and D2 by a column of Y. D1 acts on (v, x) and D2 on u; their other columns are zero.
template <class Real, template <class> class Lu>
template <class Size>
void Decoupled<Real, Lu>::multiply(Index column, Size n) {
  const Index nu = setup_.sizes.nu, rates = nu + setup_.sizes.nx;
  auto D1y = D1Y_.col(column);
  auto D2y = D2Y_.col(column);
  const auto y = Y_.col(column);
  if constexpr (kSparse) {
    const Pattern& pattern = *setup_.pattern;
    D1y.setZero();
    D2y.setZero();
    for (Index j = 0; j < rates; ++j) {
      const auto c = static_cast<std::size_t>(j);
      for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
        const Index row = pattern.row[static_cast<std::size_t>(k)];
        D1y[row] += at_->d1[k] * y[j];
        D2y[row] += at_->d2[k] * y[j];
      }
    }
  } else {
    const auto times = [n, &y](const Vec<Real>& D, Index columns, Real* out) {
      std::fill_n(out, n, Real(0));
      for (Index j = 0; j < columns; ++j) detail::subtract(out, D.data() + j * n, Real(-y[j]), n);
    };
    times(at_->d1, rates, D1y.data());
    times(at_->d2, nu, D2y.data());
  }
  D1y.array() *= scales_.array();
  D2y.array() *= scales_.array();
}

template <class Real, template <class> class Lu>
void Decoupled<Real, Lu>::solveBlock(std::size_t index) {
  const auto& block = form_.blocks[index];
  const Index i = block.start;
  if (block.size == 1) {
    real_lu_[lu_index_[index]].solve(Y_.col(i).data());
    return;
  }
  Vec<Complex>& eta = eta_[form_.diagonal ? index : 0];
  for (Index k = 0; k < Y_.rows(); ++k) {
    eta[k] = Complex(Y_(k, i), Real(block.sigma * Y_(k, i + 1)));
  }
  complex_lu_[lu_index_[index]].solve(eta.data());
  for (Index k = 0; k < Y_.rows(); ++k) {
    Y_(k, i) = eta[k].real();
    Y_(k, i + 1) = eta[k].imag() / block.sigma;
  }
}

// Multiplies by the inverses of the blocks. One decision on n serves for all loops.
template <class Real, template <class> class Lu>
template <class Size>
void Decoupled<Real, Lu>::solveByInverses(Real* rhs, Index stride, Size n) {
  inlinedProduct(rhs, stride, n, form_.to_basis, Y_.data(), n);
  for (std::size_t k = form_.blocks.size(); k-- > 0;) {
    const auto& block = form_.blocks[k];
    if (!form_.diagonal) coupleRows(block, n);
    inverses_->multiply(k, Y_.data() + block.start * n, n);
    if (form_.diagonal || k == 0) continue;
    for (Index j = block.start; j < block.start + block.size; ++j) multiply(j, n);
  }
  inlinedProduct(Y_.data(), n, n, form_.from_basis, rhs, stride);
}

template <class Real, template <class> class Lu>
bool Decoupled<Real, Lu>::solveReal(const Real& mu, Real* x) {
  using std::abs;
  const Real most = Real(kSameEigenvalue) * Eigen::NumTraits<Real>::epsilon() * abs(mu);
  for (std::size_t k = 0; k < form_.blocks.size(); ++k) {
    const auto& block = form_.blocks[k];
    if (block.size != 1 || abs(Real(block.mu.real() - mu)) > most) continue;
    if constexpr (kInverts) {
      if (inverses_) {
        withSize<kSmallInverse>(Y_.rows(), [&](auto n) { inverses_->multiply(k, x, n); });
        return true;
      }
    }
    if (!gathered_) {
      real_lu_[lu_index_[k]].solve(x);
      return true;
    }
    if (k != lane_block_.front()) return false;
    if constexpr (kSparse) together_->solveFirst(x);
    return true;
  }
  return false;
}

template <class Real, template <class> class Lu>
void Decoupled<Real, Lu>::solve(Eigen::Ref<Mat<Real>> rhs) {
  if constexpr (kInverts) {
    if (inverses_) {
      return withSize<kSmallInverse>(Y_.rows(), [&](auto n) { solveByInverses(rhs.data(), rhs.outerStride(), n); });
    }
  }
  const Index n = Y_.rows(), stride = rhs.outerStride();
  productOnThreads(setup_.threads, rhs.data(), stride, n, form_.to_basis, Y_.data(), n);
  solveBlocks();
  productOnThreads(setup_.threads, Y_.data(), n, n, form_.from_basis, rhs.data(), stride);
}

// Solves with all blocks, in Y_. In a block triangular form each needs those to the right of it.
template <class Real, template <class> class Lu>
void Decoupled<Real, Lu>::solveBlocks() {
  if (gathered_) return together_->solve(lanes_);
  if (form_.diagonal) {
    return onThreads(setup_.threads, form_.blocks.size(), [&](std::size_t k) { solveBlock(k); });
  }
  for (std::size_t k = form_.blocks.size(); k-- > 0;) {
    const auto& block = form_.blocks[k];
    coupleRows(block, Y_.rows());
    solveBlock(k);
    if (k == 0) continue;
    for (Index j = block.start; j < block.start + block.size; ++j) multiply(j, Y_.rows());
  }
}

template class Decoupled<double, DenseLu>;
template class Decoupled<BigFloat, DenseLu>;
template class Decoupled<double, SparseLu>;

}  // namespace irk
