#include "core/predictor.h"

#include <cmath>

#include "core/multiprecision.h"

namespace irk {
namespace {

// Extrapolation multiplies the stages' errors (Newton's tolerance) by up to sum_j |E_ij|. Above this
// the polynomial's highest coefficients are left out: at s = 10 and equal steps the full polynomial
// amplifies by 1e7.
constexpr double kAmplificationLimit = 1e4;

}  // namespace

template <class Real>
StartValues<Real>::StartValues(Predictor kind, const Scheme<Real>& scheme)
    : kind_(kind), scheme_(scheme), weights_(scheme.s, scheme.s), basis_(scheme.s, scheme.s) {}

// w(t_past + tau h_past) = sum_k P_k(tau) (V^-1 W^T)_k at tau_i = offset + ratio c_i, truncated after
// the largest degree whose amplification stays below the limit. Column i of the weights: stage i.
template <class Real>
void StartValues<Real>::updateWeights(const Real& offset, const Real& ratio) {
  if (offset == offset_ && ratio == ratio_) return;
  offset_ = offset;
  ratio_ = ratio;
  const Index s = scheme_.s;
  for (Index i = 0; i < s; ++i) {
    basis_.row(i) = legendre<Real>(s, Real(offset + ratio * scheme_.c[i])).transpose();
  }
  weights_.setZero();
  for (Index k = 0; k < s; ++k) {
    for (Index i = 0; i < s; ++i) {
      weights_.col(i) += basis_(i, k) * scheme_.legendre_inverse.row(k).transpose();
    }
    const double amplification =
        static_cast<double>(Real(weights_.cwiseAbs().colwise().sum().maxCoeff()));
    if (amplification > kAmplificationLimit && k > 0) {
      for (Index i = 0; i < s; ++i) {
        weights_.col(i) -= basis_(i, k) * scheme_.legendre_inverse.row(k).transpose();
      }
      return;
    }
  }
}

template <class Real>
void StartValues<Real>::fill(const StagePolynomial<Real>& past, const State<Real>& from,
                             const Real& h, Mat<Real>& W) {
  const bool constant = kind_ == Predictor::kAcceleration || !past.valid;
  if (constant) {
    W.colwise() = from.w;
  } else if (kind_ == Predictor::kPrevious) {
    W = past.W;
  } else {
    updateWeights(Real((from.t - past.t) / past.h), Real(h / past.h));
    W.noalias() = past.W * weights_;
  }
  for (Index i = 0; i < scheme_.first; ++i) W.col(i) = from.w;
}

IRK_INSTANTIATE_CLASS(StartValues)

}  // namespace irk
