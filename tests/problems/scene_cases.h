// Shared by the tests of scenes: every scene with the settings that change its equations, points as one vector, and
// the residual as a function of that vector.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "irk/misuse.h"
#include "irk/scene.h"

namespace irk::test {

struct SceneCase {
  std::string id;
  Settings settings;

  std::string name() const {
    std::string text = id;
    for (const auto& [key, value] : settings) text += " " + key + "=" + value;
    return text;
  }
};

/// All scenes with their defaults (but with few unknowns), with each choice of each word parameter, and with some
/// numbers.
inline std::vector<SceneCase> sceneCases() {
  std::vector<SceneCase> cases;
  for (const SceneEntry& entry : sceneCatalogue()) {
    // Derivatives of hundreds of unknowns in 50 digits would take minutes.
    const bool large = !entry.size.parameter.empty() && makeScene<double>(entry.id).sizes().n() > 100;
    cases.push_back({entry.id, large ? Settings{{entry.size.parameter, "10"}} : Settings{}});
    for (const Parameter& p : entry.parameters) {
      for (const std::string& choice : p.choices) {
        if (choice != p.default_value) cases.push_back({entry.id, {{p.name, choice}}});
      }
      if (p.name == "elements") {
        cases.push_back({entry.id, {{p.name, "1"}}});
        cases.push_back({entry.id, {{p.name, "4"}}});
      }
    }
  }
  cases.push_back({"slider_crank", {{"torque_off_at", "0.5"}}});
  cases.push_back({"slider_crank", {{"torque_every", "0.2"}, {"T2", "-0.05"}}});
  cases.push_back({"slider_crank_flexible", {{"Fc", "20"}}});
  cases.push_back({"stick_slip", {{"Fd", "1"}, {"Fs", "1"}, {"k", "100"}, {"v0", "0"}, {"vb", "0"}, {"x0", "0.105"}}});
  return cases;
}

/// The vector (u, v, x, a, k, z) of a start.
template <class Real>
Vec<Real> pointVector(const State<Real>& s) {
  Vec<Real> y(2 * s.u.size() + s.x.size() + s.w.size());
  y << s.u, s.v, s.x, s.w;
  return y;
}

/// Typical magnitudes of (u, v, x, a, k, z): scene.scale; 1 for a and k.
inline Vec<double> pointScale(const Scene<double>& scene, const Sizes& n) {
  Vec<double> s(2 * n.nu + n.nx + n.n());
  s << scene.scale.head(2 * n.nu + n.nx), Vec<double>::Ones(n.nu + n.nx), scene.scale.tail(n.nz);
  return s;
}

/// The start with every component moved by about a tenth of its scale, each by another amount.
inline Vec<double> perturbedPoint(const Scene<double>& scene, const Sizes& n) {
  Vec<double> y = pointVector(scene.start);
  const Vec<double> scale = pointScale(scene, n);
  for (Index j = 0; j < y.size(); ++j) {
    y[j] += 0.1 * scale[j] * std::sin(1.0 + 2.0 * static_cast<double>(j));
  }
  return y;
}

/// The modes of the start and those reached by up to two switches.
inline std::vector<Vec<double>> modesOf(const Scene<double>& scene) {
  const auto system = scene.system({});
  const Index switches = system->sizes().switches;
  std::vector<Vec<double>> modes = {scene.start.d};
  const auto add = [&modes](const Vec<double>& d) {
    if (std::find(modes.begin(), modes.end(), d) == modes.end()) modes.push_back(d);
  };
  for (Index first = 0; first < switches; ++first) {
    State<double> s = scene.start;
    system->onSwitch(first, s);
    add(s.d);
    for (Index second = 0; second < switches; ++second) {
      State<double> next = s;
      system->onSwitch(second, next);
      add(next.d);
    }
  }
  return modes;
}

/// A mode of the scene: its discrete state and its treatment in the residual.
struct Mode {
  Discontinuity discontinuity;
  Vec<double> d;
};

/// All modes frozen; for the start also the implied and the regularised law, if they exist.
inline std::vector<Mode> modesToTest(const Scene<double>& scene) {
  std::vector<Mode> modes;
  for (const Vec<double>& d : modesOf(scene)) modes.push_back({Discontinuity::kLocate, d});
  if (scene.sizes().switches == 0) return modes;
  for (const Discontinuity treatment : {Discontinuity::kIgnore, Discontinuity::kSmooth}) {
    try {
      scene.system({.discontinuity = treatment});
      modes.push_back({treatment, scene.start.d});
    } catch (const Misuse&) {  // a state that jumps, no regularisation
    }
  }
  return modes;
}

/// `d` is the discrete state, empty if there is none.
template <class T, class Real>
Vec<T> residualAt(const System<Real>& system, Level level, const Real& t, const Vec<T>& y, const Vec<Real>& d = {}) {
  const Sizes n = system.sizes();
  const Vec<T>& modes = d.template cast<T>();
  const T* p = y.data();
  const T* const w = p + 2 * n.nu + n.nx;
  Vec<T> r(n.n());
  const Point<T> point{T(t),      {p, n.nu},        {p + n.nu, n.nu},        {p + 2 * n.nu, n.nx},
                       {w, n.nu}, {w + n.nu, n.nx}, {w + n.nu + n.nx, n.nz}, {modes.data(), modes.size()}};
  system.evaluate(level, point, VecView<T>(r.data(), n.n()));
  return r;
}

/// dr/d(u, v, x, a, k, z) with hand-written seeds, independent of core's Differentiator.
template <class Real>
Mat<Real> automaticJacobian(const System<Real>& system, Level level, const Real& t, const Vec<Real>& y,
                            const Vec<Real>& d = {}) {
  Mat<Real> J(system.sizes().n(), y.size());
  for (Index first = 0; first < y.size(); first += static_cast<Index>(kChunk)) {
    Vec<Dual<Real>> dual(y.size());
    for (Index j = 0; j < y.size(); ++j) dual[j] = Dual<Real>(y[j]);
    const Index last = std::min(y.size(), first + static_cast<Index>(kChunk));
    for (Index j = first; j < last; ++j) dual[j].d[static_cast<std::size_t>(j - first)] = Real(1);
    const Vec<Dual<Real>> r = residualAt<Dual<Real>, Real>(system, level, t, dual, d);
    for (Index j = first; j < last; ++j) {
      for (Index i = 0; i < r.size(); ++i) J(i, j) = r[i].d[static_cast<std::size_t>(j - first)];
    }
  }
  return J;
}

/// The value of a component or an output by its name; NaN if there is none.
template <class Real>
Real valueOf(const Scene<Real>& scene, const std::string& name, const State<Real>& s) {
  Vec<Real> y(scene.sizes().components());
  y << s.u, s.v, s.x, s.z();
  for (std::size_t i = 0; i < scene.names.size(); ++i) {
    if (scene.names[i] == name) return y[static_cast<Index>(i)];
  }
  for (const auto& output : scene.outputs) {
    if (output.name == name) return output.value(s);
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

/// Whether a component or an output has this name.
inline bool hasValue(const Scene<double>& scene, const std::string& name) {
  return std::ranges::count(scene.names, name) > 0 ||
         std::ranges::any_of(scene.outputs, [&](const auto& output) { return output.name == name; });
}

/// The state has the value of the reference, up to `share` of the component's magnitude (of an output: 1) or of the
/// value, whichever is larger, and up to the reference's own accuracy.
inline void expectReference(const Scene<double>& scene, const State<double>& s, const Reference& r, double share) {
  const auto at = std::find(scene.names.begin(), scene.names.end(), r.component) - scene.names.begin();
  const double scale = at < scene.scale.size() ? scene.scale[at] : 1;
  const double wanted = std::strtod(r.value.c_str(), nullptr);
  EXPECT_NEAR(valueOf(scene, r.component, s), wanted, share * std::max(scale, std::abs(wanted)) + r.accuracy)
      << r.component << " at " << r.t;
}

/// The sum of the magnitudes of the terms in each row, which limits its round-off.
inline Vec<double> rowSizes(const Mat<double>& J, const Vec<double>& y, const Vec<double>& scale) {
  return J.cwiseAbs() * y.cwiseAbs().cwiseMax(scale);
}

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
inline constexpr Formulation kFormulations[] = {Formulation::kIndex3, Formulation::kIndex2};

}  // namespace irk::test
