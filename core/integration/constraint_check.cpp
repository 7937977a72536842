#include "core/integration/constraint_check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/derivatives/first_order.h"
#include "core/system/counting.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// A result is not believed if it is off its constraints by more than kAllowed tolerances. Where the drift was some tens
// of tolerances, errors of 1000 and more were seen in the directions in which nothing is checked; nearly all right
// results drift by less than ten. A tolerance below kFinest counts as kFinest. Whatever the tolerance, kCoarsest times
// the magnitude of the state is the most: a state that leaves its constraints grows.
constexpr double kAllowed = 20;
constexpr double kFinest = 1e-12;
constexpr double kCoarsest = 0.1;

double allowedAt(double tolerance) {
  return std::min(kAllowed * std::max(1.0, kFinest / tolerance), kCoarsest / tolerance);
}
// Patterns of signs in which the components are changed: no row is blind to all of them.
constexpr unsigned kPatterns = 4;

// A sign for component i of pattern k: bits of a multiplicative hash.
double signOf(unsigned k, Index i) {
  const unsigned hash = (static_cast<unsigned>(i) + 1) * (2654435761U + 2 * k * 40503U);
  return (hash >> 29 & 1U) != 0 ? 1 : -1;
}

template <class Real>
const System<Real>& constrainedIn(const System<Real>& system) {
  if (const auto* counting = dynamic_cast<const CountingSystem<Real>*>(&system))
    return constrainedIn(counting->inner());
  const auto* first_order = dynamic_cast<const FirstOrderForm<Real>*>(&system);
  return first_order ? first_order->inner() : system;
}

}  // namespace

template <class Real>
ConstraintCheck<Real>::ConstraintCheck(const System<Real>& system, const ErrorNorm<Real>& norm,
                                       const Tolerances& tolerances)
    : system_(system),
      constrained_(constrainedIn(system)),
      norm_(norm),
      allowed_(allowedAt(std::max(tolerances.rtol, tolerances.atol))),
      moved_(constrained_.sizes()),
      r_(constrained_.sizes().n()),
      moved_r_(r_.size()),
      change_(constrained_.sizes().constraints) {}

template <class Real>
std::string ConstraintCheck<Real>::violation(const State<Real>& state) {
  if (change_.size() == 0) return {};
  const State<Real> scene = system_.sizes().constraints == 0 ? system_.toScene(state) : state;
  const std::string g = violation(Level::kPosition, scene);
  return g.empty() ? violation(Level::kVelocity, scene) : g;
}

template <class Real>
void ConstraintCheck<Real>::residual(Level level, const State<Real>& state, Vec<Real>& r) {
  constrained_.evaluate(level, pointOf(state), VecView<Real>(r.data(), r.size()));
}

template <class Real>
std::string ConstraintCheck<Real>::violation(Level level, const State<Real>& state) {
  const Sizes n = constrained_.sizes();
  const Index first = n.nu + n.nx;
  residual(level, state, r_);
  change_.setZero();
  for (unsigned k = 0; k < kPatterns; ++k) {
    moved_ = state;
    const auto move = [&](auto& part, Index offset) {
      for (Index i = 0; i < part.size(); ++i) {
        part[i] += Real(signOf(k, offset + i) * norm_.weights()[offset + i]);
      }
    };
    move(moved_.u, 0);
    move(moved_.v, n.nu);
    move(moved_.x, 2 * n.nu);
    residual(level, moved_, moved_r_);
    for (Index i = 0; i < n.constraints; ++i) {
      const auto change = static_cast<double>(Real(moved_r_[first + i] - r_[first + i]));
      change_[i] = std::max(change_[i], std::abs(change));
    }
  }
  for (Index i = 0; i < n.constraints; ++i) {
    const double value = std::abs(static_cast<double>(r_[first + i]));
    const double allowed = allowed_ * change_[i];
    if (value <= allowed) continue;
    std::ostringstream text;
    text << (level == Level::kPosition ? "constraint g" : "constraint rate dg/dt") << "[" << i << "] = " << value
         << " at t = " << static_cast<double>(state.t) << ", allowed " << allowed;
    return text.str();
  }
  return {};
}

IRK_INSTANTIATE_CLASS(ConstraintCheck)

}  // namespace irk
