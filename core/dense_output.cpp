#include "core/dense_output.h"

#include <cmath>

#include "core/multiprecision.h"

namespace irk {
namespace {

template <class Real>
Real xi(Index k) {
  using std::sqrt;
  const Real j = Real(static_cast<double>(k));
  return Real(1) / (Real(2) * sqrt(Real(4) * j * j - Real(1)));
}

// The integral of P_k from 0 as a combination of P_{k-1} and P_{k+1}.
template <class Real, class P>
Real integral(Index k, const P& p) {
  if (k == 0) return p[0] / Real(2) + xi<Real>(1) * p[1];
  return xi<Real>(k + 1) * p[k + 1] - xi<Real>(k) * p[k - 1];
}

}  // namespace

template <class Real>
void DenseOutput<Real>::begin(const State<Real>& from, const StagePolynomial<Real>& past) {
  from_ = &from;
  h_ = past.h;
  const Index s = past.W.cols();
  C_.resize(past.W.rows(), s);
  C_.noalias() = past.W * past.scheme->legendre_inverse.transpose();
  p_.resize(s + 2);
  once_.resize(s + 1);
  twice_.resize(s);
}

template <class Real>
void DenseOutput<Real>::evaluate(const Real& theta, State<Real>& out) {
  const Index s = C_.cols();
  legendre<Real>(theta, p_);
  for (Index k = 0; k <= s; ++k) once_[k] = integral<Real>(k, p_);
  for (Index k = 0; k < s; ++k) twice_[k] = integral<Real>(k, once_);
  out.t = from_->t + theta * h_;
  out.d = from_->d;
  out.w.noalias() = C_ * p_.head(s);
  out.u = from_->u + (theta * h_) * from_->v;
  out.u.noalias() += (h_ * h_) * (C_.topRows(nu_) * twice_);
  out.v = from_->v;
  out.v.noalias() += h_ * (C_.topRows(nu_) * once_.head(s));
  out.x = from_->x;
  out.x.noalias() += h_ * (C_.middleRows(nu_, nx_) * once_.head(s));
}

IRK_INSTANTIATE_CLASS(DenseOutput)

}  // namespace irk
