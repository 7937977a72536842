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
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/run.h"
#include "experiments/study/drawn/dice.h"
#include "experiments/study/drawn/options.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk::audit {
namespace {

constexpr double kWidth = 4;                 // numeric settings are multiplied by a factor in 1/kWidth .. kWidth
constexpr const char* kForeign = "foreign";  // the collection of scenes whose parameters are drawn over their ranges
constexpr double kDefaults = 0.5, kForeignDefaults = 0.1;  // of the runs have the scene's default settings
constexpr double kEnds = 0.5;                              // of the drawn variants end at another time
constexpr double kPeers = 0.15;                            // of the runs are made by other libraries
constexpr double kOnTheWay = 0.3;                          // of the runs with a closed form are also judged on the way
constexpr int kTimesOnTheWay = 4;
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
std::string drawnValue(Dice& dice, const Parameter& p, double t_end, bool foreign) {
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
  const double part = dice.uniform();
  if (foreign && p.min > 0) return threeDigits(p.min * std::pow(p.max / p.min, part));
  const double factor = std::pow(kWidth, 2 * part - 1);
  const auto number = defaultNumber(p);
  if (!number || *number == 0) return "";
  return threeDigits(std::clamp(*number * factor, p.min, p.max));
}

bool isForeign(const SceneEntry& scene) {
  return std::count(scene.collections.begin(), scene.collections.end(), kForeign) > 0;
}

Settings drawnOnce(Dice& dice, const SceneEntry& scene, Discontinuity treatment, double t_end) {
  const bool foreign = isForeign(scene);
  Settings settings;
  for (const Parameter& p : scene.parameters) {
    if (p.only_smooth && treatment != Discontinuity::kSmooth) continue;
    const std::string value = drawnValue(dice, p, t_end, foreign);
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
    double t_end = 0;
    bool exact = false;  // the solution is known in closed form
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
    variant.exact = made.exact && !smooth;
    variant.t_end = made.t_end;
    Dice dice(fmt::format("{} end {} {}", options_.seed, scene.id, number));
    if (number >= 0 && dice.chance(kEnds)) variant.t_end = drawnEnd(dice, made.t_end);
    return variants_[key] = variant;
  }

  // All parts are drawn independently of each other, except the variant of the settings.
  std::optional<DrawnRun> drawn(Dice& dice, const SceneEntry& scene) {
    const bool by_peer = dice.chance(kPeers);
    const PeerEntry& peer = drawnPeer(dice);
    const std::string configuration = by_peer ? "default" : chosen(dice, kConfigurations);
    std::string treatment = chosen(dice, kTreatments);
    std::string formulation = chosen(dice, kFormulations);
    const bool defaults = dice.chance(isForeign(scene) ? kForeignDefaults : kDefaults);
    const Index number = dice.below(options_.variants);
    const MethodChoice method = drawnMethod(dice, configuration == "variable");
    const bool on_the_way = dice.chance(kOnTheWay);

    const bool smooth = treatment == idOf(Discontinuity::kSmooth);
    const Variant& variant = variantOf(scene, defaults ? -1 : number, smooth);
    const bool switches = variant.sizes.switches > 0;
    if (!switches) treatment.clear();
    if (variant.sizes.constraints == 0) formulation.clear();
    const bool first_order =
        formulation == idOf(Formulation::kFirstOrder) || formulation == idOf(Formulation::kFirstOrderPerStep);
    const bool algebraic = variant.sizes.nz > 0 && !first_order;
    if (!allowsSystem(scene.id, variant.settings, formulation, switches ? treatmentOf(configuration, treatment) : ""))
      return std::nullopt;
    const std::string small = method.smallId();
    if (!by_peer && !allowsMethod(configuration, small, algebraic)) return std::nullopt;

    DrawnRun run;
    run.treatment = !switches ? kNoSwitches : treatment.empty() ? kDefaultTreatment : treatment;
    run.spec.scene = scene.id;
    run.spec.settings = variant.settings;
    run.spec.t_end = variant.t_end;
    run.spec.time_limit = options_.time_limit;
    if (on_the_way && variant.exact) run.spec.reference_times = kTimesOnTheWay;
    set(run.spec, "configuration", configuration);
    set(run.spec, "method", by_peer ? peer.id : method.id());
    set(run.spec, "formulation", formulation);
    set(run.spec, "discontinuity", treatment);
    drawTolerances(dice, run.spec);
    if (by_peer) return allowsPeer(run.spec) ? std::optional(run) : std::nullopt;
    run.spec.error_bar = ErrorBarUse::kMeasured;
    if (run.spec.options.solver == StageSolverKind::kCoupledDense &&
        method.stages * variant.sizes.n() > kMaxCoupledRows) {
      return std::nullopt;
    }
    drawOptions(dice, run.spec, [&](const RunSpec& spec) { return allowsOptions(spec, small, algebraic); });
    return run;
  }

  const PeerEntry& drawnPeer(Dice& dice) const {
    std::vector<const PeerEntry*> peers;
    for (const auto& peer : peerCatalogue()) {
      if (peer.source.empty()) peers.push_back(&peer);  // none of a user's
    }
    return *peers[static_cast<std::size_t>(dice.below(std::ssize(peers)))];
  }

  bool remembered(const std::string& what, const RunSpec& spec) {
    const auto known = legal_.find(what);
    if (known != legal_.end()) return known->second;
    return legal_[what] = canBePrepared(spec);
  }

  // The treatment, or that of the configuration if it is empty.
  static std::string treatmentOf(const std::string& configuration, const std::string& treatment) {
    if (!treatment.empty()) return treatment;
    RunSpec spec;
    set(spec, "configuration", configuration);
    return std::string(idOf(spec.discontinuity));
  }

  // Whether the scene supports this formulation and treatment.
  bool allowsSystem(const std::string& scene, const Settings& settings, const std::string& formulation,
                    const std::string& treatment) {
    RunSpec spec;
    spec.scene = scene;
    spec.settings = settings;
    spec.method = "radau_iia_3";
    spec.discontinuity = Discontinuity::kLocate;
    set(spec, "formulation", formulation);
    set(spec, "discontinuity", treatment);
    std::string words;  // they may choose other equations, with other switches
    for (const Parameter& p : findScene(scene).parameters) {
      const auto given = settings.find(p.name);
      if (!p.choices.empty() && given != settings.end()) words += " " + given->second;
    }
    return remembered(fmt::format("{} {} {}{}", scene, formulation, treatment, words), spec);
  }

  bool allowsMethod(const std::string& configuration, const std::string& method, bool algebraic) {
    RunSpec spec;
    set(spec, "configuration", configuration);
    return allowsOptions(spec, method, algebraic);
  }

  bool allowsOptions(const RunSpec& of, const std::string& method, bool algebraic) {
    RunSpec spec;
    spec.scene = sceneOfKind(algebraic ? SceneKind::kIndex1 : SceneKind::kStiffTest);
    spec.configuration = of.configuration;
    spec.options = of.options;
    spec.options.tolerances.rtol = spec.options.tolerances.atol = RunSpec{}.options.tolerances.atol;
    spec.method = method;
    return remembered(canonicalText(spec), spec);
  }

  bool allowsPeer(const RunSpec& spec) {
    return remembered(fmt::format("{} {} {} {} {}", spec.method, spec.scene, settingsText(spec.settings),
                                  idOf(spec.formulation), idOf(spec.discontinuity)),
                      spec);
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

}  // namespace irk::audit
