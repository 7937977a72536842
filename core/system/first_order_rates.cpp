// What D0 of a first-order form depends on.
#include <algorithm>
#include <cmath>

#include "core/system/first_order.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// A state near `from`: t and every number of u, v, x is moved by up to a tenth of 1 + its magnitude.
template <class Real>
State<Real> moved(const State<Real>& from, int sample) {
  State<Real> to = from;
  int i = sample;
  const auto move = [&i](Real& value) {
    using std::abs;
    i = (i * 7 + 3) % 11;
    value += Real(0.02 * (i - 5)) * (Real(1) + Real(abs(value)));
  };
  move(to.t);
  for (auto* part : {&to.u, &to.v, &to.x}) std::for_each(part->begin(), part->end(), move);
  return to;
}

}  // namespace

// Called at the start and after each switch. D0 is compared with its values at states nearby. A dependence that shows
// only further away is found later, by the residual of a dual evaluation (`evaluate`).
template <class Real>
bool FirstOrderForm<Real>::classify(const State<Real>& scene) const {
  solved_ = false;
  renew_ = true;
  at_ = scene;
  evaluateMatrix();
  const Mat<Real> D0 = lu_.matrix();
  if (!Eigen::FullPivLU<Mat<Real>>(D0).isInvertible()) {
    rates_ = Rates::kNonlinear;  // later solves report that D0 is singular
    return false;
  }
  rates_ = kindNear(scene, D0);
  at_ = scene;
  lu_.matrix() = D0;
  diagonal_ = D0.diagonal();
  if (rates_ == Rates::kConstant && D0.isDiagonal(Real(0))) rates_ = Rates::kDiagonal;
  if (rates_ == Rates::kConstant) factorize();
  return true;
}

template <class Real>
typename FirstOrderForm<Real>::Rates FirstOrderForm<Real>::kindNear(const State<Real>& scene,
                                                                    const Mat<Real>& D0) const {
  constexpr int kSamples = 3;
  bool constant = true;
  for (int sample = 1; sample <= kSamples; ++sample) {
    at_ = moved(scene, sample);
    evaluateMatrix();
    const Mat<Real> there = lu_.matrix();
    constant = constant && there == D0;
    for (Index i = 0; i < at_.w.size(); ++i) at_.w[i] += Real(0.5 + 0.1 * static_cast<double>(i));
    evaluateMatrix();
    if (!(lu_.matrix() == there)) return Rates::kNonlinear;
  }
  return constant ? Rates::kConstant : Rates::kLinear;
}

template bool FirstOrderForm<double>::classify(const State<double>&) const;
template bool FirstOrderForm<mp50>::classify(const State<mp50>&) const;
template bool FirstOrderForm<mp100>::classify(const State<mp100>&) const;

}  // namespace irk
