#include "core/stage_solvers/decoupled.h"

#include <algorithm>
#include <memory>
#include <type_traits>

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

// Whether the blocks of s stages are inverted: with one stage of a few unknowns that does not pay.
bool inverts(Index n, Index s) { return n <= kMostInverted && (s > 1 || n > kSmallInverse); }
Index inverseSize(Index n) { return n <= kSmallInverse ? 4 * n * n : paddedSize(n); }

}  // namespace

template <class Real, template <class> class Lu>
Decoupled<Real, Lu>::Decoupled(const StageSolverSetup<Real>& setup)
    : setup_(setup),
      form_(*setup_.form),
      outcomes_(form_.blocks.size()),
      inverts_(kInverts && inverts(setup.pattern->n, setup.A.rows())),
      inverses_(inverts_ ? inverseSize(setup.pattern->n) : 0, inverts_ ? std::ssize(form_.blocks) : 0),
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
  if (!inverts_) makeFactors();
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
    if (inverts_) {
      return withSize<kSmallInverse>(setup_.pattern->n, [&](auto n) { return invertBlock(index, n); });
    }
  }
  return block.size == 1 ? factorized(real_lu_[lu_index_[index]], re)
                         : factorized(complex_lu_[lu_index_[index]], entry);
}

// Computes all entries of M first and scales rows afterwards: both loops become vector instructions.
template <class Real, template <class> class Lu>
template <class Size>
Outcome Decoupled<Real, Lu>::invertBlock(std::size_t index, Size n) {
  if constexpr (std::is_same_v<Size, Index>) {
    return n > 0 ? invertPaddedBlock(index, n) : Outcome::kSuccess;
  } else {
    return invertSmallBlock(index, n);
  }
}

template <class Real, template <class> class Lu>
template <class Size>
Outcome Decoupled<Real, Lu>::invertPaddedBlock(std::size_t index, Size n) {
  const auto& block = form_.blocks[index];
  const Index rows = paddedRows(n);
  const Complex m1 = h_ * block.mu;
  const Complex m2 = detail::product(m1, m1);
  Real* const re = inverseOf(index);
  const auto fill = [&](Real* plane, const auto& entry) {
    for (Index j = 0; j < n; ++j) {
      Real* const column = plane + j * rows;
      for (Index i = 0; i < n; ++i) column[i] = scales_[i] * entry(j * n + i);
      std::fill(column + n, column + rows, Real(0));
    }
  };
  const Real *const d0 = at_->d0.data(), *const d1 = at_->d1.data(), *const d2 = at_->d2.data();
  fill(re, [=](Index k) { return d0[k] + m1.real() * d1[k] + m2.real() * d2[k]; });
  if (block.size == 1) return invertPadded<1>(re, n);
  fill(re + n * rows, [=](Index k) { return m1.imag() * d1[k] + m2.imag() * d2[k]; });
  return invertPadded<2>(re, n);
}

// With M^-1 = P + i Q the solution of M (z1 + i sigma z2) = y1 + i sigma y2 is
// [[P, -sigma Q], [Q / sigma, P]] (y1, y2).
template <class Real, template <class> class Lu>
template <class Size>
Outcome Decoupled<Real, Lu>::invertSmallBlock(std::size_t index, Size n) {
  const auto& block = form_.blocks[index];
  Real* const inverse = inverseOf(index);
  const Real *const d0 = at_->d0.data(), *const d1 = at_->d1.data(), *const d2 = at_->d2.data();
  const Complex m1 = h_ * block.mu;
  const Complex m2 = detail::product(m1, m1);
  SmallMatrix split;
  Real *const re = split.data(), *const im = re + n * n;
  for (Index k = 0; k < n * n; ++k) re[k] = d0[k] + m1.real() * d1[k] + m2.real() * d2[k];
  for (Index k = 0; k < n * n; ++k) im[k] = m1.imag() * d1[k] + m2.imag() * d2[k];
  for (Index i = 0; i < n; ++i) {
    if (setup_.row_powers[static_cast<std::size_t>(i)] == 0) continue;
    for (Index k = i; k < 2 * n * n; k += n) re[k] *= scales_[i];
  }
  if (block.size == 1) {
    const Outcome outcome = invert<1>(split, n);
    std::copy_n(re, n * n, inverse);
    return outcome;
  }
  const Outcome outcome = invert<2>(split, n);
  const Real divided = Real(1) / block.sigma;
  for (Index j = 0; j < n; ++j) {
    const Real *const P = split.data() + j * n, *const Q = P + n * n;
    Real *const left = inverse + j * 2 * n, *const right = left + 2 * n * n;
    for (Index i = 0; i < n; ++i) {
      left[i] = right[n + i] = P[i];
      left[n + i] = divided * Q[i];
      right[i] = -block.sigma * Q[i];
    }
  }
  return outcome;
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

// Multiplies the right-hand side of block k, in Y_, by the inverse.
template <class Real, template <class> class Lu>
template <class Size>
void Decoupled<Real, Lu>::multiplyByInverse(std::size_t k, Size n) {
  const auto& block = form_.blocks[k];
  Real* const y = Y_.data() + block.start * n;
  Real* const inverse = inverseOf(k);
  if constexpr (!std::is_same_v<Size, Index>) {
    constexpr Index kSize = Size::value;
    if (block.size == 1) return multiplySmall(inverse, y, n);
    multiplySmall(inverse, y, std::integral_constant<Index, 2 * kSize>());
  } else {
    if (block.size == 1) return multiplyPadded<1>(inverse, n, y);
    Real* const z = y + n;
    const Real divided = Real(1) / block.sigma;
    for (Index i = 0; i < n; ++i) z[i] *= block.sigma;
    multiplyPadded<2>(inverse, n, y, z);
    for (Index i = 0; i < n; ++i) z[i] *= divided;
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
    multiplyByInverse(k, n);
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
      if (inverts_) {
        const Index n = Y_.rows();
        if (n > kSmallInverse) {
          multiplyPadded<1>(inverseOf(k), n, x);
        } else {
          withSize<kSmallInverse>(n, [&](auto size) { multiplySmall(inverseOf(k), x, size); });
        }
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
    if (inverts_) {
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
