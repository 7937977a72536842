#include "experiments/runs/run_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <vector>

#include "core/base/text.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/peers/catalogue.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr Named<ScalarKind> kScalars[] = {
    {ScalarKind::kDouble, "double", "53 bits"},
    {ScalarKind::kMp50, "mp50", "50 decimal digits, for orders that double cannot show"},
    {ScalarKind::kMp100, "mp100", "100 digits, for orders from about 20 on: riccati_tracking only"}};

#define IRK_EMBEDDED                                                                            \
  "estimate=embedded;solver=eigen;jacobian_point=predicted;newton=broyden"
constexpr Configuration kConfigurations[] = {
    {"default",
     "Richardson's estimate, predictive control, simplified Newton, Schur basis, switches located, "
     "multipliers consistent at the end",
     ""},
    {"paper", "Gerstmayr & Stangl: modified Newton, difference quotients, one LU, step doubling",
     "newton=modified;derivatives=difference_forward;solver=coupled_dense;predictor=previous;"
     "estimate=doubling;control=paper;norm=absolute;summation=plain;discontinuity=ignore;"
     "multipliers=stages"},
    {"embedded", "embedded estimate, eigenvectors of A, predicted Jacobians, Broyden's updates",
     IRK_EMBEDDED},
    {"variable", "the same with variable order; a method with its number of stages is the first one",
     IRK_EMBEDDED ";order=variable;method=radau_iia"}};
#undef IRK_EMBEDDED

// Each `field=value` of a text, items separated by ';'.
void setFields(RunSpec& spec, std::string_view text) {
  while (!text.empty()) {
    const auto item = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const auto equals = item.find('=');
    if (equals == std::string_view::npos) {
      throw Misuse(fmt::format("'{}' in a run's text is not of the form field=value", item));
    }
    findField(item.substr(0, equals)).set(spec, item.substr(equals + 1));
  }
}

void setConfiguration(RunSpec& spec, std::string_view id) {
  std::vector<std::string> known;
  for (const auto& configuration : kConfigurations) {
    known.emplace_back(configuration.id);
    if (configuration.id != id) continue;
    spec.configuration = id;
    return setFields(spec, configuration.fields);
  }
  throw Misuse(unknownName("configuration", id, known));
}

std::string configurationIds() {
  std::string ids;
  for (const auto& configuration : kConfigurations) {
    ids += fmt::format("{}{}", ids.empty() ? "" : " | ", configuration.id);
  }
  return ids;
}

// Text that would break the canonical form apart.
void requirePlain(std::string_view field, std::string_view value, std::string_view forbidden) {
  const auto at = value.find_first_of(forbidden);
  if (at != std::string_view::npos) {
    throw Misuse(fmt::format("{} = '{}': '{}' is not allowed here", field, value, value[at]));
  }
}

template <auto Member>
constexpr SpecField axisField(std::string_view name) {
  return {name, [](const RunSpec& s) { return std::string(idOf(Member(s))); },
          [](RunSpec& s, std::string_view value) {
            auto& member = Member(s);
            member = parseId<std::remove_cvref_t<decltype(member)>>(value);
          },
          [] {
            RunSpec defaults;
            std::string ids;
            for (const auto& entry : named<std::remove_cvref_t<decltype(Member(defaults))>>()) {
              ids += fmt::format("{}{}", ids.empty() ? "" : " | ", entry.id);
            }
            return ids;
          }};
}

template <auto Member, auto Name, const NumberRange& Range>
constexpr SpecField numberField() {
  return {Name(), [](const RunSpec& s) { return numberText(Member(s)); },
          [](RunSpec& s, std::string_view value) { Member(s) = parseNumber(Name(), value, Range); },
          [] { return std::string(Range.text); }};
}

constexpr NumberRange kRelativeTolerance{[](double x) { return x >= 0 && x < 1; }, "0 <= rtol < 1"};
constexpr NumberRange kResidualTolerance{[](double x) { return x > 0 && x < 1; }, "0 < x < 1"};
constexpr NumberRange kContractivity{[](double x) { return x > 0 && x <= 1; }, "0 < x <= 1"};
constexpr NumberRange kReuse{[](double x) { return x >= 0 && x < 1; }, "0 <= x < 1"};
constexpr std::int64_t kMostSteps = 1'000'000'000'000;

#define IRK_MEMBER(path) \
  [](auto& s) -> auto& { return s.path; }
#define IRK_NUMBER(name, path, range) \
  numberField<IRK_MEMBER(path), [] { return std::string_view(name); }, range>()

