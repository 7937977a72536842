#include "experiments/runs/unused_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "experiments/runs/peers/catalogue.h"

namespace irk {
namespace {

bool fixedSteps(const RunSpec& spec) { return spec.options.step.control == StepControl::kFixed; }
bool oneOrder(const RunSpec& spec) { return spec.options.order == OrderControl::kFixed; }
bool stopsByResidual(const RunSpec& spec) {
  const auto kind = spec.options.newton.kind;
  return kind == NewtonKind::kModified || kind == NewtonKind::kFull;
}
bool stopsByIncrement(const RunSpec& spec) { return !stopsByResidual(spec); }
bool keepsNoContractivity(const RunSpec& spec) {
  return spec.options.newton.kind != NewtonKind::kModified;
}

/// A field that means nothing for some runs.
struct Rule {
  std::string_view field;
  bool (*unused)(const RunSpec&);
  std::string_view reason;
};
constexpr std::string_view kNoTolerance = "fixed steps have no tolerance; give --tol without --step";
constexpr std::string_view kOnlyResidual = "it belongs to newton 'modified' and 'full'";
constexpr std::string_view kOnlyIncrement = "it belongs to newton 'simplified' and 'broyden'";
constexpr Rule kRules[] = {
    {"rtol", fixedSteps, kNoTolerance},
    {"atol", fixedSteps, kNoTolerance},
    {"norm", fixedSteps, kNoTolerance},
    {"kappa", fixedSteps, "with fixed steps Newton's method iterates to round-off"},
    {"h_max", fixedSteps, "fixed steps have the size --step"},
    {"max_stages", oneOrder, "it belongs to order 'variable'"},
    {"residual_tolerance", stopsByIncrement, kOnlyResidual},
    {"contractivity_limit", keepsNoContractivity, "it belongs to newton 'modified'"},
    {"contractivity_after", keepsNoContractivity, "it belongs to newton 'modified'"},
    {"kappa", stopsByResidual, kOnlyIncrement},
    {"keep_jacobian_below", stopsByResidual, kOnlyIncrement}};

std::string optionOf(std::string_view field) {
  std::string option = "--" + std::string(field);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

void refuseForPeer(const RunSpec& spec, const std::vector<std::string>& given) {
  const auto& taken = peerFields();
  for (const auto& field : given) {
    if (std::find(taken.begin(), taken.end(), field) != taken.end()) continue;
    std::string options;
    for (const auto& name : taken) options += (options.empty() ? "" : ", ") + optionOf(name);
    throw Misuse(fmt::format("{} has no effect with method '{}', another library's integrator; it takes {}, --set",
                             optionOf(field), spec.method, options));
  }
}

}  // namespace

const std::vector<std::string>& peerFields() {
  static const std::vector<std::string> fields{
      "method", "formulation", "scaling", "discontinuity", "scalar",    "derivatives", "multipliers", "norm",
      "step",   "tol",         "rtol",    "atol",          "h_max",     "t_end",       "max_steps",   "time_limit"};
  return fields;
}

void refuseUnused(const RunSpec& spec, const std::vector<std::string>& given) {
  if (findPeer(spec.method)) return refuseForPeer(spec, given);
  const auto isGiven = [&](std::string_view field) {
    return std::find(given.begin(), given.end(), field) != given.end();
  };
  for (const auto& rule : kRules) {
    if (!isGiven(rule.field) || !rule.unused(spec)) continue;
    throw Misuse(fmt::format("{} has no effect here: {}", optionOf(rule.field), rule.reason));
  }
  if (isGiven("estimate") && fixedSteps(spec) && spec.options.step.estimate != ErrorEstimate::kNone) {
    throw Misuse(fmt::format("--estimate {} has no effect here: fixed steps have no error estimate",
                             idOf(spec.options.step.estimate)));
  }
  if (isGiven("tol") && isGiven("rtol") && isGiven("atol")) {
    throw Misuse("--tol has no effect beside --rtol and --atol: it sets both");
  }
}

}  // namespace irk
