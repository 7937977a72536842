#include "experiments/study/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>

#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/runs/run.h"
#include "experiments/study/dice.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk::audit {
namespace {

constexpr double kWidth = 4;  // numeric settings are multiplied by a factor in 1/kWidth .. kWidth
constexpr int kMaxAttempts = 1000;

// A run looks at its time limit between attempts only, and one factorization of 8000 coupled rows takes 21 s. Larger
// coupled dense systems than this are not drawn.
constexpr Index kMaxCoupledRows = 3000;

constexpr Index kStages[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 20};
constexpr double kStageWeights[] = {4, 10, 12, 10, 12, 8, 10, 8, 10, 3, 3, 2, 4, 2, 2};

struct Choice {
  const char* id;  // empty: not given
  double weight;
};
constexpr Choice kConfigurations[] = {{"default", 0.35}, {"paper", 0.15}, {"embedded", 0.25}, {"variable", 0.25}};
constexpr Choice kTreatments[] = {{"", 0.48}, {"ignore", 0.1}, {"iterate", 0.13}, {"locate", 0.19}, {"smooth", 0.1}};
constexpr Choice kFormulations[] = {{"", 0.5},
                                    {"index3", 0.1},
                                    {"ggl", 0.1},
                                    {"index2_projected", 0.1},
                                    {"index1", 0.1},
                                    {"first_order", 0.08},
                                    {"first_order_per_step", 0.02}};

template <std::size_t N>
std::string chosen(Dice& dice, const Choice (&choices)[N]) {
  double weights[N];
  std::transform(choices, choices + N, weights, [](const Choice& c) { return c.weight; });
  return choices[dice.weighted(weights)].id;
}

// The default as a number; nullopt if it is a word ("inf", "vb").
std::optional<double> defaultNumber(const Parameter& p) {
  char* end = nullptr;
  const double x = std::strtod(p.default_value.c_str(), &end);
  const bool number = *end == '\0' && std::isfinite(x) && !p.default_value.empty();
  return number ? std::optional(x) : std::nullopt;
}

std::string threeDigits(double x) { return fmt::format("{:.3g}", x); }

// A drawn value; empty keeps the default.
std::string drawnValue(Dice& dice, const Parameter& p, double t_end) {
  if (!p.choices.empty()) {
    return p.choices[static_cast<std::size_t>(dice.below(static_cast<Index>(p.choices.size())))];
  }
  if (p.whole) {
    const double most = p.audit_max > 0 ? p.audit_max : p.max;
    return std::to_string(dice.between(static_cast<Index>(p.min), static_cast<Index>(most)));
  }
  if (p.is_time) {
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
    if (p.only_smooth && treatment != Discontinuity::kSmooth) continue;
    const std::string value = drawnValue(dice, p, t_end);
    if (!value.empty() && value != p.default_value) settings[p.name] = value;
  }
  return settings;
}

// nullopt if no scene can be made with the settings, or if the scene has nothing to integrate.
std::optional<Scene<double>> sceneOf(const std::string& id, const Settings& settings) {
  try {
    auto scene = makeScene<double>(id, settings);
    const bool finite = scene.start.u.allFinite() && scene.start.v.allFinite() && scene.start.x.allFinite() &&
                        scene.start.w.allFinite();
    const bool usable = finite && std::isfinite(scene.t_end) && scene.start.t < scene.t_end;
    return usable ? std::optional(std::move(scene)) : std::nullopt;
  } catch (const Misuse&) {
    return std::nullopt;
  } catch (const std::logic_error&) {  // no consistent start
    return std::nullopt;
  }
}

// The catalogue's first scene of this kind.
const std::string& sceneOfKind(SceneKind kind) {
  const auto& scenes = sceneCatalogue();
  return std::find_if(scenes.begin(), scenes.end(), [kind](const auto& scene) { return scene.kind == kind; })->id;
}

bool canBePrepared(const RunSpec& spec) {
  try {
    prepare(spec);
    return true;
  } catch (const Misuse&) {
    return false;
  }
}

struct MethodChoice {
  std::string family;
  Index stages;  // 0: variable order over the whole family

  std::string id() const { return stages == 0 ? family : fmt::format("{}_{}", family, stages); }
  // A member with few stages, which costs less to make. It is refused for the same reasons, which are properties of the
  // family, except for its smallest members.
  std::string smallId() const {
    return stages == 0 ? family : fmt::format("{}_{}", family, std::min<Index>(stages, 4));
  }
};

MethodChoice drawnMethod(Dice& dice, bool variable) {
  const auto& families = familyCatalogue();
  for (;;) {
    const auto& family = families[static_cast<std::size_t>(dice.below(static_cast<Index>(families.size())))];
    const bool whole = dice.chance(0.5);
    const Index stages = kStages[dice.weighted(kStageWeights)];
    if (variable && whole) return {family.id, 0};
    if (stages >= family.min_stages) return {family.id, stages};
  }
}

void set(RunSpec& spec, std::string_view field, std::string_view value) {
  if (!value.empty()) findField(field).set(spec, value);
}

}  // namespace

/// Draws the runs of one audit. Caches what the draws of a scene share.
class Draw::Drawer {
 public:
  explicit Drawer(const AuditOptions& options) : options_(options) {
    for (const auto& id : options.scenes) scenes_.push_back(&findScene(id));
    if (!scenes_.empty()) return;
    for (const auto& scene : sceneCatalogue()) {
      if (!scene.registered) scenes_.push_back(&scene);
    }
  }

