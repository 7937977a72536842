#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tests/core/ensemble/problems.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

constexpr double kLaneTolerance = 1e-6;

std::vector<double> spread(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first * std::pow(last / first, i / (count - 1.0)));
  return values;
}

template <template <class> class P>
std::vector<Solution<double>> lanesOf(const Members<P>& members, const std::string& method,
                                      const IntegratorOptions& options = lanesAt(kLaneTolerance)) {
  return inLanes(members.ensemble(), inOrder(members.parameters.size()), method, options);
}

Vec<double> allOf(const State<double>& s) {
  Vec<double> all(2 * s.u.size() + s.x.size() + s.w.size());
  all << s.u, s.v, s.x, s.w;
  return all;
}

// The largest difference of the components, in tolerances.
double differenceOf(const State<double>& a, const State<double>& b, double tolerance) {
  const Vec<double> x = allOf(a), y = allOf(b);
  return ((x - y).array().abs() / (tolerance * (1 + y.array().abs()))).maxCoeff();
}

std::vector<std::int64_t> countsOf(const Counters& counters) {
  std::vector<std::int64_t> counts;
  counters.forEach([&](const char*, std::int64_t count) { counts.push_back(count); });
  return counts;
}

// The criterion of "equal but for rounding": the same outcomes; this share of the runs takes the same steps,
// iterations, Jacobians and factorizations, and differ by less than `rounding` of a tolerance; where rounding has
// changed a decision the results differ by less than ten tolerances.
template <template <class> class P>
void expectSingleRuns(const Members<P>& members, const std::string& method,
                      const IntegratorOptions& options = lanesAt(kLaneTolerance), double rounding = 0.01,
                      double share = 0.9) {
  const auto lanes = lanesOf(members, method, options);
  std::size_t same = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    SCOPED_TRACE(method + ", parameter " + std::to_string(members.parameters[i]));
    const EnsembleMember member = members.member(i);
    Integrator<double> integrator(member.system, makeTableau<double>(method), options, member.scale);
    const auto single = integrator.integrate(member.start, member.t_end);
    ASSERT_EQ(name(lanes[i].outcome), name(single.outcome)) << lanes[i].detail;
    ASSERT_EQ(single.outcome, Outcome::kSuccess);
    EXPECT_EQ(lanes[i].state.t, single.state.t);
    const bool equal = countsOf(lanes[i].counters) == countsOf(single.counters);
    same += equal;
    EXPECT_LT(differenceOf(lanes[i].state, single.state, kLaneTolerance), equal ? rounding : 10);
  }
  EXPECT_GE(static_cast<double>(same), share * static_cast<double>(lanes.size())) << method;
}

TEST(LaneIntegrator, EqualsSingleRunsOnAForcedOscillator) {
  const Members<ForcedOscillator> members{spread(0.5, 300, 21), 5}, brief{spread(0.5, 300, 21), 0.2};
  for (const auto* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "lobatto_iiic_3"}) {
    expectSingleRuns(members, method, lanesAt(kLaneTolerance));
  }
  expectSingleRuns(brief, "radau_iia_1", lanesAt(1e-3));
}

TEST(LaneIntegrator, EqualsSingleRunsOnAConstrainedMechanism) {
  for (const Formulation formulation : {Formulation::kIndex1, Formulation::kIndex2, Formulation::kIndex3}) {
    // Index 3 divides the round-off of positions by h^2, so that it changes more decisions: 8 % of the runs without
    // vector instructions.
    const bool is_index3 = formulation == Formulation::kIndex3;
    expectSingleRuns(Members<LongPendulum>{spread(0.5, 2, 95), 2, formulation}, "radau_iia_3", lanesAt(kLaneTolerance),
                     is_index3 ? 0.1 : 0.01, is_index3 ? 0.8 : 0.9);
  }
}

// Where old Jacobians let Newton's method converge slowly, rounding soon changes decisions: a mild problem.
TEST(LaneIntegrator, EqualsSingleRunsWithOtherControl) {
  IntegratorOptions options = lanesAt(kLaneTolerance);
  options.step.control = StepControl::kPaper;
  options.newton.keep_jacobian_below = 0.1;
  options.step.h_max = 0.05;
  expectSingleRuns(Members<ForcedOscillator>{spread(0.5, 10, 11), 5}, "radau_iia_3", options);
}

void expectSameBits(const std::vector<Solution<double>>& a, const std::vector<Solution<double>>& b, std::size_t i) {
  EXPECT_EQ(a[i].outcome, b[i].outcome) << i;
  EXPECT_EQ(allOf(a[i].state), allOf(b[i].state)) << i;
  EXPECT_EQ(countsOf(a[i].counters), countsOf(b[i].counters)) << i;
}

