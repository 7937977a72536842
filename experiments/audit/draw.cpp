#include "experiments/audit/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "core/misuse.h"
#include "experiments/audit/dice.h"
#include "experiments/numbers.h"
#include "experiments/run.h"
#include "tableaus/catalogue.h"

namespace irk::audit {
namespace {

constexpr double kWidth = 4;  // settings are multiplied by 1/kWidth .. kWidth
constexpr Index kMostElements = 4, kMostUnknowns = 100;
constexpr int kMostAttempts = 1000;

constexpr Index kStages[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 20};
constexpr double kStageWeights[] = {4, 10, 12, 10, 12, 8, 10, 8, 10, 3, 3, 2, 4, 2, 2};

struct Choice {
  const char* id;  // empty: not given
  double weight;
};
constexpr Choice kConfigurations[] = {
    {"default", 0.35}, {"paper", 0.15}, {"embedded", 0.25}, {"variable", 0.25}};
constexpr Choice kTreatments[] = {
    {"", 0.48}, {"ignore", 0.1}, {"iterate", 0.13}, {"locate", 0.19}, {"smooth", 0.1}};
constexpr Choice kFormulations[] = {{"", 0.5},    {"index3", 0.1}, {"ggl", 0.1}, {"index2_projected", 0.1},
                                    {"index1", 0.1}, {"first_order", 0.1}};

template <std::size_t N>
std::string chosen(Dice& dice, const Choice (&choices)[N]) {
  double weights[N];
  std::transform(choices, choices + N, weights, [](const Choice& c) { return c.weight; });
  return choices[dice.weighted(weights)].id;
}

bool isSmoothing(const Parameter& p) { return p.name.starts_with("smoothing"); }

// Nothing for a default that is a word ("inf", "vb").
std::optional<double> defaultNumber(const Parameter& p) {
  char* end = nullptr;
  const double x = std::strtod(p.default_value.c_str(), &end);
  const bool number = *end == '\0' && std::isfinite(x) && !p.default_value.empty();
  return number ? std::optional(x) : std::nullopt;
}

std::string threeDigits(double x) { return fmt::format("{:.3g}", x); }

// Empty: the default stays.
std::string drawnValue(Dice& dice, const Parameter& p, double t_end) {
  if (!p.choices.empty()) {
    return p.choices[static_cast<std::size_t>(dice.below(static_cast<Index>(p.choices.size())))];
  }
  if (p.whole) {
    const Index most = p.name == "elements" ? kMostElements : kMostUnknowns;
    return std::to_string(dice.between(static_cast<Index>(p.min), most));
  }
  if (p.name == "torque_off_at") {
    const bool off = dice.chance(0.5);
    const double at = dice.uniform() * t_end;
    return off ? threeDigits(at) : "";
  }
  const double factor = std::pow(kWidth, 2 * dice.uniform() - 1);
  const auto number = defaultNumber(p);
  if (!number || *number == 0) return "";
  return threeDigits(std::clamp(*number * factor, p.min, p.max));
}

Settings drawnOnce(Dice& dice, const SceneEntry& scene, Discontinuity treatment, double t_end) {
  Settings settings;
  for (const Parameter& p : scene.parameters) {
    if (isSmoothing(p) && treatment != Discontinuity::kSmooth) continue;
    const std::string value = drawnValue(dice, p, t_end);
    if (!value.empty() && value != p.default_value) settings[p.name] = value;
  }
  return settings;
}

// A scene can be made, and it has something to integrate.
bool canBeMade(const SceneEntry& scene, const Settings& settings) {
  try {
    const auto made = makeScene<double>(scene.id, settings);
    const bool finite = made.start.u.allFinite() && made.start.v.allFinite() &&
                        made.start.x.allFinite() && made.start.w.allFinite();
    return finite && std::isfinite(made.t_end) && made.start.t < made.t_end;
  } catch (const Misuse&) {
    return false;
  } catch (const std::logic_error&) {  // no consistent start
    return false;
  }
}

std::string drawnMethod(Dice& dice, bool variable) {
  const auto& families = familyCatalogue();
  for (;;) {
    const auto& family = families[static_cast<std::size_t>(dice.below(static_cast<Index>(families.size())))];
    const bool whole = dice.chance(0.5);
    const Index stages = kStages[dice.weighted(kStageWeights)];
    if (variable && whole) return family.id;
    if (stages >= family.min_stages) return fmt::format("{}_{}", family.id, stages);
  }
}

// Legality must not depend on the default that a run leaves open.
bool isLegal(const DrawnRun& run) {
  RunSpec spec = run.spec;
  if (run.treatment == kDefaultTreatment) spec.discontinuity = Discontinuity::kLocate;
  try {
    prepare(spec);
    return true;
  } catch (const Misuse&) {
    return false;
  }
}

void set(RunSpec& spec, std::string_view field, std::string_view value) {
  if (!value.empty()) findField(field).set(spec, value);
}

// The scene's settings are drawn before what depends on its sizes.
DrawnRun drawnOnce(Dice& dice, const SceneEntry& scene, const AuditOptions& options) {
  DrawnRun run;
  RunSpec& spec = run.spec;
  spec.scene = scene.id;
  const std::string configuration = chosen(dice, kConfigurations);
  const std::string treatment = chosen(dice, kTreatments);
  const std::string formulation = chosen(dice, kFormulations);
  const bool defaults = dice.chance(0.5);
  const Index variant = dice.below(options.variants);
  const std::string method = drawnMethod(dice, configuration == "variable");
  const auto tolerance = fmt::format("1e-{}", dice.between(2, 13));

  const bool smooth = treatment == idOf(Discontinuity::kSmooth);
  if (!defaults) {
    spec.settings = drawnSettings(scene, options.seed, variant,
                                  smooth ? Discontinuity::kSmooth : Discontinuity::kIgnore);
  }
  const Sizes n = makeScene<double>(scene.id, spec.settings).sizes();
  set(spec, "configuration", configuration);
  set(spec, "method", method);
  set(spec, "rtol", tolerance);
  set(spec, "atol", tolerance);
  spec.time_limit = options.time_limit;
  if (n.switches > 0) set(spec, "discontinuity", treatment);
  if (n.constraints > 0) set(spec, "formulation", formulation);
  run.treatment = n.switches == 0 ? kNoSwitches : treatment.empty() ? kDefaultTreatment : treatment;
  run.spec = resolved(spec);
  return run;
}

}  // namespace

Settings drawnSettings(const SceneEntry& scene, std::uint64_t seed, Index variant,
                       Discontinuity treatment) {
  const double t_end = makeScene<double>(scene.id).t_end;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    Dice dice(fmt::format("{} settings {} {} {}", seed, scene.id, variant, attempt));
    const Settings settings = drawnOnce(dice, scene, treatment, t_end);
    if (canBeMade(scene, settings)) return settings;
  }
  return {};
}

