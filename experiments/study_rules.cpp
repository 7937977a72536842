#include "experiments/study_rules.h"

#include <fmt/format.h>

#include "experiments/peers/catalogue.h"

namespace irk {
namespace {

// Analyses that take one method's tableau: with variable order every step can have another one.
struct OneMethodAnalysis {
  const char* key;
  bool Study::*wanted;
  const char* reason;
};
constexpr OneMethodAnalysis kOneMethod[] = {
    {"scaling", &Study::scaling, "the time of a step is compared between methods of fixed stages"},
    {"estimates", &Study::estimates, "the error of a step is compared with one method's estimate"},
    {"phases", &Study::phases, "the parts of a run are timed with one method's matrices"}};

const StudyValue* keyOf(const StudyKeys& keys, std::string_view key) {
  const auto at = keys.find(key);
  return at == keys.end() ? nullptr : &at->second;
}

}  // namespace

void refuseVariableOrder(const Study& study, const StudyKeys& block, std::size_t first) {
  const auto& series = study.series;
  for (const auto& analysis : kOneMethod) {
    if (!(study.*analysis.wanted)) continue;
    for (std::size_t i = first; i < series.size(); ++i) {
      const RunSpec& spec = series[i].runs.front();
      if (spec.options.order != OrderControl::kVariable || findPeer(spec.method)) continue;
      const auto* key = keyOf(block, "order");
      if (!key) key = keyOf(block, "configuration");
      throw Misuse(fmt::format("{}: order 'variable' with {} = true: {}; use order 'fixed'",
                               (key ? key : keyOf(block, "scene"))->place, analysis.key,
                               analysis.reason));
    }
  }
}

}  // namespace irk