TEST(LaneIntegrator, GivesAMemberTheSameBitsBesideAnyOthers) {
  const Members<ForcedOscillator> members{spread(0.5, 300, 21), 5};
  const auto lanes = lanesOf(members, "radau_iia_3");
  auto order = inOrder(members.parameters.size());
  std::reverse(order.begin(), order.end());
  std::rotate(order.begin(), order.begin() + 5, order.end());
  const auto others = inLanes(members.ensemble(), order, "radau_iia_3", lanesAt(kLaneTolerance));
  for (std::size_t i = 0; i < lanes.size(); ++i) expectSameBits(lanes, others, i);
  for (const std::size_t alone : {std::size_t(0), std::size_t(7), std::size_t(20)}) {
    const Members<ForcedOscillator> one{{members.parameters[alone]}, 5};
    const auto result = lanesOf(one, "radau_iia_3");
    EXPECT_EQ(allOf(result.front().state), allOf(lanes[alone].state)) << alone;
  }
}

TEST(LaneIntegrator, FailsInTheLanesThatFailAlone) {
  const std::vector<double> good = spread(0.1, 0.9, 12);
  const auto expected = lanesOf(Members<Blowup>{good, 1}, "radau_iia_3");
  std::vector<double> some = good;
  some[3] = 2;  // infinite at t = 0.5
  some[8] = std::numeric_limits<double>::quiet_NaN();
  some[9] = std::numeric_limits<double>::infinity();
  const auto lanes = lanesOf(Members<Blowup>{some, 1}, "radau_iia_3");
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (some[i] == good[i]) {
      EXPECT_EQ(lanes[i].outcome, Outcome::kSuccess);
      EXPECT_NEAR(lanes[i].state.x[0], 1 / (1 - good[i]), 1e-4 / (1 - good[i]));
      expectSameBits(lanes, expected, i);
    } else {
      EXPECT_NE(lanes[i].outcome, Outcome::kSuccess) << some[i];
      EXPECT_FALSE(lanes[i].detail.empty());
    }
  }
  EXPECT_NEAR(lanes[3].state.t, 0.5, 1e-3);
  EXPECT_EQ(lanes[8].outcome, Outcome::kNotFinite) << lanes[8].detail;
  EXPECT_EQ(lanes[8].state.t, 0);
}

TEST(LaneIntegrator, EndsRunsAtTheLimitOfSteps) {
  IntegratorOptions options = lanesAt(kLaneTolerance);
  options.step.max_steps = 150;
  const Members<ForcedOscillator> members{spread(0.5, 300, 10), 5};
  const auto lanes = lanesOf(members, "radau_iia_3", options);
  std::size_t successes = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const EnsembleMember member = members.member(i);
    Integrator<double> integrator(member.system, makeTableau<double>("radau_iia_3"), options);
    EXPECT_EQ(name(lanes[i].outcome), name(integrator.integrate(member.start, member.t_end).outcome)) << i;
    successes += lanes[i].outcome == Outcome::kSuccess;
  }
  EXPECT_GT(successes, 0U);
  EXPECT_LT(successes, lanes.size());
}

TEST(LaneIntegrator, RefusesAnInconsistentStartAsARow) {
  Members<LongPendulum> members{{1, 1.5}, 1};
  Ensemble ensemble = members.ensemble();
  ensemble.member = [&members](std::size_t i) {
    EnsembleMember member = members.member(i);
    if (i == 1) member.start.u[0] = 1.6;
    return member;
  };
  const auto lanes = inLanes(ensemble, inOrder(2), "radau_iia_3", lanesAt(kLaneTolerance));
  EXPECT_EQ(lanes[0].outcome, Outcome::kSuccess);
  EXPECT_EQ(lanes[1].outcome, Outcome::kInconsistentStart);
  EXPECT_NE(lanes[1].detail.find("constraint"), std::string::npos) << lanes[1].detail;
}

TEST(LaneIntegrator, JudgesAStartRelativeToTheScale) {
  Members<LongPendulum> members{{1, 1.5}, 1};
  Ensemble ensemble = members.ensemble();
  ensemble.member = [&members](std::size_t i) {
    EnsembleMember member = members.member(i);
    member.start.v.setConstant(1e-5);
    member.scale = Vec<double>::Ones(5);
    if (i == 1) member.scale.segment(2, 2).setConstant(1e3);
    return member;
  };
  const auto lanes = inLanes(ensemble, inOrder(2), "radau_iia_3", lanesAt(1e-3));
  EXPECT_EQ(lanes[0].outcome, Outcome::kInconsistentStart);
  EXPECT_EQ(lanes[1].outcome, Outcome::kSuccess) << lanes[1].detail;
}