std::vector<DrawnRun> drawnRuns(const AuditOptions& options) {
  const auto& scenes = sceneCatalogue();
  std::vector<DrawnRun> runs(static_cast<std::size_t>(options.runs));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Dice dice(fmt::format("{} run {}", options.seed, i));
    const auto& scene = scenes[static_cast<std::size_t>(dice.below(static_cast<Index>(scenes.size())))];
    int attempts = 0;
    do {
      if (++attempts > kMostAttempts) {
        throw std::logic_error("audit: no legal run of scene " + scene.id);
      }
      runs[i] = drawnOnce(dice, scene, options);
    } while (!isLegal(runs[i]));
  }
  return runs;
}

std::string commandOf(const DrawnRun& run) {
  const RunSpec& spec = run.spec;
  std::string command = "irk solve " + spec.scene;
  for (const auto& [name, value] : spec.settings) command += fmt::format(" --set {}={}", name, value);
  if (spec.configuration != "default") command += " --configuration " + spec.configuration;
  command += " --method " + spec.method;
  const RunSpec defaults;
  if (spec.formulation != defaults.formulation) {
    command += fmt::format(" --formulation {}", idOf(spec.formulation));
  }
  if (run.treatment != kDefaultTreatment && run.treatment != kNoSwitches) {
    command += " --discontinuity " + run.treatment;
  }
  command += fmt::format(" --tol {:g}", spec.options.tolerances.rtol);
  if (spec.t_end != makeScene<double>(spec.scene, spec.settings).t_end) {
    command += fmt::format(" --t-end {}", spec.t_end);
  }
  if (spec.time_limit > 0) command += fmt::format(" --time-limit {}", spec.time_limit);
  return command;
}

}  // namespace irk::audit
