#include "core/dense_output.h"

#include <cmath>

#include "core/multiprecision.h"
#include "core/small_product.h"

namespace irk {
namespace {

template <class Real>
Real xi(Index k) {
  using std::sqrt;
  const Real j = Real(static_cast<double>(k));
  return Real(1) / (Real(2) * sqrt(Real(4) * j * j - Real(1)));
}

// The integral of P_k from 0 as a combination of P_{k-1} and P_{k+1}.
template <class Real>
Real integral(Index k, const Vec<Real>& p, const Vec<Real>& xi) {
  if (k == 0) return p[0] / Real(2) + xi[1] * p[1];
  return xi[k + 1] * p[k + 1] - xi[k] * p[k - 1];
}

}  // namespace

template <class Real>
void DenseOutput<Real>::begin(const State<Real>& from, const StagePolynomial<Real>& past) {
  from_ = &from;
  h_ = past.h;
  const Index s = past.W.cols();
  C_.resize(past.W.rows(), s);
  smallProduct<Real>(past.W, past.scheme->legendre_inverse_transposed, C_);
  if (p_.size() == s + 2) return;
  xi_.resize(s + 2);
  for (Index k = 1; k < xi_.size(); ++k) xi_[k] = xi<Real>(k);
  p_.resize(s + 2);
  once_.resize(s + 1);
  twice_.resize(s);
}

template <class Real>
void DenseOutput<Real>::evaluate(const Real& theta, State<Real>& out) {
  const Index s = C_.cols();
  legendre<Real>(theta, p_);
  for (Index k = 0; k <= s; ++k) once_[k] = integral(k, p_, xi_);
  for (Index k = 0; k < s; ++k) twice_[k] = integral(k, once_, xi_);
  out.t = from_->t + theta * h_;
  out.d = from_->d;
  const Index n = C_.rows();
  smallProduct(C_.data(), n, n, p_.head(s), out.w.data(), n);
  smallProduct(C_.data(), n, nu_, once_.head(s), out.v.data(), n);
  smallProduct(C_.data(), n, nu_, twice_, out.u.data(), n);
  smallProduct(C_.data() + nu_, n, nx_, once_.head(s), out.x.data(), n);
  out.u = from_->u + h_ * (theta * from_->v + h_ * out.u);
  out.v = from_->v + h_ * out.v;
  out.x = from_->x + h_ * out.x;
}

IRK_INSTANTIATE_CLASS(DenseOutput)

}  // namespace irk
