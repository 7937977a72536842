#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <type_traits>

#include "core/base/text.h"
#include "irk/misuse.h"
#include "irk/registration.h"
#include "irk/scene.h"
#include "irk/scene_file.h"
#include "irk/system_check.h"

namespace irk {

// The structs of the scenes, sorted by id. IRK_SCENE in a scene's file defines the function irk::scenes::STRUCT.
// clang-format off
#define IRK_SCENES(scene) \
  scene(AncfCantilever) \
  scene(AncfLeafStop) \
  scene(AncfPendulum) \
  scene(AncfStop) \
  scene(Andrews) \
  scene(CrossingWires) \
  scene(Eight) \
  scene(Beam) \
  scene(BeamChain) \
  scene(BlowUp) \
  scene(BouncingBall) \
  scene(BouncingMass) \
  scene(CarAxis) \
  scene(ChemicalAkzo) \
  scene(Dahlquist) \
  scene(DcMotorChopper) \
  scene(E5) \
  scene(Elastica) \
  scene(Elastoplastic) \
  scene(NearExtinction) \
  scene(Heat) \
  scene(HeavyTop) \
  scene(Hires) \
  scene(HydraulicArm) \
  scene(HydraulicManipulator) \
  scene(Index1Nonlinear) \
  scene(Index2Jump) \
  scene(Index2Nonlinear) \
  scene(Index3Nonlinear) \
  scene(InputKink) \
  scene(InputPulse) \
  scene(Kaps) \
  scene(Kepler) \
  scene(Lorenz) \
  scene(MechanicalDae) \
  scene(MechatronicCrank) \
  scene(MedicalAkzo) \
  scene(NandGate) \
  scene(Oregonator) \
  scene(Pendulum) \
  scene(Pollution) \
  scene(ProtheroRobinson) \
  scene(ChargePump) \
  scene(RiccatiTracking) \
  scene(RingModulator) \
  scene(Robertson) \
  scene(SampledControl) \
  scene(SliderCrank) \
  scene(FlexibleSliderCrank) \
  scene(SlidingMass) \
  scene(SlowPassage) \
  scene(SolutionEnd) \
  scene(SpatialSliderCrank) \
  scene(StickSlip) \
  scene(LuGre) \
  scene(StribeckBox) \
  scene(TransistorAmplifier) \
  scene(TwoPointControl) \
  scene(UnstableMotion) \
  scene(VanDerPol)
// clang-format on

namespace scenes {
#define IRK_DECLARE(scene) SceneEntry scene();
IRK_SCENES(IRK_DECLARE)
#undef IRK_DECLARE
}  // namespace scenes

namespace {

// A deque: entries keep their addresses when others are added.
std::deque<SceneEntry>& catalogue() {
#define IRK_CALL(scene) scenes::scene(),
  static std::deque<SceneEntry> entries = {IRK_SCENES(IRK_CALL)};
#undef IRK_CALL
  return entries;
}

std::string sourceOf(const std::string& source) { return source.empty() ? "a scene of the program" : source; }

void requireName(const std::string& what, const std::string& name, const std::string& source) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (!name.empty() && name.find_first_not_of(kAllowed) == std::string::npos) return;
  throw Misuse(what + " '" + name + "' (" + sourceOf(source) + "): small letters, digits and '_' are allowed");
}

// The range of a number is not empty, and a default that is a number lies in it.
void requireRange(const Parameter& p, const SceneEntry& entry) {
  if (!p.choices.empty() || p.text) return;
  if (!(p.min <= p.max)) {
    throw Misuse(fmt::format("scene {} ({}): the parameter {} has the range [{}, {}]: the smaller end comes first",
                             entry.id, sourceOf(entry.source), p.name, p.min, p.max));
  }
  char* end = nullptr;
  const double value = std::strtod(p.default_value.c_str(), &end);
  const bool is_number = end != p.default_value.c_str() && *end == '\0';
  if (!is_number || !std::isfinite(value) || (value >= p.min && value <= p.max)) return;
  throw Misuse(fmt::format("scene {} ({}): the default {} of the parameter {} is not in [{}, {}]", entry.id,
                           sourceOf(entry.source), p.default_value, p.name, p.min, p.max));
}

}  // namespace

const std::deque<SceneEntry>& sceneCatalogue() { return catalogue(); }

