#include "core/derivatives/constraint_check.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "core/derivatives/first_order.h"
#include "core/system/counting.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// A result is not believed if it is off its constraints by more than kAllowed tolerances. Where the drift was some tens
// of tolerances, errors of 1000 and more were seen in the directions in which nothing is checked; among 3060 runs of
// mechanisms no result with an error below 30 tolerances drifts by more than ten. A tolerance below kFinest counts as
// kFinest. Whatever the tolerance, kCoarsest times the magnitude of the state is the most: a state that leaves its
// constraints grows.
constexpr double kAllowed = 10;
constexpr double kFinest = 1e-12;
constexpr double kCoarsest = 0.1;

// Random directions over which the squares of a constraint's changes are averaged: no row is blind to all of them.
constexpr int kSamples = 8;

template <class Real>
const System<Real>& constrainedIn(const System<Real>& system) {
  if (const auto* counting = dynamic_cast<const CountingSystem<Real>*>(&system))
    return constrainedIn(counting->inner());
  const auto* first_order = dynamic_cast<const FirstOrderForm<Real>*>(&system);
  return first_order ? first_order->inner() : system;
}

// g or dg/dt.
template <class Real>
Vec<Real> constraintsAt(const System<Real>& system, Level level, const State<Real>& state) {
  const Sizes n = system.sizes();
  Vec<Real> r(n.n());
  system.evaluate(level, pointOf(state), VecView<Real>(r.data(), r.size()));
  return r.segment(n.nu + n.nx, n.constraints);
}

// The root of the sum of squares of the changes that the components' weights make of the constraints.
template <class Real>
Vec<double> changes(const System<Real>& system, Level level, const State<Real>& state, const Vec<Real>& at_state,
                    const Vec<double>& weights) {
  std::minstd_rand random(1);
  std::normal_distribution<double> normal;
  Vec<double> squares = Vec<double>::Zero(at_state.size());
  for (int k = 0; k < kSamples; ++k) {
    State<Real> moved = state;
    Index component = 0;
    for (Vec<Real>* part : {&moved.u, &moved.v, &moved.x}) {
      for (Real& y : *part) y += Real(normal(random) * weights[component++]);
    }
    const Vec<Real> change = constraintsAt(system, level, moved) - at_state;
    squares += change.template cast<double>().cwiseAbs2() / kSamples;
  }
  return squares.cwiseSqrt();
}

template <class Real>
std::string violationAt(const System<Real>& system, Level level, const State<Real>& state, const Vec<double>& weights,
                        double allowed) {
  const Vec<Real> r = constraintsAt(system, level, state);
  const Vec<double> most = allowed * changes(system, level, state, r, weights);
  for (Index i = 0; i < r.size(); ++i) {
    const double value = static_cast<double>(r[i]);
    if (std::abs(value) <= most[i]) continue;
    std::ostringstream text;
    text << (level == Level::kPosition ? "constraint g" : "constraint rate dg/dt") << "[" << i << "] = " << value
         << " at t = " << static_cast<double>(state.t) << ", allowed " << most[i];
    return text.str();
  }
  return {};
}

}  // namespace

template <class Real>
std::string constraintViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                                double allowed) {
  const System<Real>& constrained = constrainedIn(system);
  if (constrained.sizes().constraints == 0) return {};
  const State<Real> scene = system.sizes().constraints == 0 ? system.toScene(state) : state;
  const std::string g = violationAt(constrained, Level::kPosition, scene, weights, allowed);
  return g.empty() ? violationAt(constrained, Level::kVelocity, scene, weights, allowed) : g;
}

double allowedDrift(const Tolerances& tolerances) {
  const double tolerance = std::max(tolerances.rtol, tolerances.atol);
  return std::min(kAllowed * std::max(1.0, kFinest / tolerance), kCoarsest / tolerance);
}

template std::string constraintViolation(const System<double>&, const State<double>&, const Vec<double>&, double);
template std::string constraintViolation(const System<mp50>&, const State<mp50>&, const Vec<double>&, double);
template std::string constraintViolation(const System<mp100>&, const State<mp100>&, const Vec<double>&, double);

}  // namespace irk
