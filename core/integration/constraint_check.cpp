#include "core/integration/constraint_check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// A result is wrong from so many tolerances on; below that of `kFinest` it is not asked for more, and above it is not
// allowed more than `kCoarsest` of its own magnitude: a state that runs away from its constraints grows.
constexpr double kAllowed = 1e3;
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

}  // namespace

template <class Real>
ConstraintCheck<Real>::ConstraintCheck(const System<Real>& system, const ErrorNorm<Real>& norm,
                                       const Tolerances& tolerances)
    : system_(system),
      norm_(norm),
      allowed_(allowedAt(std::max(tolerances.rtol, tolerances.atol))),
      moved_(system.sizes()),
      r_(system.sizes().n()),
      moved_r_(system.sizes().n()),
      change_(system.sizes().constraints) {}

template <class Real>
std::string ConstraintCheck<Real>::violation(const State<Real>& state) {
  if (system_.sizes().constraints == 0) return {};
  const std::string g = violation(Level::kPosition, state);
  return g.empty() ? violation(Level::kVelocity, state) : g;
}

template <class Real>
void ConstraintCheck<Real>::residual(Level level, const State<Real>& state, Vec<Real>& r) {
  system_.evaluate(level, pointOf(state), VecView<Real>(r.data(), r.size()));
}

template <class Real>
std::string ConstraintCheck<Real>::violation(Level level, const State<Real>& state) {
  const Sizes n = system_.sizes();
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