TEST(LaneIntegrator, StopsOnRequest) {
  const Members<ForcedOscillator> members{spread(0.5, 300, 20), 5};
  LaneIntegrator integrator(makeTableau<double>("radau_iia_3"), lanesAt(kLaneTolerance));
  std::size_t next = 0, steps = 0, interrupted = 0;
  integrator.integrate(
      members.ensemble(), [&] { return next < 20 ? std::optional(next++) : std::nullopt; },
      [&](std::size_t, const Solution<double>& s) { interrupted += s.outcome == Outcome::kInterrupted; },
      [&] { return ++steps > 10 ? Outcome::kInterrupted : Outcome::kSuccess; });
  EXPECT_EQ(interrupted, kLanes);
  EXPECT_EQ(next, kLanes);
}

// With steps of at most h, and a tolerance that allows them all.
double errorAt(const std::string& method, double h) {
  IntegratorOptions options = lanesAt(0.1);
  options.newton.kappa = 1e-11;
  options.step.h = options.step.h_max = h;
  const auto lanes = lanesOf(Members<Tracking>{{1, 2, 0.5}, 1}, method, options);
  double worst = 0;
  for (const auto& solution : lanes) {
    EXPECT_EQ(solution.counters.steps_accepted, std::lround(1 / h)) << method;
    worst = std::max(worst, std::abs(solution.state.x[0] - std::sin(1.0)));
  }
  return worst;
}

TEST(LaneIntegrator, HasTheOrderOfItsMethod) {
  const std::pair<const char*, double> orders[] = {
      {"radau_iia_1", 1}, {"radau_iia_2", 3}, {"radau_iia_3", 5}, {"lobatto_iiic_3", 4}};
  for (const auto& [method, order] : orders) {
    const std::vector<double> h{0.25, 0.125, 0.0625};
    std::vector<double> errors;
    for (const double step : h) errors.push_back(errorAt(method, step));
    EXPECT_NEAR(slope(h, errors), order, 0.35) << method;
  }
}

template <class F>
std::string misuseOf(F&& f) {
  try {
    f();
  } catch (const Misuse& misuse) {
    return misuse.what();
  }
  return "";
}

TEST(LaneIntegrator, RefusesOtherStrategies) {
  const auto with = [](auto change) {
    IntegratorOptions options = laneOptions({});
    change(options);
    return misuseOf([&] { LaneIntegrator(makeTableau<double>("radau_iia_3"), options); });
  };
  EXPECT_EQ(with([](IntegratorOptions&) {}), "");
  EXPECT_NE(with([](auto& o) { o.newton.kind = NewtonKind::kBroyden; }).find("newton 'broyden'"), std::string::npos);
  EXPECT_NE(with([](auto& o) { o.step.estimate = ErrorEstimate::kRichardson; }).find("'richardson'"),
            std::string::npos);
  EXPECT_NE(with([](auto& o) { o.step.control = StepControl::kFixed; }).find("fixed"), std::string::npos);
  EXPECT_NE(with([](auto& o) { o.tolerances.rtol = -1; }), "");
  for (const auto* method : {"gauss_3", "lobatto_iiia_3", "radau_ia_3"}) {
    EXPECT_NE(misuseOf([&] { LaneIntegrator(makeTableau<double>(method), laneOptions({})); }).find(method),
              std::string::npos);
  }
}

/// A ball that bounces: a system with a switch.
struct Bouncing {
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - 9.81 - p.d[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = T(-p.u[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1.0 - p.d[0];
  }
};

TEST(LaneIntegrator, RefusesSystems) {
  const Members<LongPendulum> members{{1, 1.5}, 1};
  const auto with = [&](const std::shared_ptr<const System<double>>& system) {
    Ensemble ensemble = members.ensemble();
    ensemble.member = [&](std::size_t i) {
      EnsembleMember member = members.member(i);
      if (i == 1) member = {system, State<double>(system->sceneSizes()), 1};
      return member;
    };
    return misuseOf([&] { inLanes(ensemble, inOrder(2), "radau_iia_3", lanesAt(kLaneTolerance)); });
  };
  EXPECT_NE(with(makeSystem<double>(Bouncing{})).find("switches"), std::string::npos);
  EXPECT_NE(with(makeSystem<double>(LongPendulum<double>{1}, {Formulation::kGgl})).find("ggl"), std::string::npos);
  EXPECT_NE(with(makeSystem<double>(LongPendulum<double>{1}, {Formulation::kIndex2Projected})).find("projected"),
            std::string::npos);
  EXPECT_NE(with(makeSystem<double>(Tracking<double>{1})).find("sizes"), std::string::npos);
}

}  // namespace
}  // namespace irk::test