void registerScene(SceneEntry entry) {
  entry.registered = true;
  entry.source = registeringSource();
  requireName("scene id", entry.id, entry.source);
  for (const auto& name : entry.collections) requireName("collection", name, entry.source);
  std::set<std::string_view> parameters;
  for (const Parameter& p : entry.parameters) {
    requireRange(p, entry);
    if (parameters.insert(p.name).second) continue;
    throw Misuse(
        fmt::format("scene {} ({}): two parameters are called '{}'", entry.id, sourceOf(entry.source), p.name));
  }
  for (const SceneEntry& other : catalogue()) {
    if (other.id != entry.id) continue;
    throw Misuse("scene id '" + entry.id + "' (" + sourceOf(entry.source) + ") is taken by " + sourceOf(other.source));
  }
  catalogue().push_back(std::move(entry));
}

const SceneEntry& findScene(std::string_view id) { return entryNamed("scene", id, sceneCatalogue(), &SceneEntry::id); }

namespace {

struct KindFacts {
  int index;
  std::string_view meaning;
};
// In the order of SceneKind.
constexpr KindFacts kKinds[] = {
    {0, "differential equations"},
    {0, "stiff test equation: y' = lambda (y - phi) + phi'"},
    {0, "singularly perturbed differential equations"},
    {1, "index 1: x' = f(x, z), 0 = g(x, z)"},
    {2, "index 2: x' = f(x, z), 0 = g(x)"},
    {3, "index 3: y' = f(y, w), w' = k(y, w, z), 0 = g(y)"},
    {3, "constrained mechanical system: M u'' = f - G^T z, 0 = g(u)"},
};
static_assert(std::size(kKinds) == static_cast<std::size_t>(SceneKind::kConstrained) + 1);

}  // namespace

int indexOf(SceneKind kind) { return kKinds[static_cast<std::size_t>(kind)].index; }

std::string_view meaningOf(SceneKind kind) { return kKinds[static_cast<std::size_t>(kind)].meaning; }

namespace {

template <class Real>
const std::function<Scene<Real>(const Settings&)>& makerOf(const SceneEntry& entry) {
  if constexpr (std::is_same_v<Real, double>) {
    return entry.make;
  } else {
    return entry.make_big_float;
  }
}

// Ids of scalars, as in experiments/runs/run_spec.cpp.
template <class Real>
std::string scalarId() {
  return std::is_same_v<Real, double> ? "double" : "mp" + std::to_string(WorkingDigits::now());
}

template <class Real>
[[noreturn]] void refuseScalar(const SceneEntry& refused) {
  std::string offers, offering;
  const auto append = [](std::string& list, const char* comma, const std::string& word) {
    list += (list.empty() ? "" : comma) + word;
  };
  if (refused.make) append(offers, " and ", "double");
  if (refused.make_big_float) append(offers, " and ", "multiprecision");
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (makerOf<Real>(entry)) append(offering, ", ", entry.id);
  }
  const std::string id = scalarId<Real>();
  throw Misuse("scalar = '" + id + "': scene " + refused.id + " offers " + (offers.empty() ? "none" : offers) +
               "; with " + id + ": " + offering);
}

// Messages of what makes a scene name the scene.
template <class F>
auto withNameOf(const SceneEntry& entry, const F& make) {
  try {
    return make();
  } catch (const Misuse& misuse) {
    throw Misuse("scene " + entry.id + ": " + misuse.what());
  }
}

// Options and tables name components, as in `--atol-of "theta=1e-10 lambda=1e-3"`.
void requireComponents(const std::string& scene, const std::vector<std::string>& names, const Vec<double>& scale) {
  std::set<std::string_view> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (name.empty() || name.find_first_of(" \t\r\n,;=\"") != name.npos) {
      throw Misuse(
          fmt::format("scene {}: component {} is called '{}': a name is not empty and has no blank, ',', ';', '=' and "
                      "'\"'",
                      scene, i, name));
    }
    if (!known.insert(name).second) throw Misuse(fmt::format("scene {}: two components are called '{}'", scene, name));
    const auto at = static_cast<Index>(i);
    if (at < scale.size() && !(scale[at] > 0 && std::isfinite(scale[at]))) {
      throw Misuse(
          fmt::format("scene {}: the typical magnitude of {} is {}: a number > 0 is expected", scene, name, scale[at]));
    }
  }
}

