#include "core/linear/block_form.h"

#include <cmath>
#include <string>
#include <type_traits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/base/kept.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// For Gauss methods the condition of the unit eigenvectors grows by a factor of 3.7 per stage. The limit grows by 5
// per stage: it separates a defective A (condition 1e8 and more at small s) from an A of many stages.
constexpr double kEigenConditionGrowth = 5;
constexpr double kEigenConditionPerStage = 1e3;

// A block [[alpha, beta], [gamma, alpha]] with beta gamma < 0 multiplies y1 + i sigma y2 by
// mu = alpha + i gamma sigma if sigma^2 = -beta / gamma.
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

template <class Real>
BlockForm<Real> makeSchurForm(const Mat<Real>& A) {
  const Eigen::RealSchur<Mat<Real>> schur(A);
  BlockForm<Real> form;
  Mat<Real> Q = schur.matrixU();
  form.T = schur.matrixT();
  // Eigen splits real pairs into two blocks, but leaves the diagonal entries of complex pairs unequal.
  for (Index i = 0; i + 1 < A.rows(); ++i) {
    if (form.T(i + 1, i) != Real(0)) {
      // Rotate [[a, b], [c, d]] to equal diagonal entries: tan 2 phi = (a - d) / (b + c).
      using std::atan2;
      using std::cos;
      using std::sin;
      const Real phi =
          atan2(Real(form.T(i, i) - form.T(i + 1, i + 1)), Real(form.T(i, i + 1) + form.T(i + 1, i))) / Real(2);
      const Eigen::JacobiRotation<Real> rotation(Real(cos(phi)), Real(sin(phi)));
      form.T.applyOnTheLeft(i, i + 1, rotation.adjoint());
      form.T.applyOnTheRight(i, i + 1, rotation);
      Q.applyOnTheRight(i, i + 1, rotation);
      const Real mean = (form.T(i, i) + form.T(i + 1, i + 1)) / Real(2);
      form.T(i, i) = mean;
      form.T(i + 1, i + 1) = mean;
      ++i;
    }
  }
  form.to_basis = Q;
  form.from_basis = Q.transpose();
  appendBlocks(form);
  return form;
}

template <class Real>
BlockForm<Real> makeEigenForm(const Mat<Real>& A) {
  const Eigen::EigenSolver<Mat<Real>> solver(A);
  const auto& values = solver.eigenvalues();
  const auto vectors = solver.eigenvectors();
  const Index s = A.rows();
  BlockForm<Real> form;
  form.diagonal = true;
  Mat<Real> Q = Mat<Real>::Zero(s, s);
  form.T.setZero(s, s);
  for (Index i = 0; i < s;) {
    const Real alpha = values[i].real();
    const Real omega = values[i].imag();
    form.T(i, i) = alpha;
    for (Index k = 0; k < s; ++k) Q(k, i) = vectors(k, i).real();
    if (omega == Real(0)) {
      i += 1;
      continue;
    }
    // A [x y] = [x y] [[alpha, omega], [-omega, alpha]] for the eigenvector x + i y.
    for (Index k = 0; k < s; ++k) Q(k, i + 1) = vectors(k, i).imag();
    form.T(i + 1, i + 1) = alpha;
    form.T(i, i + 1) = omega;
    form.T(i + 1, i) = -omega;
    i += 2;
  }
  // For a double zero eigenvalue of a defective A, the eigenvectors found agree to the square root of round-off or
  // better, so that their condition is very large. The worst family with a regular A has condition 3.7^s.
  const Eigen::FullPivLU<Mat<Real>> lu(Q);
  const Mat<Real> Q_inverse = lu.inverse();
  const double condition = static_cast<double>(Q.cwiseAbs().maxCoeff() * Q_inverse.cwiseAbs().maxCoeff());
  const double limit = kEigenConditionPerStage * std::pow(kEigenConditionGrowth, double(s));
  if (!lu.isInvertible() || !(condition < limit)) {
    throw Misuse(
        "illegal combination: solver 'eigen' with a defective A (condition of its "
        "eigenvectors " +
        std::to_string(condition) + ", allowed below " + std::to_string(limit) +
        "); use solver 'schur' or 'coupled_dense'");
  }
  form.to_basis = Q_inverse.transpose();
  form.from_basis = Q.transpose();
  appendBlocks(form);
  return form;
}

// In multiprecision a form is made with twice the digits and then rounded: the eigenvectors of many stages lose most of
// the working digits.
std::shared_ptr<const BlockForm<BigFloat>> madePrecisely(const Mat<BigFloat>& A, auto make) {
  auto form = std::make_shared<BlockForm<BigFloat>>();
  {
    const WorkingDigits precise(std::min(2 * WorkingDigits::now(), WorkingDigits::kMost));
    *form = make(A);
  }
  form->to_basis = roundedToWork(form->to_basis);
  form->from_basis = roundedToWork(form->from_basis);
  form->T = roundedToWork(form->T);
  form->T2 = form->T * form->T;
  for (auto& block : form->blocks) {
    block.mu = {block.mu.real().rounded(), block.mu.imag().rounded()};
    block.sigma = block.sigma.rounded();
  }
  return form;
}

// `make` is an argument of the template: each form has its own cache.
template <class Real, auto make>
std::shared_ptr<const BlockForm<Real>> formOf(const Mat<Real>& A) {
  if constexpr (std::is_same_v<Real, double>) {
    static Kept<BlockForm<double>> kept;
    std::string key;
    appendKey(A, key);
    return kept.of(key, [&] {
      auto form = make(A);
      form.T2 = form.T * form.T;
      return form;
    });
  } else {
    return madePrecisely(A, make);
  }
}

}  // namespace

template <class Real>
std::shared_ptr<const BlockForm<Real>> schurForm(const Mat<Real>& A) {
  return formOf<Real, makeSchurForm<Real>>(A);
}

template <class Real>
std::shared_ptr<const BlockForm<Real>> eigenForm(const Mat<Real>& A) {
  return formOf<Real, makeEigenForm<Real>>(A);
}

template std::shared_ptr<const BlockForm<double>> schurForm(const Mat<double>&);
template std::shared_ptr<const BlockForm<BigFloat>> schurForm(const Mat<BigFloat>&);
template std::shared_ptr<const BlockForm<double>> eigenForm(const Mat<double>&);
template std::shared_ptr<const BlockForm<BigFloat>> eigenForm(const Mat<BigFloat>&);

}  // namespace irk