constexpr SpecField kFields[] = {
    {"scene", [](const RunSpec& s) { return s.scene; },
     [](RunSpec& s, std::string_view value) { s.scene = findScene(value).id; },
     [] { return std::string("irk list scenes"); }},
    {"settings", [](const RunSpec& s) { return settingsText(s.settings); },
     [](RunSpec& s, std::string_view value) {
       s.settings.clear();
       while (!value.empty()) {
         const auto end = std::min(value.find(' '), value.size());
         if (end > 0) addSetting(s.settings, value.substr(0, end));
         value.remove_prefix(std::min(end + 1, value.size()));
       }
     },
     [] { return std::string("name=value name=value"); }},
    {"configuration", [](const RunSpec& s) { return s.configuration; }, setConfiguration,
     configurationIds},
    {"method", [](const RunSpec& s) { return s.method; },
     [](RunSpec& s, std::string_view value) {
       requirePlain("method", value, ";\n");
       s.method = value;
     },
     [] { return std::string("family_stages or a peer (irk list methods), a tableau file, or with variable order a family"); }},
    axisField<IRK_MEMBER(formulation)>("formulation"),
    axisField<IRK_MEMBER(scaling)>("scaling"),
    axisField<IRK_MEMBER(discontinuity)>("discontinuity"),
    axisField<IRK_MEMBER(scalar)>("scalar"),
    axisField<IRK_MEMBER(options.derivatives)>("derivatives"),
    axisField<IRK_MEMBER(options.newton.kind)>("newton"),
    axisField<IRK_MEMBER(options.solver)>("solver"),
    axisField<IRK_MEMBER(options.storage)>("storage"),
    axisField<IRK_MEMBER(options.predictor)>("predictor"),
    axisField<IRK_MEMBER(options.step.estimate)>("estimate"),
    axisField<IRK_MEMBER(options.step.control)>("control"),
    axisField<IRK_MEMBER(options.order)>("order"),
    {"max_stages", [](const RunSpec& s) { return std::to_string(s.max_stages); },
     [](RunSpec& s, std::string_view value) {
       s.max_stages = static_cast<int>(parseInteger("max_stages", value, 1, kMaxStages));
     },
     [] { return std::string("of variable order, 1 to 100; default 13"); }},
    axisField<IRK_MEMBER(options.summation)>("summation"),
    axisField<IRK_MEMBER(options.multipliers)>("multipliers"),
    axisField<IRK_MEMBER(options.tolerances.norm)>("norm"),
    axisField<IRK_MEMBER(options.jacobian)>("jacobian"),
    axisField<IRK_MEMBER(options.jacobian_point)>("jacobian_point"),
    IRK_NUMBER("residual_tolerance", options.newton.residual_tolerance, kResidualTolerance),
    IRK_NUMBER("contractivity_limit", options.newton.contractivity_limit, kContractivity),
    {"contractivity_after",
     [](const RunSpec& s) { return std::to_string(s.options.newton.contractivity_after); },
     [](RunSpec& s, std::string_view value) {
       s.options.newton.contractivity_after =
           static_cast<int>(parseInteger("contractivity_after", value, 0, 1000));
     },
     [] { return std::string("iterations, 0 to 1000"); }},
    {"max_iterations",
     [](const RunSpec& s) { return std::to_string(s.options.newton.max_iterations); },
     [](RunSpec& s, std::string_view value) {
       s.options.newton.max_iterations =
           static_cast<int>(parseInteger("max_iterations", value, 1, 1000));
     },
     [] { return std::string("Newton iterations, 1 to 1000"); }},
    IRK_NUMBER("keep_jacobian_below", options.newton.keep_jacobian_below, kReuse),
    IRK_NUMBER("kappa", options.newton.kappa, kNotNegative),
    IRK_NUMBER("h", options.step.h, kNotNegative),
    IRK_NUMBER("h_max", options.step.h_max, kPositive),
    IRK_NUMBER("rtol", options.tolerances.rtol, kRelativeTolerance),
    IRK_NUMBER("atol", options.tolerances.atol, kPositive),
    {"t_end", [](const RunSpec& s) { return std::isnan(s.t_end) ? "scene" : numberText(s.t_end); },
     [](RunSpec& s, std::string_view value) {
       s.t_end = value == "scene" ? std::numeric_limits<double>::quiet_NaN()
                                  : parseNumber("t_end", value, kAnyNumber);
     },
     [] { return std::string("a number; the scene's own if left out"); }},
    {"max_steps", [](const RunSpec& s) { return std::to_string(s.options.step.max_steps); },
     [](RunSpec& s, std::string_view value) {
       s.options.step.max_steps = parseInteger("max_steps", value, 1, kMostSteps);
     },
     [] { return std::string("attempted steps, an integer > 0"); }},
    {"threads", [](const RunSpec& s) { return std::to_string(s.options.threads); },
     [](RunSpec& s, std::string_view value) {
       s.options.threads = static_cast<int>(parseInteger("threads", value, 1, 1024));
     },
     [] { return std::string("inside one integration, 1 to 1024"); }},
    IRK_NUMBER("time_limit", time_limit, kNotNegative),
};
#undef IRK_NUMBER
#undef IRK_MEMBER

}  // namespace

