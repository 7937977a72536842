// Scenes of a user that do not fit together, and names that do not exist.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "irk/collections.h"
#include "irk/scene_file.h"
#include "irk/system_check.h"
#include "tests/misuse_table.h"

namespace irk::test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// u'' = -u, x' = -x.
struct Pair {
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] - p.a[0];
    r.x[0] = -p.x[0] - p.k[0];
  }
};

using Made = Scene<double>;

// The entry of a scene that `change` has changed.
template <class Change>
SceneEntry entryWith(Change change) {
  SceneEntry entry;
  entry.id = "pair";
  entry.make = [change](const Settings&) {
    Made scene;
    setProblem(scene, Pair{});
    setComponents(scene, {{"u", "m"}}, {{"x", "N"}});
    completeStart(scene);
    change(scene);
    return scene;
  };
  return entry;
}

template <class Change>
std::function<void()> scene(Change change) {
  return [change] { (void)makeScene<double>(entryWith(change), {}); };
}

TEST(SceneMisuse, PartsThatDoNotFitAreRefused) {
  EXPECT_EQ(refusal(scene([](Made&) {})), "");
  expectRefusals({
      {"system", "scene pair makes no system", scene([](Made& s) { s.system = {}; })},
      {"null", "scene pair: no system to integrate",
       scene([](Made& s) { s.system = [](const SystemOptions&) { return nullptr; }; })},
      {"u", "scene pair: start: u: 2 numbers, 1", scene([](Made& s) { s.start.u.setZero(2); })},
      {"no start", "scene pair: start: u: 0 numbers, 1", scene([](Made& s) { s.start = State<double>(); })},
      {"x, unnamed", "scene pair: start: x: 0 numbers, 1", scene([](Made& s) { s.names = {}, s.start.x.resize(0); })},
      {"w", "scene pair: start: w = (a, k, z): 0 numbers, 2",
       scene([](Made& s) { s.names = {}, s.start.w.resize(0); })},
      {"d", "start: discrete state d: 1 numbers, 0", scene([](Made& s) { s.start.d.setZero(1); })},
      {"carry", "start: carry: 1 numbers, 3", scene([](Made& s) { s.start.carry.setZero(1); })},
      {"t", "start: t = nan", scene([](Made& s) { s.start.t = kNoNumber; })},
      {"end", "t_end = nan: a finite number", scene([](Made& s) { s.t_end = kNoNumber; })},
      {"an end before the start", "t_end = -1 lies before the start, t = 0", scene([](Made& s) { s.t_end = -1; })},
      {"scale", "scale: 2 numbers, 3 are expected", scene([](Made& s) { s.scale.setOnes(2); })},
      {"a scale", "the typical magnitude of u is 0", scene([](Made& s) { s.scale[0] = 0; })},
      {"a negative scale", "scene pair: the typical magnitude of u is -1", scene([](Made& s) { s.scale[0] = -1; })},
      {"no scale", "scene pair: the typical magnitude of u is nan", scene([](Made& s) { s.scale[0] = kNoNumber; })},
      {"a scale, unnamed", "scale[1] = nan", scene([](Made& s) { s.names = {}, s.scale[1] = kNoNumber; })},
      {"units", "scene pair: 1 units, but it has 3 components", scene([](Made& s) { s.units = {"m"}; })},
      {"one name", "scene pair names 1 components, but it has 3", scene([](Made& s) { s.names = {"u"}; })},
      {"names", "two components are called 'u'", scene([](Made& s) { s.names[2] = "u"; })},
      {"no name", "component 1 is called ''", scene([](Made& s) { s.names[1] = ""; })},
      {"a name", "component 1 is called 'a b'", scene([](Made& s) { s.names[1] = "a b"; })},
      {"exact", "scene pair: exact: u: 0 numbers, 1",
       scene([](Made& s) { s.exact = [](const double&) { return State<double>(); }; })},
      {"output", "scene pair: its output 'energy' has no function", scene([](Made& s) {
         s.outputs = {{"energy", {}}};
       })},
      {"start too early", "its start cannot be completed before setProblem",
       scene([](Made& s) { s.system = {}, completeStart(s); })},
      {"an unknown component", "unknown component of u and v 'y'", scene([](Made& s) { completeStart(s, {"y"}); })},
      {"a start of another size", "start: u: 3 numbers, 1",
       scene([](Made& s) { s.start.u.setZero(3), completeStart(s); })},
      {"a parameter", "it asks for the parameter 'k'", scene([](Made&) { (void)number<double>({}, "k"); })},
      {"no number", "parameter k = 'x' is not a number", scene([](Made&) {
         (void)number<double>({{"k", "x"}}, "k");
       })},
  });
}