// The sizes of a scene whose system, start and end fit each other.
template <class Real>
Sizes checkedSizes(const Scene<Real>& scene) {
  const auto system = scene.system({});
  requireSystem(system.get(), {});
  requireStart(*system, scene.start, Real(scene.t_end));
  return system->sceneSizes();
}

// What a scene says of its components fits its sizes.
template <class Real>
void requireDescription(const Scene<Real>& scene, const Sizes& n) {
  requireScale(scene.scale, n);
  if (!scene.units.empty() && scene.units.size() != static_cast<std::size_t>(n.components())) {
    throw Misuse(fmt::format("{} units, but it has {} components", scene.units.size(), n.components()));
  }
  if (scene.exact) requireState("exact", scene.exact(scene.start.t), n);
  for (const auto& output : scene.outputs) {
    if (!output.value) throw Misuse(fmt::format("its output '{}' has no function `value`", output.name));
  }
}

// Columns of panels that the scene does not have would be left out of its figures without a word. With other settings
// than the defaults a scene may have fewer components.
template <class Real>
void requirePanels(const SceneEntry& entry, const Scene<Real>& scene, const Settings& completed) {
  const bool defaults = std::all_of(entry.parameters.begin(), entry.parameters.end(),
                                    [&](const Parameter& p) { return completed.at(p.name) == p.default_value; });
  if (!entry.registered || !defaults) return;
  std::vector<std::string> known = scene.names;
  for (const auto& output : scene.outputs) known.push_back(output.name);
  for (const Panel& panel : entry.panels) {
    for (const std::string& column : panel.columns) {
      const auto colon = column.find(':');
      for (const auto& name : {column.substr(0, colon), column.substr(colon == column.npos ? 0 : colon + 1)}) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Misuse(
            fmt::format("scene {}: panel '{}': {}", entry.id, panel.title, unknownName("column", name, known)));
      }
    }
  }
}

}  // namespace

template <class Real>
Scene<Real> makeScene(const SceneEntry& entry, const Settings& settings) {
  const Settings completed = completedSettings(entry.id, entry.parameters, settings);
  const auto& make = makerOf<Real>(entry);
  if (!make) refuseScalar<Real>(entry);
  const TableReadings readings(entry.folder);
  Scene<Real> scene = withNameOf(entry, [&] { return make(completed); });
  scene.tables = readings.all();
  if (!scene.system) throw Misuse("scene " + entry.id + " makes no system");
  scene.id = entry.id;
  const Sizes sizes = withNameOf(entry, [&] { return checkedSizes(scene); });
  const Index components = sizes.components();
  const auto names = static_cast<Index>(scene.names.size());
  if (names > 0 && names != components) {
    throw Misuse("scene " + entry.id + " names " + std::to_string(names) + " components, but it has " +
                 std::to_string(components) + ": u, v, x and z (setComponents)");
  }
  requireComponents(entry.id, scene.names, scene.scale);
  withNameOf(entry, [&] { requireDescription(scene, sizes); });
  requirePanels(entry, scene, completed);
  return scene;
}

template <class Real>
void requireInTables(const Scene<Real>& scene, double t_end) {
  const auto t0 = static_cast<double>(scene.start.t);
  for (const TableRead& table : scene.tables) {
    const double first = std::strtod(table.first.c_str(), nullptr), last = std::strtod(table.last.c_str(), nullptr);
    if (std::min(t0, t_end) >= first && std::max(t0, t_end) <= last) continue;
    throw Misuse(fmt::format("scene {}: {} has {} from t = {} to {}, and the run goes from {:g} to {:g}", scene.id,
                             table.file, table.column, table.first, table.last, t0, t_end));
  }
}

template <class Real>
Scene<Real> makeScene(std::string_view id, const Settings& settings) {
  return makeScene<Real>(findScene(id), settings);
}

template void requireInTables(const Scene<double>&, double);
template void requireInTables(const Scene<BigFloat>&, double);
template Scene<double> makeScene<double>(const SceneEntry&, const Settings&);
template Scene<BigFloat> makeScene<BigFloat>(const SceneEntry&, const Settings&);
template Scene<double> makeScene<double>(std::string_view, const Settings&);
template Scene<BigFloat> makeScene<BigFloat>(std::string_view, const Settings&);

}  // namespace irk
