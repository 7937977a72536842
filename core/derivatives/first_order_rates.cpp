// What D0 of a first-order form depends on, found anew with each mode.
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/derivatives/first_order.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

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
  if (!isRegular()) {
    rates_ = Rates::kNonlinear;  // later solves report that D0 is singular
    return false;
  }
  const Linearization<Real> here = D_;
  rates_ = kindNear(scene, here.d0);
  at_ = scene;
  D_ = here;
  if (rates_ == Rates::kConstant && isDiagonal()) rates_ = Rates::kDiagonal;
  if (rates_ == Rates::kConstant) factorize();
  return true;
}

template <class Real>
bool FirstOrderForm<Real>::completeStep(State<Real>& state) const {
  State<Real> scene = toScene(state);
  if (!inner_->completeStep(scene)) return false;
  takeMode("System::completeStep", scene, state);
  state.x << scene.u, scene.v, scene.x;
  return true;
}

template <class Real>
void FirstOrderForm<Real>::takeMode(const char* function, const State<Real>& scene, State<Real>& state) const {
  requireState(function, scene, inner_sizes_);
  state.d = scene.d;
  static_cast<void>(classify(scene));
}

template <class Real>
bool FirstOrderForm<Real>::isRegular() const {
  if (!D_.pattern->full) return lu_.factorize(D_) == Outcome::kSuccess;
  Mat<Real> scaled = D_.dense0();
  Equilibration<Real>().apply(*D_.pattern, scaled.data());
  return Eigen::FullPivLU<Mat<Real>>(scaled).isInvertible();
}

// Sets diagonal_.
template <class Real>
bool FirstOrderForm<Real>::isDiagonal() const {
  const Pattern& pattern = *D_.pattern;
  diagonal_.setZero();
  for (Index j = 0; j < pattern.n; ++j) {
    const auto c = static_cast<std::size_t>(j);
    for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
      const Index row = pattern.row[static_cast<std::size_t>(k)];
      if (row == j) {
        diagonal_[j] = D_.d0[k];
      } else if (D_.d0[k] != Real(0)) {
        return false;
      }
    }
  }
  return true;
}

template <class Real>
typename FirstOrderForm<Real>::Rates FirstOrderForm<Real>::kindNear(const State<Real>& scene,
                                                                    const Vec<Real>& D0) const {
  constexpr int kSamples = 3;
  bool constant = true;
  for (int sample = 1; sample <= kSamples; ++sample) {
    at_ = moved(scene, sample);
    evaluateMatrix();
    const Vec<Real> there = D_.d0;
    constant = constant && there.size() == D0.size() && there == D0;
    for (Index i = 0; i < at_.w.size(); ++i) at_.w[i] += Real(0.5 + 0.1 * static_cast<double>(i));
    evaluateMatrix();
    if (D_.d0.size() != there.size() || D_.d0 != there) return Rates::kNonlinear;
  }
  return constant ? Rates::kConstant : Rates::kLinear;
}

#define IRK_RATES(Real)                                                   \
  template bool FirstOrderForm<Real>::classify(const State<Real>&) const; \
  template bool FirstOrderForm<Real>::completeStep(State<Real>&) const;   \
  template void FirstOrderForm<Real>::takeMode(const char*, const State<Real>&, State<Real>&) const;
IRK_RATES(double)
IRK_RATES(BigFloat)
#undef IRK_RATES

}  // namespace irk
