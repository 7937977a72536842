// The scenes' switches: located where they are known to be, and the four ways to treat them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/integrator.h"
#include "tableaus/catalogue.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

constexpr double kTolerance = 1e-10;

struct Event {
  std::string name;
  double t;
};

struct Run {
  Solution<double> solution;
  std::vector<Event> events;
};

Run run(const SceneCase& c, double t_end, Discontinuity mode, double tolerance = kTolerance) {
  static const Tableau<double> tableau = makeTableau<double>("radau_iia_5");
  const auto scene = makeScene<double>(c.id, c.settings);
  IntegratorOptions options;
  options.tolerances.rtol = options.tolerances.atol = tolerance;
  Integrator<double> integrator(scene.system({.discontinuity = mode}), tableau, options,
                                scene.scale);
  Run r;
  Monitor<double> monitor;
  monitor.switched = [&](const SwitchRecord<double>& s) { r.events.push_back({s.name, s.t}); };
  r.solution = integrator.integrate(scene.start, t_end, monitor);
  return r;
}

struct SwitchingTimes {
  SceneCase scene;
  double t_end;
  double accuracy;  ///< of the times: their digits, or the integration where they have more
  std::vector<Event> events;
};

// Over three periods of stick_slip's exact solution; else the independently computed times.
std::vector<SwitchingTimes> switchingTimes() {
  const double third = 1.0 / 3;
  return {
      {{"stick_slip", {}},
       50,
       1e-10,
       {{"slips back", 15},
        {"reaches the belt", 18.536383773289554},
        {"slips back", 28.536383773289554},
        {"reaches the belt", 32.07276754657911},
        {"slips back", 42.07276754657911},
        {"reaches the belt", 45.609151319868666}}},
      {{"stick_slip",
        {{"Fd", "1"}, {"Fs", "1"}, {"k", "100"}, {"v0", "0"}, {"vb", "0"}, {"x0", "0.105"}}},
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
       {{"lower kink", third},
        {"upper kink", 2 * third},
        {"valve", 1.33334403},
        {"upper kink", 4 * third},
        {"lower kink", 5 * third}}},
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
       0.5,
       1e-9,
       {{"chopper", 0.0387099434},
        {"chopper", 0.1216661750},
        {"chopper", 0.1461013554},
        {"chopper", 0.2166745301},
        {"chopper", 0.2357148006},
        {"slider turns", 0.3388771655},
        {"chopper", 0.4302845593}}},
  };
}

TEST(Switching, LocatesTheKnownTimes) {
  for (const SwitchingTimes& known : switchingTimes()) {
    SCOPED_TRACE(known.scene.name());
    const Run r = run(known.scene, known.t_end, Discontinuity::kLocate);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    for (std::size_t i = 0; i < std::min(r.events.size(), known.events.size()); ++i) {
      EXPECT_EQ(r.events[i].name, known.events[i].name);
      EXPECT_NEAR(r.events[i].t, known.events[i].t, known.accuracy) << i;
    }
    EXPECT_EQ(r.events.size(), known.events.size());
  }
}

}  // namespace
}  // namespace irk::test