template <>
std::span<const Named<ScalarKind>> named<ScalarKind>() {
  return kScalars;
}
template <>
std::string_view axisName<ScalarKind>() {
  return "scalar";
}
template <>
ScalarKind parseId<ScalarKind>(std::string_view id) {
  std::vector<std::string> known;
  for (const auto& entry : kScalars) {
    if (entry.id == id) return entry.value;
    known.emplace_back(entry.id);
  }
  throw Misuse(unknownName("scalar", id, known));
}

std::span<const Configuration> configurations() { return kConfigurations; }

double epsilonOf(ScalarKind scalar) {
  switch (scalar) {
    case ScalarKind::kDouble:
      return std::numeric_limits<double>::epsilon();
    case ScalarKind::kMp50:
      return 1e-50;
    case ScalarKind::kMp100:
      return 1e-100;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::span<const SpecField> specFields() { return kFields; }

const SpecField& findField(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& field : kFields) {
    if (field.name == name) return field;
    known.emplace_back(field.name);
  }
  throw Misuse(unknownName("field", name, known));
}

RunSpec resolved(RunSpec spec) {
  const auto& parameters = findScene(spec.scene).parameters;
  std::vector<std::string> known;
  for (const auto& parameter : parameters) {
    known.push_back(parameter.name);
    const auto given = spec.settings.find(parameter.name);
    if (given != spec.settings.end() && given->second == parameter.default_value) {
      spec.settings.erase(given);
    }
  }
  for (const auto& [name, value] : spec.settings) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Misuse(unknownName("parameter of " + spec.scene, name, known));
    }
  }
  if (std::isnan(spec.t_end))
    spec.t_end = makeScene<double>(spec.scene, settingsAtStep(spec)).t_end;
  return spec;
}

Settings settingsAtStep(const RunSpec& spec) {
  const double h = spec.options.step.h > 0 ? spec.options.step.h : 1;
  Settings settings = spec.settings;
  for (auto& [name, value] : settings) {
    if (!value.ends_with("/h")) continue;
    const auto factor = std::string_view(value).substr(0, value.size() - 2);
    value = numberText(parseNumber(name, factor, kAnyNumber) / h);
  }
  return settings;
}

std::string canonicalText(const RunSpec& spec) {
  std::string text;
  for (const auto& field : kFields) {
    if (!text.empty()) text += ';';
    text.append(field.name) += '=';
    text += field.get(spec);
  }
  return text;
}

RunSpec parseSpec(std::string_view text) {
  RunSpec spec;
  setFields(spec, text);
  if (spec.scene.empty()) throw Misuse("a run's text names no scene");
  return spec;
}

std::string integratorName(const RunSpec& spec) {
  if (findPeer(spec.method)) return spec.method;
  if (spec.options.order == OrderControl::kVariable) return spec.configuration;
  return spec.configuration + ":" + spec.method;
}

void refuseFamilyOfFixedOrder(const RunSpec& spec) {
  if (!isFamily(spec.method) || spec.options.order != OrderControl::kFixed) return;
  throw Misuse(fmt::format("illegal combination: order 'fixed' with '{0}': that is a family, for order "
                           "'variable' only; a method has its number of stages, {0}_5",
                           spec.method));
}

Index stagesInId(std::string_view method) {
  Index stages = 0;
  const char* digits = method.data() + method.rfind('_') + 1;
  std::from_chars(digits, method.data() + method.size(), stages);
  return stages;
}

std::string settingsText(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  }
  return text;
}

void addSetting(Settings& settings, std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size()) {
    throw Misuse(fmt::format("setting '{}' is not of the form name=value", text));
  }
  requirePlain("setting", text, "; \n");
  settings[std::string(text.substr(0, equals))] = text.substr(equals + 1);
}

}  // namespace irk
