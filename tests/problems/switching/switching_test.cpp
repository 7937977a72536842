// The switches of the scenes are located at their known times.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/scene_run.h"

namespace irk::test {
namespace {

struct SwitchingTimes {
  SceneCase scene;
  double t_end;
  double accuracy;  ///< of the times: their known digits, or 10 to 100 times the tolerance
  std::vector<Event> events;
};

constexpr double kThird = 1.0 / 3;

const std::vector<SwitchingTimes>& switchingTimes() {  // NOLINT(readability-function-size): data
  static const std::vector<SwitchingTimes> all = {
      {{"stick_slip", {{"Fd", "1"}, {"Fs", "1"}, {"k", "100"}, {"v0", "0"}, {"vb", "0"}, {"x0", "0.105"}}},
       2,
       1e-9,
       {{"reaches the belt", 1 * M_PI / 10},
        {"reaches the belt", 2 * M_PI / 10},
        {"reaches the belt", 3 * M_PI / 10},
        {"reaches the belt", 4 * M_PI / 10},
        {"reaches the belt", 5 * M_PI / 10}}},
      {{"slider_crank", {{"torque_off_at", "0.5"}}}, 1, 1e-14, {{"torque off", 0.5}}},
      {{"hydraulic_arm", {}},
       2,
       1e-8,
       {{"lower kink", kThird},
        {"upper kink", 2 * kThird},
        {"upper kink", 4 * kThird},
        {"valve", 1.33334403},
        {"lower kink", 5 * kThird}}},
      {{"hydraulic_arm", {{"reference", "smooth"}}}, 2, 1e-9, {{"valve", 1.071073558}}},
      {{"hydraulic_manipulator", {}},
       10,
       1e-14,
       {{"corner of the manoeuvre", 2},
        {"corner of the manoeuvre", 2.001},
        {"corner of the manoeuvre", 6},
        {"corner of the manoeuvre", 6.002}}},
      {{"bouncing_mass", {}},
       0.5,
       1e-9,
       {{"contact", 0.009552424562},
        {"contact", 0.020883793704},
        {"contact", 0.243862241198},
        {"contact", 0.255193610340},
        {"contact", 0.478172057833},
        {"contact", 0.489503426975}}},
      {{"elastoplastic", {}},
       1.8,
       1e-9,
       {{"yield at +Fy", 0.2455545078765},
        {"unloading", 0.6532241157906},
        {"yield at -Fy", 0.8407775394022},
        {"unloading", 1.349391952658},
        {"yield at +Fy", 1.516436309997}}},
      {{"dc_motor_chopper", {}},
       0.02,
       1e-11,
       {{"chopper", 0.002337477488598},
        {"chopper", 0.007248769114225},
        {"chopper", 0.008261944369415},
        {"chopper", 0.012926368165110},
        {"chopper", 0.013950351119890},
        {"chopper", 0.018400178584800},
        {"chopper", 0.019434784066640}}},
      {{"mechatronic_crank", {}},
       1,
       1e-9,
       {{"chopper", 0.0387099434},
        {"chopper", 0.1216661750},
        {"chopper", 0.1461013554},
        {"chopper", 0.2166745301},
        {"chopper", 0.2357148006},
        {"slider turns", 0.3388771655},
        {"chopper", 0.4302845593},
        {"chopper", 0.4533902754189},
        {"slider turns", 0.6282695383},
        {"chopper", 0.6585582541978},
        {"chopper", 0.6879039114199},
        {"chopper", 0.7420839476298},
        {"chopper", 0.7649596460809},
        {"slider turns", 0.9702121288}}},
  };
  return all;
}

void expectEvents(const Result& r, const std::vector<Event>& known, double accuracy) {
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  EXPECT_EQ(r.events.size(), known.size());
  for (std::size_t i = 0; i < std::min(r.events.size(), known.size()); ++i) {
    EXPECT_EQ(r.events[i].name, known[i].name);
    EXPECT_NEAR(r.events[i].t, known[i].t, accuracy) << i;
  }
}

TEST(Switching, LocatesTheKnownTimes) {
  for (const SwitchingTimes& known : switchingTimes()) {
    SCOPED_TRACE(known.scene.name());
    expectEvents(run(known.scene, known.t_end, Discontinuity::kLocate), known.events, known.accuracy);
  }
}

// Three periods of the exact solution. An error e of x at the beginning of sticking moves the next slip by e / vb =
// 10 e. The times are therefore accurate to the tolerance if that error is much smaller, else to 10 times the error
// of x.
TEST(Switching, StickSlipKeepsItsPeriod) {
  const std::vector<Event> known = {
      {"slips back", 15},
      {"reaches the belt", 18.536383773289554},
      {"slips back", 28.536383773289554},
      {"reaches the belt", 32.07276754657911},
      {"slips back", 42.07276754657911},
      {"reaches the belt", 45.609151319868666},
  };
  const SceneCase belt{"stick_slip", {}};
  expectEvents(run(belt, 50, Discontinuity::kLocate, kTolerance, "radau_iia_10"), known, 1e-10);
  const double position = 10 * kTolerance * 1.5;  // errors of some steps in x, which is about 1.5
  expectEvents(run(belt, 50, Discontinuity::kLocate), known, position / 0.1);
}

// Samples are taken at fixed times, ten in a second.
TEST(Switching, SamplesAreTakenInTime) {
  const Result r = run({"sampled_control", {}}, 0.95, Discontinuity::kLocate);
  ASSERT_EQ(r.events.size(), 9U);
  for (std::size_t i = 0; i < r.events.size(); ++i) {
    EXPECT_NEAR(r.events[i].t, 0.1 * static_cast<double>(i + 1), 1e-15);
  }
  EXPECT_NEAR(r.solution.state.d[0], -1.443369897505, 1e-9);  // F_9
}

struct EndValue {
  SceneCase scene;
  double t;
  std::string component;
  double value, accuracy;
};

TEST(Switching, ReachesTheJudgedValues) {
  const std::vector<EndValue> values = {
      {{"bouncing_mass", {}}, 0.5, "gap", 0.010939776065215, 1e-9},
      {{"hydraulic_manipulator", {}}, 4, "s", 0.5391910846465, 1e-8},
      {{"hydraulic_manipulator", {}}, 6, "s", 0.5960370061673, 1e-8},
      {{"hydraulic_manipulator", {{"manoeuvre", "sine"}}}, 5, "s", 0.488486064339, 1e-8},
      {{"hydraulic_arm", {}}, 2, "angle", 0.0014252310, 1e-8},
      {{"hydraulic_arm", {}}, 2, "p0", 10133100.582, 10},
      {{"hydraulic_arm", {{"reference", "smooth"}}}, 2, "angle", 0.0156654070, 1e-8},
      {{"hydraulic_arm", {{"reference", "smooth"}}}, 2, "p0", 9805705.045, 10},
      {{"stick_slip_lugre", {}}, 25, "X", 1.908839199226, 1e-8},
      {{"slider_crank", {{"torque_off_at", "0.5"}}}, 1, "theta", 11.224771192754, 1e-9},
  };
  for (const EndValue& v : values) {
    SCOPED_TRACE(v.scene.name());
    const Result r = run(v.scene, v.t, Discontinuity::kLocate);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    const auto scene = makeScene<double>(v.scene.id, v.scene.settings);
    EXPECT_NEAR(valueOf(scene, v.component, r.solution.state), v.value, v.accuracy);
  }
}

// Immediately after a switch no other one is due: switches without memory do not chatter.
TEST(Switching, NoneIsDueAfterASwitch) {
  for (const SwitchingTimes& known : switchingTimes()) {
    SCOPED_TRACE(known.scene.name());
    const auto scene = makeScene<double>(known.scene.id, known.scene.settings);
    const auto system = scene.system({});
    IntegratorOptions options;
    options.tolerances.rtol = options.tolerances.atol = kTolerance;
    Integrator<double> integrator(scene.system({.discontinuity = Discontinuity::kLocate}),
                                  makeTableau<double>("radau_iia_5"), options, scene.scale);
    Monitor<double> monitor;
    monitor.switched = [&](const SwitchRecord<double>& s) {
      Vec<double> g(scene.sizes().switches);
      system->switching(pointOf(s.state), VecView<double>(g.data(), g.size()));
      EXPECT_LE(g.maxCoeff(), 0) << s.name << " at " << s.t;
    };
    EXPECT_EQ(integrator.integrate(scene.start, known.t_end, monitor).outcome, Outcome::kSuccess);
  }
}

}  // namespace
}  // namespace irk::test
