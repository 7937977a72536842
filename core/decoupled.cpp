#include "core/decoupled.h"

#include "core/multiprecision.h"

namespace irk {

template <class Real>
Decoupled<Real>::Decoupled(const StageSolverSetup<Real>& setup, BlockForm<Real> form)
    : setup_(setup),
      form_(std::move(form)),
      T2_(form_.T * form_.T),
      scales_(setup.pattern->n),
      Y_(setup.pattern->n, setup.A.rows()),
      D1Y_(setup.pattern->n, setup.A.rows()),
      D2Y_(setup.pattern->n, setup.A.rows()),
      eta_(setup.pattern->n) {
  for (const auto& block : form_.blocks) {
    if (block.size == 1) {
      lu_index_.push_back(real_lu_.size());
      real_lu_.emplace_back(setup.pattern->n);
    } else {
      lu_index_.push_back(complex_lu_.size());
      complex_lu_.emplace_back(setup.pattern->n);
    }
  }
}

template <class Real>
Outcome Decoupled<Real>::factorize(std::span<const Linearization<Real>> at, const Real& h) {
  const Linearization<Real>& D = at.front();
  const Index n = setup_.pattern->n;
  at_ = &D;
  h_ = h;
  rowScales(setup_.row_powers, h, scales_);
  for (std::size_t k = 0; k < form_.blocks.size(); ++k) {
    const auto& block = form_.blocks[k];
    Outcome outcome = Outcome::kSuccess;
    if (block.size == 1) {
      auto& lu = real_lu_[lu_index_[k]];
      const Real m1 = h * block.mu.real();
      const Real m2 = m1 * m1;
      for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
          const Index e = j * n + i;
          lu.matrix()(i, j) = scales_[i] * (D.d0[e] + m1 * D.d1[e] + m2 * D.d2[e]);
        }
      }
      outcome = lu.factorize();
    } else {
      auto& lu = complex_lu_[lu_index_[k]];
      const Complex m1 = h * block.mu;
      const Complex m2 = m1 * m1;
      for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
          const Index e = j * n + i;
          lu.matrix()(i, j) =
              Complex(scales_[i] * (D.d0[e] + m1.real() * D.d1[e] + m2.real() * D.d2[e]),
                      scales_[i] * (m1.imag() * D.d1[e] + m2.imag() * D.d2[e]));
        }
      }
      outcome = lu.factorize();
    }
    if (outcome != Outcome::kSuccess) return outcome;
  }
  return Outcome::kSuccess;
}

// Subtracts what the blocks right of this one, already solved, contribute to its rows.
template <class Real>
void Decoupled<Real>::coupleRows(const typename BlockForm<Real>::Block& block) {
  for (Index i = block.start; i < block.start + block.size; ++i) {
    for (Index m = block.start + block.size; m < Y_.cols(); ++m) {
      const Real f1 = h_ * form_.T(i, m);
      const Real f2 = h_ * h_ * T2_(i, m);
      Y_.col(i) -= f1 * D1Y_.col(m) + f2 * D2Y_.col(m);
    }
  }
}

template <class Real>
void Decoupled<Real>::solveBlock(std::size_t index) {
  const auto& block = form_.blocks[index];
  const Index i = block.start;
  if (block.size == 1) {
    real_lu_[lu_index_[index]].solve(Y_.col(i));
    return;
  }
  for (Index k = 0; k < Y_.rows(); ++k) {
    eta_[k] = Complex(Y_(k, i), Real(block.sigma * Y_(k, i + 1)));
  }
  complex_lu_[lu_index_[index]].solve(eta_);
  for (Index k = 0; k < Y_.rows(); ++k) {
    Y_(k, i) = eta_[k].real();
    Y_(k, i + 1) = eta_[k].imag() / block.sigma;
  }
}

template <class Real>
void Decoupled<Real>::solve(Eigen::Ref<Mat<Real>> rhs) {
  const Sizes& n = setup_.sizes;
  Y_.noalias() = rhs * form_.Q_inverse.transpose();
  for (std::size_t k = form_.blocks.size(); k-- > 0;) {
    const auto& block = form_.blocks[k];
    if (!form_.diagonal) coupleRows(block);
    solveBlock(k);
    if (form_.diagonal || k == 0) continue;
    // D1 acts on (v, x), D2 on u: their other columns are zero.
    const auto D1 = at_->dense1().leftCols(n.nu + n.nx);
    const auto D2 = at_->dense2().leftCols(n.nu);
    for (Index j = block.start; j < block.start + block.size; ++j) {
      D1Y_.col(j).noalias() = D1 * Y_.col(j).head(n.nu + n.nx);
      D1Y_.col(j).array() *= scales_.array();
      D2Y_.col(j).noalias() = D2 * Y_.col(j).head(n.nu);
      D2Y_.col(j).array() *= scales_.array();
    }
  }
  rhs.noalias() = Y_ * form_.Q.transpose();
}

IRK_INSTANTIATE_CLASS(Decoupled)

}  // namespace irk
