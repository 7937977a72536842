#include "core/stages/dense_output.h"

#include "core/base/legendre.h"
#include "core/base/small_product.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
DenseOutput<Real>::DenseOutput(const Sizes& sizes)
    : nu_(sizes.nu),
      nx_(sizes.nx),
      w_at_(sizes.n()),
      once_at_(nu_ + nx_),
      twice_at_(nu_),
      w_(sizes.n(), kParts - 1),
      once_(nu_ + nx_, kParts - 1),
      twice_(nu_, kParts - 1) {}

template <class Real>
void DenseOutput<Real>::begin(const State<Real>& from, const StagePolynomial<Real>& past) {
  from_ = &from;
  past_ = &past;
  expanded_ = inside_ = false;
}

template <class Real>
void DenseOutput<Real>::evaluate(const Real& theta, State<Real>& out) {
  const Index n = past_->W.rows(), s = past_->W.cols();
  if (!expanded_) {
    C_.resize(n, s);
    smallProduct<Real>(past_->W, past_->scheme->legendre_inverse_transposed, C_);
    p_.resize(s + 2);
    integral_.resize(s + 1);
    second_.resize(s);
    expanded_ = true;
  }
  legendre<Real>(theta, p_);
  integrateLegendre(p_, integral_, second_);
  smallProduct(C_.data(), n, n, p_.head(s), w_at_.data(), n);
  smallProduct(C_.data(), n, nu_ + nx_, integral_.head(s), once_at_.data(), n);
  smallProduct(C_.data(), n, nu_, second_, twice_at_.data(), n);
  write(theta, w_at_, once_at_, twice_at_, out);
}

template <class Real>
void DenseOutput<Real>::evaluateInside(Index j, State<Real>& out) {
  if (!inside_) {
    const Real* const W = past_->W.data();
    const Index n = past_->W.rows();
    const Scheme<Real>& scheme = *past_->scheme;
    smallProduct(W, n, n, scheme.inside, w_.data(), n);
    smallProduct(W, n, nu_ + nx_, scheme.inside_once, once_.data(), nu_ + nx_);
    smallProduct(W, n, nu_, scheme.inside_twice, twice_.data(), nu_);
    inside_ = true;
  }
  write(Real(j) / Real(kParts), w_.col(j - 1), once_.col(j - 1), twice_.col(j - 1), out);
}

template <class Real>
template <class W, class Once, class Twice>
void DenseOutput<Real>::write(const Real& theta, const W& w, const Once& once, const Twice& twice,
                              State<Real>& out) const {
  const Real& h = past_->h;
  out.t = from_->t + theta * h;
  out.d = from_->d;
  out.w = w;
  out.v = from_->v + h * once.head(nu_);
  out.x = from_->x + h * once.tail(nx_);
  out.u = from_->u + h * (theta * from_->v + h * twice);
}

IRK_INSTANTIATE_CLASS(DenseOutput)

}  // namespace irk
