#include "problems/support/build.h"

#include <fmt/format.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "core/base/text.h"
#include "core/derivatives/consistent_start.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr double kLargestQuantity = 1e15;
constexpr double kMaxElements = 10000;

void check(std::string_view scene, const Parameter& p, const std::string& text) {
  if (text == p.default_value) return;
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
    throw Misuse(fmt::format("scene {}: parameter {} = '{}' must be a {}number in [{}, {}]{}{}", scene, p.name, text,
                             p.whole ? "whole " : "", p.min, p.max, p.unit.empty() ? "" : " ", p.unit));
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

Parameter elementsParameter(std::string default_value) {
  Parameter p = numberParameter("elements", "", "number of elements", std::move(default_value), 1, kMaxElements);
  p.whole = true;
  p.audit_max = 4;
  return p;
}

Parameter wordParameter(std::string name, std::string meaning, std::vector<std::string> choices) {
  Parameter p;
  p.name = std::move(name);
  p.meaning = std::move(meaning);
  p.default_value = choices.front();
  p.choices = std::move(choices);
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
mp50 decimal<mp50>(const char* text) {
  return mp50(text);
}

template <class Real>
Real number(const Settings& settings, const std::string& name) {
  return decimal<Real>(settings.at(name).c_str());
}

template <class Real>
Real piOf() {
  return boost::math::constants::pi<Real>();
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

template <class Real>
void completeStart(Scene<Real>& scene) {
  const auto system = scene.system({});
  const StartReport report = ConsistentStart<Real>(*system, DerivativeSource::kAutomatic, true).apply(scene.start);
  if (report.outcome != Outcome::kSuccess) {
    throw std::logic_error("a scene's start: " + report.detail);
  }
}

template double number<double>(const Settings&, const std::string&);
template mp50 number<mp50>(const Settings&, const std::string&);
template double piOf<double>();
template mp50 piOf<mp50>();
template void setComponents<double>(Scene<double>&, const std::vector<Component>&, const std::vector<Component>&,
                                    const std::vector<Component>&);
template void setComponents<mp50>(Scene<mp50>&, const std::vector<Component>&, const std::vector<Component>&,
                                  const std::vector<Component>&);
template void setComponents<mp100>(Scene<mp100>&, const std::vector<Component>&, const std::vector<Component>&,
                                   const std::vector<Component>&);
template void completeStart<double>(Scene<double>&);
template void completeStart<mp50>(Scene<mp50>&);

}  // namespace irk