  DrawnRun run(int number) {
    Dice dice(fmt::format("{} run {}", options_.seed, number));
    const auto& scene = *scenes_[static_cast<std::size_t>(dice.below(static_cast<Index>(scenes_.size())))];
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      if (auto run = drawn(dice, scene)) return *run;
    }
    throw std::logic_error("audit: no legal run of scene " + scene.id);
  }

 private:
  struct Variant {
    Settings settings;
    Sizes sizes;
    double t_end;
  };

  const Variant& variantOf(const SceneEntry& scene, Index number, bool smooth) {
    const auto key = fmt::format("{} {} {}", scene.id, number, smooth);
    const auto known = variants_.find(key);
    if (known != variants_.end()) return known->second;
    Variant variant;
    const auto treatment = smooth ? Discontinuity::kSmooth : Discontinuity::kIgnore;
    if (number >= 0) variant.settings = drawnSettings(scene, options_.seed, number, treatment);
    const auto made = makeScene<double>(scene.id, variant.settings);
    variant.sizes = made.sizes();
    variant.t_end = made.t_end;
    return variants_[key] = variant;
  }

  // All parts are drawn independently of each other, except the variant of the settings.
  std::optional<DrawnRun> drawn(Dice& dice, const SceneEntry& scene) {
    const std::string configuration = chosen(dice, kConfigurations);
    std::string treatment = chosen(dice, kTreatments);
    std::string formulation = chosen(dice, kFormulations);
    const bool defaults = dice.chance(0.5);
    const Index number = dice.below(options_.variants);
    const MethodChoice method = drawnMethod(dice, configuration == "variable");
    const auto tolerance = fmt::format("1e-{}", dice.between(2, 13));

    const bool smooth = treatment == idOf(Discontinuity::kSmooth);
    const Variant& variant = variantOf(scene, defaults ? -1 : number, smooth);
    const bool switches = variant.sizes.switches > 0;
    if (!switches) treatment.clear();
    if (variant.sizes.constraints == 0) formulation.clear();
    const bool first_order =
        formulation == idOf(Formulation::kFirstOrder) || formulation == idOf(Formulation::kFirstOrderPerStep);
    const bool algebraic = variant.sizes.nz > 0 && !first_order;
    if (!allowsSystem(scene.id, variant.settings, formulation, treatment)) return std::nullopt;
    if (!allowsMethod(configuration, method, algebraic)) return std::nullopt;

    DrawnRun run;
    run.treatment = !switches ? kNoSwitches : treatment.empty() ? kDefaultTreatment : treatment;
    run.spec.scene = scene.id;
    run.spec.settings = variant.settings;
    run.spec.t_end = variant.t_end;
    run.spec.time_limit = options_.time_limit;
    set(run.spec, "configuration", configuration);
    if (run.spec.options.solver == StageSolverKind::kCoupledDense &&
        method.stages * variant.sizes.n() > kMaxCoupledRows) {
      return std::nullopt;
    }
    set(run.spec, "method", method.id());
    set(run.spec, "formulation", formulation);
    set(run.spec, "discontinuity", treatment);
    set(run.spec, "rtol", tolerance);
    set(run.spec, "atol", tolerance);
    return run;
  }

  bool remembered(const std::string& what, const RunSpec& spec) {
    const auto known = legal_.find(what);
    if (known != legal_.end()) return known->second;
    return legal_[what] = canBePrepared(spec);
  }

  // Whether the scene supports this formulation and treatment. An empty treatment is always legal.
  bool allowsSystem(const std::string& scene, const Settings& settings, const std::string& formulation,
                    const std::string& treatment) {
    RunSpec spec;
    spec.scene = scene;
    spec.settings = settings;
    spec.method = "radau_iia_3";
    spec.discontinuity = Discontinuity::kLocate;
    set(spec, "formulation", formulation);
    set(spec, "discontinuity", treatment);
    return remembered(fmt::format("{} {} {}", scene, formulation, treatment), spec);
  }

  bool allowsMethod(const std::string& configuration, const MethodChoice& method, bool algebraic) {
    RunSpec spec;
    spec.scene = sceneOfKind(algebraic ? SceneKind::kIndex1 : SceneKind::kStiffTest);
    set(spec, "configuration", configuration);
    spec.method = method.smallId();
    return remembered(fmt::format("{} {} {}", spec.scene, configuration, spec.method), spec);
  }

  AuditOptions options_;
  std::vector<const SceneEntry*> scenes_;
  std::map<std::string, Variant> variants_;
  std::map<std::string, bool> legal_;
};

Settings drawnSettings(const SceneEntry& scene, std::uint64_t seed, Index variant, Discontinuity treatment) {
  const double t_end = makeScene<double>(scene.id).t_end;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    Dice dice(fmt::format("{} settings {} {} {}", seed, scene.id, variant, attempt));
    const Settings settings = drawnOnce(dice, scene, treatment, t_end);
    if (sceneOf(scene.id, settings)) return settings;
  }
  return {};
}

Draw::Draw(const AuditOptions& options)
    : size_(static_cast<std::size_t>(options.runs)), drawer_(std::make_unique<Drawer>(options)) {}

Draw::~Draw() = default;

DrawnRun Draw::operator[](std::size_t i) const {
  const std::lock_guard lock(mutex_);
  return drawer_->run(static_cast<int>(i));
}

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
  command += " --tol " + numberText(spec.options.tolerances.rtol);
  if (spec.t_end != makeScene<double>(spec.scene, spec.settings).t_end) {
    command += " --t-end " + numberText(spec.t_end);
  }
  if (spec.time_limit > 0) command += " --time-limit " + numberText(spec.time_limit);
  return command + loadOptions(files);
}

}  // namespace irk::audit
