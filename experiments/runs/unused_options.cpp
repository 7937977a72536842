#include "experiments/runs/unused_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"

namespace irk {
namespace {

void refuseForPeer(const RunSpec& spec, const std::vector<std::string>& given) {
  const auto& taken = peerFields();
  for (const auto& field : given) {
    if (std::find(taken.begin(), taken.end(), field) != taken.end()) continue;
    std::string options;
    for (const auto& name : taken) options += (options.empty() ? "" : ", ") + optionName(name);
    throw Misuse(fmt::format("{} has no effect with method '{}', another library's integrator; it takes {}, --set",
                             optionName(field), spec.method, options));
  }
}

}  // namespace

const std::vector<std::string>& peerFields() {
  static const std::vector<std::string> fields{
      "method", "formulation", "scaling",   "discontinuity", "scalar",    "derivatives",     "multipliers",
      "norm",   "storage",     "step",      "tol",           "rtol",      "atol_of",         "atol",
      "h_max",  "t_end",       "max_steps", "time_limit",    "reference", "reference_times", "error_bars"};
  return fields;
}

void refuseUnused(const RunSpec& spec, const std::vector<std::string>& given) {
  if (findPeer(spec.method)) return refuseForPeer(spec, given);
  const auto isGiven = [&](std::string_view field) {
    return std::find(given.begin(), given.end(), field) != given.end();
  };
  for (const auto& field : specFields()) {
    if (!isGiven(field.name) || !field.unused) continue;
    const auto reason = field.unused(spec);
    if (reason.empty()) continue;
    throw Misuse(fmt::format("{} has no effect here: {}", optionName(field.name), reason));
  }
  if (isGiven("tol") && isGiven("rtol") && isGiven("atol")) {
    throw Misuse("--tol has no effect beside --rtol and --atol: it sets both");
  }
}

}  // namespace irk
