#include <fmt/format.h>

#include "experiments/base/child_process.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/study/draw.h"
#include "experiments/study/drawn/options.h"
#include "irk/scene.h"

namespace irk::audit {
namespace {

// The options that differ from those of the configuration.
std::string optionsOf(const RunSpec& spec) {
  RunSpec configured;
  findField("configuration").set(configured, spec.configuration);
  std::string text;
  for (const auto name : drawnOptionNames()) {
    const auto& field = findField(name);
    const std::string value = field.get(spec);
    if (value != field.get(configured)) text += fmt::format(" {} {}", optionName(name), value);
  }
  return text;
}

std::string tolerancesOf(const RunSpec& spec) {
  const double rtol = spec.options.tolerances.rtol, atol = spec.options.tolerances.atol;
  if (rtol == atol) return " --tol " + numberText(rtol);
  return fmt::format(" --rtol {} --atol {}", numberText(rtol), numberText(atol));
}

}  // namespace

std::string commandOf(const DrawnRun& run) {
  const RunSpec& spec = run.spec;
  std::string command = "irk solve " + spec.scene;
  for (const auto& [name, value] : spec.settings) command += fmt::format(" --set {}", shellWord(name + "=" + value));
  if (spec.configuration != "default") command += " --configuration " + spec.configuration;
  const std::string files = filesOf(spec);
  command += " --method " + shellWord(methodIn(files, spec.method));
  const RunSpec defaults;
  if (spec.formulation != defaults.formulation) {
    command += fmt::format(" --formulation {}", idOf(spec.formulation));
  }
  if (run.treatment != kDefaultTreatment && run.treatment != kNoSwitches) {
    command += " --discontinuity " + run.treatment;
  }
  command += optionsOf(spec) + tolerancesOf(spec);
  if (spec.t_end != makeScene<double>(spec.scene, spec.settings).t_end) {
    command += " --t-end " + numberText(spec.t_end);
  }
  if (spec.time_limit > 0) command += " --time-limit " + numberText(spec.time_limit);
  if (spec.reference_times != 1) command += fmt::format(" --reference-times {}", spec.reference_times);
  if (spec.error_bar == ErrorBarUse::kNone) command += " --error-bar none";
  return command + loadOptions(files);
}

}  // namespace irk::audit
