#include "irk/scene_file.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "core/base/text.h"
#include "core/derivatives/consistent_start.h"
#include "core/derivatives/differentiator.h"
#include "irk/dependent_constraints.h"
#include "irk/misuse.h"
#include "irk/system_check.h"
#include "problems/support/row_check.h"

namespace irk {
namespace {

constexpr double kLargestQuantity = 1e15;
constexpr double kMaxElements = 10000;

void check(std::string_view scene, const Parameter& p, const std::string& text) {
  if (p.text || isTable(p, text) || text == p.default_value) return;
  if (!p.choices.empty()) {
    for (const std::string& choice : p.choices) {
      if (text == choice) return;
    }
    throw Misuse(fmt::format("scene {}: {}", scene, unknownName("value of parameter " + p.name, text, p.choices)));
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
  const bool fits = !p.whole || value == std::floor(value);
  if (!is_number || !fits || value < p.min || value > p.max) {
    throw Misuse(fmt::format("scene {}: parameter {} = '{}' must be a {}number in [{}, {}]{}{}{}", scene, p.name, text,
                             p.whole ? "whole " : "", p.min, p.max, p.unit.empty() ? "" : " ", p.unit,
                             p.table ? ", or a table: file.csv or file.csv:column" : ""));
  }
}

}  // namespace

Parameter numberParameter(std::string name, std::string unit, std::string meaning, std::string default_value,
                          double min, double max) {
  Parameter p;
  p.name = std::move(name);
  p.unit = std::move(unit);
  p.meaning = std::move(meaning);
  p.default_value = std::move(default_value);
  p.min = min;
  p.max = max;
  return p;
}

Parameter positiveParameter(std::string name, std::string unit, std::string meaning, std::string default_value) {
  return numberParameter(std::move(name), std::move(unit), std::move(meaning), std::move(default_value),
                         1 / kLargestQuantity, kLargestQuantity);
}

Parameter smoothingParameter(std::string unit, std::string meaning, std::string default_value) {
  Parameter p =
      positiveParameter("smoothing", std::move(unit), "mode smooth: " + std::move(meaning), std::move(default_value));
  p.changes_solution = false;
  p.only_smooth = true;
  return p;
}

Parameter wholeParameter(std::string name, std::string meaning, std::string default_value, double min, double max,
                         double audit_max) {
  Parameter p = numberParameter(std::move(name), "", std::move(meaning), std::move(default_value), min, max);
  p.whole = true;
  p.audit_max = audit_max;
  return p;
}

Parameter elementsParameter(std::string default_value) {
  return wholeParameter("elements", "number of elements", std::move(default_value), 1, kMaxElements, 4);
}

Parameter wordParameter(std::string name, std::string meaning, std::vector<std::string> choices) {
  if (choices.empty()) throw Misuse("parameter " + name + " has no words: at least one is expected, the default");
  Parameter p = numberParameter(std::move(name), "", std::move(meaning), choices.front(), 0, 0);
  p.choices = std::move(choices);
  return p;
}

Parameter descriptionParameter(std::string name, std::string meaning, std::vector<std::string> choices) {
  Parameter p = wordParameter(std::move(name), std::move(meaning), std::move(choices));
  p.changes_solution = false;
  return p;
}

Parameter textParameter(std::string name, std::string meaning, std::string default_value) {
  Parameter p = numberParameter(std::move(name), "", std::move(meaning), std::move(default_value), 0, 0);
  p.text = true;
  return p;
}

Settings completedSettings(std::string_view scene, const std::vector<Parameter>& parameters, const Settings& given) {
  Settings all;
  std::vector<std::string> known;
  for (const Parameter& p : parameters) {
    all[p.name] = p.default_value;
    known.push_back(p.name);
  }
  for (const auto& [name, text] : given) {
    if (known.empty()) throw Misuse(fmt::format("scene {} has no parameters, not '{}'", scene, name));
    if (!all.contains(name)) {
      throw Misuse(fmt::format("scene {}: {}", scene, unknownName("parameter", name, known)));
    }
    all[name] = text;
  }
  for (const Parameter& p : parameters) check(scene, p, all[p.name]);
  return all;
}

template <>
double decimal<double>(const char* text) {
  return std::strtod(text, nullptr);
}
template <>
BigFloat decimal<BigFloat>(const char* text) {
  return BigFloat(text);
}

template <class Real>
Real number(const Settings& settings, const std::string& name) {
  const auto found = settings.find(name);
  if (found == settings.end()) {
    throw Misuse(fmt::format("it asks for the parameter '{}', which its entry does not declare", name));
  }
  const char* const text = found->second.c_str();
  char* end = nullptr;
  static_cast<void>(std::strtod(text, &end));
  if (end == text || *end != '\0') {
    throw Misuse(fmt::format("the parameter {} = '{}' is not a number", name, found->second));
  }
  return decimal<Real>(text);
}

template <class Real>
Real piOf() {
  using std::acos;
  return acos(Real(-1));
}

std::vector<Component> named(const std::string& unit, std::initializer_list<const char*> names) {
  std::vector<Component> all;
  for (const char* name : names) all.push_back({name, unit});
  return all;
}

std::vector<Component> numbered(Index count, const std::string& name, const std::string& unit, double scale,
                                double rate_scale) {
  std::vector<Component> all;
  for (Index i = 1; i <= count; ++i) all.push_back({name + std::to_string(i), unit, scale, rate_scale});
  return all;
}

namespace {

// The unit of a time derivative: rad/s, m/s, 1/s; unchanged in a scene without a time unit.
std::string rateUnit(const std::string& unit, const std::string& time_unit) {
  if (time_unit.empty()) return unit;
  return (unit.empty() ? "1" : unit) + "/" + time_unit;
}

}  // namespace

template <class Real>
void setComponents(Scene<Real>& scene, const std::vector<Component>& u, const std::vector<Component>& x,
                   const std::vector<Component>& z) {
  scene.names.clear();
  scene.units.clear();
  std::vector<double> scale;
  const std::size_t components = 2 * u.size() + x.size() + z.size();
  scene.names.reserve(components);
  scene.units.reserve(components);
  scale.reserve(components);
  const auto append = [&](std::string name, std::string unit, double size) {
    scene.names.push_back(std::move(name));
    scene.units.push_back(std::move(unit));
    scale.push_back(size);
  };
  for (const Component& c : u) append(c.name, c.unit, c.scale);
  for (const Component& c : u) append(c.name + "'", rateUnit(c.unit, scene.time_unit), c.rate_scale);
  for (const Component& c : x) append(c.name, c.unit, c.scale);
  for (const Component& c : z) append(c.name, c.unit, c.scale);
  scene.scale = Eigen::Map<const Vec<double>>(scale.data(), static_cast<Index>(scale.size()));
}

namespace {

// A residual may write behind the last row, or read beyond the end of a short vector.
template <class Real>
std::shared_ptr<const System<Real>> checkedSystem(const Scene<Real>& scene) {
  if (!scene.system) throw Misuse("its start cannot be completed before setProblem: it has no system");
  const auto system = scene.system({});
  requireSystem(system.get(), {});
  if constexpr (std::is_same_v<Real, double>) requireRowsInside(*system, scene.start);
  requireStart(*system, scene.start, scene.start.t);
  return system;
}

// Gauss-Newton steps for (a, k, z) where dr/d(a, k, z) is singular, as the matrix in front of k of an electric circuit
// is: what the residual does not determine stays as near to the given values as it can.
template <class Real>
void solveRates(const System<Real>& system, State<Real>& state) {
  constexpr int kSteps = 10;
  Differentiator<Real> differentiator(system, DerivativeSource::kAutomatic);
  Linearization<Real> D;
  Vec<Real> r(system.sizes().n());
  for (int i = 0; i < kSteps; ++i) {
    system.evaluate(Level::kFormulated, pointOf(state), {r.data(), r.size()});
    differentiator.evaluate(Level::kFormulated, pointOf(state), D);
    if (!r.allFinite() || !D.d0.allFinite()) return;
    const Vec<Real> dw = Mat<Real>(D.dense0()).completeOrthogonalDecomposition().solve(r);
    state.w -= dw;
    if (dw.norm() <= Real(100) * Eigen::NumTraits<Real>::epsilon() * (Real(1) + state.w.norm())) return;
  }
}

}  // namespace

template <class Real>
void completeStart(Scene<Real>& scene) {
  const auto system = checkedSystem(scene);
  ConsistentStart<Real> consistent(*system, DerivativeSource::kAutomatic, true, nullptr, scene.scale);
  StartReport report = consistent.apply(scene.start);
  if (report.outcome == Outcome::kNotFinite) {
    // Exact derivatives can be 0/0 where differences are finite. Whether a run accepts these, its own option decides.
    ConsistentStart<Real> by_differences(*system, DerivativeSource::kCentral, true, nullptr, scene.scale);
    if (by_differences.apply(scene.start).outcome == Outcome::kSuccess) return;
  }
  if (report.outcome == Outcome::kInconsistentStart) {
    solveRates(*system, scene.start);
    report = consistent.apply(scene.start);
  }
  if (report.outcome == Outcome::kSingular) {
    // Constraints that depend on each other are no mistake in the scene: a run may leave some of them out.
    const auto others = scene.system({.left_out = dependentConstraints(*system, scene.start, scene.scale)});
    report =
        ConsistentStart<Real>(*others, DerivativeSource::kAutomatic, true, nullptr, scene.scale).apply(scene.start);
  }
  if (report.outcome != Outcome::kSuccess) throw Misuse("its start: " + report.detail);
}

namespace {

constexpr int kMaxGaussNewton = 50;

// The rows of the position constraints: g, dg/dt.
template <class Real>
Vec<Real> constraintRows(const System<Real>& system, Level level, const State<Real>& state) {
  const Sizes n = system.sizes();
  Vec<Real> r(n.n());
  system.evaluate(level, pointOf(state), {r.data(), r.size()});
  return r.segment(n.nu + n.nx, n.constraints);
}

// The columns of G = dg/du that belong to the coordinates `columns`: dg/dt = G v + dg/dt(u, 0).
template <class Real>
Mat<Real> constraintMatrix(const System<Real>& system, State<Real> state, const std::vector<Index>& columns) {
  state.v.setZero();
  const Vec<Real> at_rest = constraintRows(system, Level::kVelocity, state);
  Mat<Real> G(at_rest.size(), static_cast<Index>(columns.size()));
  for (Index j = 0; j < G.cols(); ++j) {
    Real& v = state.v[columns[static_cast<std::size_t>(j)]];
    v = Real(1);
    G.col(j) = constraintRows(system, Level::kVelocity, state) - at_rest;
    v = Real(0);
  }
  return G;
}

// Subtracts the least solution of G dy = r from the components `columns` of y; returns its norm.
template <class Real>
Real correct(const Mat<Real>& G, const Vec<Real>& r, const std::vector<Index>& columns, Vec<Real>& y) {
  if (columns.empty()) return Real(0);
  const Vec<Real> dy = G.completeOrthogonalDecomposition().solve(r);
  for (Index j = 0; j < dy.size(); ++j) y[columns[static_cast<std::size_t>(j)]] -= dy[j];
  return dy.norm();
}

}  // namespace

template <class Real>
void completeStart(Scene<Real>& scene, const std::vector<std::string>& unknown) {
  const auto system = checkedSystem(scene);
  const Index nu = system->sizes().nu;
  std::vector<std::string> known(scene.names.begin(),
                                 scene.names.begin() + std::min<std::ptrdiff_t>(2 * nu, std::ssize(scene.names)));
  std::vector<Index> u, v;
  for (const auto& name : unknown) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) throw Misuse("its start: " + unknownName("component of u and v", name, known));
    const Index i = at - known.begin();
    (i < nu ? u : v).push_back(i < nu ? i : i - nu);
  }
  State<Real>& start = scene.start;
  Real last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxGaussNewton; ++i) {
    const Real step =
        correct(constraintMatrix(*system, start, u), constraintRows(*system, Level::kPosition, start), u, start.u);
    if (!(step < last) || step == Real(0)) break;  // round-off, or no convergence: completeStart says so
    last = step;
  }
  correct(constraintMatrix(*system, start, v), constraintRows(*system, Level::kVelocity, start), v, start.v);
  completeStart(scene);
}

template double number<double>(const Settings&, const std::string&);
template BigFloat number<BigFloat>(const Settings&, const std::string&);
template double piOf<double>();
template BigFloat piOf<BigFloat>();
template void setComponents<double>(Scene<double>&, const std::vector<Component>&, const std::vector<Component>&,
                                    const std::vector<Component>&);
template void setComponents<BigFloat>(Scene<BigFloat>&, const std::vector<Component>&, const std::vector<Component>&,
                                      const std::vector<Component>&);
template void completeStart<double>(Scene<double>&);
template void completeStart<BigFloat>(Scene<BigFloat>&);
template void completeStart<double>(Scene<double>&, const std::vector<std::string>&);
template void completeStart<BigFloat>(Scene<BigFloat>&, const std::vector<std::string>&);

}  // namespace irk