// Registers nothing: each entry is refused.
template <class Change>
std::function<void()> registered(Change change) {
  return [change] {
    SceneEntry entry = entryWith([](Made&) {});
    change(entry);
    registerScene(entry);
  };
}

// A scene of the catalogue with one setting.
std::function<void()> with(const char* id, const char* name, const char* value) {
  return [=] { (void)makeScene<double>(id, {{name, value}}); };
}

TEST(SceneMisuse, EntriesAndSettingsAreChecked) {
  using E = SceneEntry;
  expectRefusals({
      {"no id", "scene id ''", registered([](E& e) { e.id = ""; })},
      {"an id", "scene id 'My pair'", registered([](E& e) { e.id = "My pair"; })},
      {"a taken id", "scene id 'kepler'", registered([](E& e) { e.id = "kepler"; })},
      {"a collection", "collection 'a/b'", registered([](E& e) { e.collections = {"a/b"}; })},
      {"no range", "range [nan, 1]",
       registered([](E& e) { e.parameters = {numberParameter("k", "", "", "1", kNoNumber, 1)}; })},
      {"a range", "range [2, 1]", registered([](E& e) { e.parameters = {numberParameter("k", "", "", "1", 2, 1)}; })},
      {"a default", "the default 5 of the parameter k",
       registered([](E& e) { e.parameters = {numberParameter("k", "", "", "5", 0, 1)}; })},
      {"two of one name", "two parameters are called 'k'",
       registered([](E& e) { e.parameters.assign(2, numberParameter("k", "", "", "1", 0, 1)); })},
      {"words", "parameter w has no words", [] { (void)wordParameter("w", "", {}); }},
      {"descriptions", "parameter w has no words", [] { (void)descriptionParameter("w", "", {}); }},
      {"no scalar", "scalar = 'mp50': scene pair offers double",
       [] { (void)makeScene<BigFloat>(entryWith([](Made&) {}), {}); }},
      {"no scalar at all", "scalar = 'double': scene pair offers none",
       [] {
         SceneEntry entry = entryWith([](Made&) {});
         entry.make = {};
         (void)makeScene<double>(entry, {});
       }},
      {"no parameters", "scene pair has no parameters, not 'k'",
       [] {
         (void)makeScene<double>(entryWith([](Made&) {}), {{"k", "1"}});
       }},
      {"a parameter", "scene slider_crank: unknown parameter 'coordinate'; did you mean 'coordinates'?",
       with("slider_crank", "coordinate", "minimal")},
      {"a word", "unknown value of parameter reference 'smoth'; did you mean 'smooth'?",
       with("hydraulic_arm", "reference", "smoth")},
      {"a number", "scene kepler: parameter e = '1.5' must be a number in [0, 0.99]", with("kepler", "e", "1.5")},
      {"in 50 digits", "parameter e = '1.5' must be a number in [0, 0.99]",
       [] {
         (void)makeScene<BigFloat>("kepler", {{"e", "1.5"}});
       }},
      {"an empty number", "parameter k = '' must be a number", with("stick_slip", "k", "")},
      {"a word for a number", "parameter k = 'one' must be a number", with("stick_slip", "k", "one")},
      {"a number and more", "parameter k = '1x' must be a number", with("stick_slip", "k", "1x")},
      {"not a number", "parameter k = 'nan' must be a number", with("stick_slip", "k", "nan")},
      {"an infinite number", "parameter k = 'inf' must be a number", with("stick_slip", "k", "inf")},
      {"a part of an element", "elements = '2.5' must be a whole number", with("ancf_pendulum", "elements", "2.5")},
      {"sizes that no memory holds", "nu = 2000000000: 0 to 10000000", [] { requireSizes({.nu = 2'000'000'000}, {}); }},
      {"a scene", "unknown scene 'keplr'; did you mean 'kepler'?", [] { (void)makeScene<double>("keplr"); }},
      {"no scene", "unknown scene ''", [] { (void)findScene(""); }},
      {"references", "unknown scene 'keplr'", [] { (void)references("keplr"); }},
      {"settings of references", "did you mean 'e'?",
       [] {
         (void)references("kepler", {{"ee", "0"}});
       }},
      {"collection", "unknown collection 'ipv'; did you mean 'ivp'?", [] { (void)scenesOf("ipv"); }},
  });
}

}  // namespace
}  // namespace irk::test
