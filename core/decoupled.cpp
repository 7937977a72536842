#include "core/decoupled.h"

#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include "core/misuse.h"
#include "core/multiprecision.h"

namespace irk {
namespace {

// The condition of the unit eigenvectors grows by 3.7 per stage for Gauss (theory.md); 5 with a margin
// tells a defective A (condition 1e8 and more at small s) from a merely high order.
constexpr double kEigenConditionGrowth = 5;
constexpr double kEigenConditionPerStage = 1e3;

// A block [[alpha, beta], [gamma, alpha]], beta gamma < 0, acts on y1 + i sigma y2 as multiplication
// by mu = alpha + i gamma sigma if sigma^2 = -beta / gamma.
template <class Real>
void appendBlocks(BlockForm<Real>& form) {
  using std::sqrt;
  const Index s = form.T.rows();
  for (Index i = 0; i < s;) {
    if (i + 1 < s && form.T(i + 1, i) != Real(0)) {
      const Real beta = form.T(i, i + 1);
      const Real gamma = form.T(i + 1, i);
      const Real sigma = sqrt(Real(-beta / gamma));
      form.blocks.push_back({i, 2, {form.T(i, i), Real(gamma * sigma)}, sigma});
      i += 2;
    } else {
      form.blocks.push_back({i, 1, {form.T(i, i), Real(0)}, Real(0)});
      i += 1;
    }
  }
}

}  // namespace

template <class Real>
BlockForm<Real> schurForm(const Mat<Real>& A) {
  const Eigen::RealSchur<Mat<Real>> schur(A);
  BlockForm<Real> form;
  form.Q = schur.matrixU();
  form.Q_inverse = form.Q.transpose();
  form.T = schur.matrixT();
  // Eigen splits real pairs but leaves the diagonal entries of complex pairs unequal.
  for (Index i = 0; i + 1 < A.rows(); ++i) {
    if (form.T(i + 1, i) != Real(0)) {
      // Rotate [[a, b], [c, d]] to equal diagonal entries: tan 2 phi = (a - d) / (b + c).
      using std::atan2;
      using std::cos;
      using std::sin;
      const Real phi = atan2(Real(form.T(i, i) - form.T(i + 1, i + 1)),
                             Real(form.T(i, i + 1) + form.T(i + 1, i))) / Real(2);
      const Eigen::JacobiRotation<Real> rotation(Real(cos(phi)), Real(sin(phi)));
      form.T.applyOnTheLeft(i, i + 1, rotation.adjoint());
      form.T.applyOnTheRight(i, i + 1, rotation);
      form.Q.applyOnTheRight(i, i + 1, rotation);
      const Real mean = (form.T(i, i) + form.T(i + 1, i + 1)) / Real(2);
      form.T(i, i) = mean;
      form.T(i + 1, i + 1) = mean;
      ++i;
    }
  }
  form.Q_inverse = form.Q.transpose();
  appendBlocks(form);
  return form;
}

template <class Real>
BlockForm<Real> eigenForm(const Mat<Real>& A) {
  const Eigen::EigenSolver<Mat<Real>> solver(A);
  const auto values = solver.eigenvalues();
  const auto vectors = solver.eigenvectors();
  const Index s = A.rows();
  BlockForm<Real> form;
  form.diagonal = true;
  form.Q.setZero(s, s);
  form.T.setZero(s, s);
  for (Index i = 0; i < s;) {
    const Real alpha = values[i].real();
    const Real omega = values[i].imag();
    form.T(i, i) = alpha;
    for (Index k = 0; k < s; ++k) form.Q(k, i) = vectors(k, i).real();
    if (omega == Real(0)) {
      i += 1;
      continue;
    }
    // A [x y] = [x y] [[alpha, omega], [-omega, alpha]] for the eigenvector x + i y.
    for (Index k = 0; k < s; ++k) form.Q(k, i + 1) = vectors(k, i).imag();
    form.T(i + 1, i + 1) = alpha;
    form.T(i, i + 1) = omega;
    form.T(i + 1, i) = -omega;
    i += 2;
  }
  // A double zero eigenvalue of a defective A comes out as two eigenvectors that agree to the square
  // root of round-off or better; the worst regular family has condition 3.7^s (theory.md).
  const Eigen::FullPivLU<Mat<Real>> lu(form.Q);
  form.Q_inverse = lu.inverse();
  const double condition =
      static_cast<double>(form.Q.cwiseAbs().maxCoeff() * form.Q_inverse.cwiseAbs().maxCoeff());
  const double limit = kEigenConditionPerStage * std::pow(kEigenConditionGrowth, double(s));
  if (!lu.isInvertible() || !(condition < limit)) {
    throw Misuse("illegal combination: solver 'eigen' with a defective A (condition of its "
                 "eigenvectors " + std::to_string(condition) + ", allowed below " +
                 std::to_string(limit) + "); use solver 'schur' or 'coupled_dense'");
  }
  appendBlocks(form);
  return form;
}

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

template BlockForm<double> schurForm(const Mat<double>&);
template BlockForm<mp50> schurForm(const Mat<mp50>&);
template BlockForm<double> eigenForm(const Mat<double>&);
template BlockForm<mp50> eigenForm(const Mat<mp50>&);
IRK_INSTANTIATE_CLASS(Decoupled)

}  // namespace irk
