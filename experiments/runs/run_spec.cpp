#include "experiments/runs/run_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/base/text.h"
#include "core/control/order_controller.h"
#include "experiments/base/numbers.h"
#include "irk/scene_file.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr Named<ScalarKind> kScalars[] = {
    {{}, "double", "53 bits"},
    {{50}, "mp50", "50 decimal digits, for orders that double cannot show; any number from mp30 to mp1000 is legal"},
    {{100}, "mp100", "100 digits, for orders from about 20 on"}};

constexpr Named<ConstraintUse> kConstraintUses[] = {
    {ConstraintUse::kAll, "all", "all; where they depend on each other, the run ends as singular"},
    {ConstraintUse::kIndependent, "independent", "a choice made at the start; the others are checked at each step"}};
constexpr Named<ReferenceUse> kReferenceUses[] = {
    {ReferenceUse::kNone, "none", "where no reference is stored, the error is unknown"},
    {ReferenceUse::kAuto, "auto", "where no reference is stored, one is computed and kept in the user's cache"}};

constexpr Named<ErrorBarUse> kErrorBarUses[] = {
    {ErrorBarUse::kNone, "none", "one integration only"},
    {ErrorBarUse::kMeasured, "measured",
     "a second integration, by another family with a tenth of the tolerance, gives an error bar (study files: true)"},
    {ErrorBarUse::kRefined, "refined", "the same, and the result is that of the strictest integration"}};

}  // namespace

IRK_AXIS_IDS(ScalarKind, kScalars, "scalar")
std::string idOf(ScalarKind scalar) { return scalar.isDouble() ? "double" : fmt::format("mp{}", scalar.digits); }
template <>
ScalarKind parseId<ScalarKind>(std::string_view id) {
  int digits = 0;
  if (id.starts_with("mp")) {
    const auto [end, error] = std::from_chars(id.data() + 2, id.data() + id.size(), digits);
    const bool in_range = digits >= ScalarKind::kLeastDigits && digits <= ScalarKind::kMostDigits;
    if (error == std::errc() && end == id.data() + id.size()) {
      if (in_range) return {digits};
      throw Misuse(
          fmt::format("scalar '{}': mp{} to mp{} expected", id, ScalarKind::kLeastDigits, ScalarKind::kMostDigits));
    }
  }
  return entryNamed("scalar", id, kScalars, &Named<ScalarKind>::id).value;
}

IRK_AXIS(ConstraintUse, kConstraintUses, "constraints")
IRK_AXIS(ReferenceUse, kReferenceUses, "reference")
IRK_AXIS(ErrorBarUse, kErrorBarUses, "error_bars")

double epsilonOf(ScalarKind scalar) {
  return scalar.isDouble() ? std::numeric_limits<double>::epsilon() : std::pow(10.0, -std::min(scalar.digits, 300));
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
  const bool stops = !spec.options.stop_at.empty() || spec.options.steady > 0;
  if (stops && spec.reference_times > 1) {
    throw Misuse(fmt::format("illegal combination: reference_times = {} with stop_at or steady: the end is not known",
                             spec.reference_times));
  }
  Settings values = spec.settings;
  std::erase_if(values, [](const auto& setting) { return setting.second.ends_with("/h"); });  // known with the step
  static_cast<void>(completedSettings(spec.scene, parameters, values));
  if (std::isnan(spec.t_end)) spec.t_end = makeScene<double>(spec.scene, settingsAtStep(spec)).t_end;
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

void refuseFamilyOfFixedOrder(const RunSpec& spec) {
  if (!isFamily(spec.method) || choosesOrder(spec.options.order)) return;
  throw Misuse(
      fmt::format("illegal combination: order 'fixed' with '{0}': that is a family, for order "
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

void requirePlain(std::string_view field, std::string_view value, std::string_view forbidden) {
  const auto at = value.find_first_of(forbidden);
  if (at != std::string_view::npos) {
    throw Misuse(fmt::format("{} = '{}': '{}' is not allowed here", field, value, value[at]));
  }
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
