// Ensembles that cannot be integrated: missing functions, null, members that do not fit each other.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/core/ensemble/problems.h"
#include "tests/misuse_table.h"

namespace irk::test {
namespace {

using Member = EnsembleMember;

const Members<LongPendulum> kPendulums{{0.5, 1, 2}, 0.2};
const Members<Blowup> kOthers{{1, 1, 1}, 1};

// Runs three pendulums of an ensemble that `change` has changed.
template <class Change>
std::function<void()> pendulums(Change change) {
  return [change] {
    Ensemble ensemble = kPendulums.ensemble();
    change(ensemble);
    (void)inLanes(ensemble, inOrder(3), "radau_iia_3", lanesAt(1e-4));
  };
}
// The same, where `change` changes the second member.
template <class Change>
std::function<void()> second(Change change) {
  return pendulums([change](Ensemble& e) {
    e.member = [change](std::size_t i) {
      Member member = kPendulums.member(i);
      if (i == 1) change(member);
      return member;
    };
  });
}

// Another system and its start at rest.
template <class P>
void exchange(Member& member, const P& problem, const SystemOptions& options = {}) {
  member.system = makeSystem<double>(problem, options);
  member.start = State<double>(member.system->sceneSizes());
}

std::shared_ptr<const System<Lanes>> lanesOfPendulum(Formulation formulation) {
  return std::make_shared<const ProblemSystem<LongPendulum<Lanes>, Lanes>>(LongPendulum<Lanes>{},
                                                                           SystemOptions{formulation});
}

TEST(LaneMisuse, EnsemblesAreChecked) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using Form = Formulation;
  EXPECT_EQ(refusal(pendulums([](Ensemble&) {})), "");
  expectRefusals({
      {"no member", "each of the functions `member`, `lanes`", pendulums([](Ensemble& e) { e.member = {}; })},
      {"no lanes", "each of the functions `member`, `lanes`", pendulums([](Ensemble& e) { e.lanes = {}; })},
      {"null", "null from its function `lanes`",
       pendulums([](Ensemble& e) { e.lanes = [](auto&) { return nullptr; }; })},
      {"other equations",
       "systems of different sizes: nu, nx, nz, constraints = 0, 1, 0, 0 after nu, nx, nz, constraints = 2, 0, 1, 1",
       pendulums([](Ensemble& e) { e.lanes = kOthers.ensemble().lanes; })},
      {"another formulation", "systems of different formulations",
       pendulums([](Ensemble& e) { e.lanes = [](auto&) { return lanesOfPendulum(Form::kIndex3); }; })},
      {"no system", "no system to integrate", second([](Member& m) { m.system = nullptr; })},
      {"another system", "systems of different sizes", second([](Member& m) { exchange(m, Riccati{}); })},
      {"index 3", "different formulations",
       second([](Member& m) { exchange(m, CartesianPendulum{}, {.formulation = Form::kIndex3}); })},
      {"ggl", "formulation 'ggl'",
       second([](Member& m) { exchange(m, CartesianPendulum{}, {.formulation = Form::kGgl}); })},
      {"projected", "formulation 'index2_projected'",
       second([](Member& m) { exchange(m, CartesianPendulum{}, {.formulation = Form::kIndex2Projected}); })},
      {"scale", "scale: 2 numbers, 5 are expected", second([](Member& m) { m.scale.setOnes(2); })},
      {"a scale", "scale[4] = nan", second([](Member& m) { m.scale = Vec<double>::Ones(5), m.scale[4] = kNan; })},
      {"start", "start: u: 0 numbers, 2 are expected", second([](Member& m) { m.start = State<double>(); })},
      {"start of v", "start: v: 3 numbers, 2 are expected", second([](Member& m) { m.start.v.setZero(3); })},
      {"end", "t_end = nan: a finite number", second([](Member& m) { m.t_end = kNan; })},
      {"an end before the start", "t_end = -1 lies before the start", second([](Member& m) { m.t_end = -1; })},
  });
}

TEST(LaneMisuse, TheFunctionsOfACallAreNeeded) {
  const Ensemble ensemble = kPendulums.ensemble();
  LaneIntegrator integrator(makeTableau<double>("radau_iia_3"), lanesAt(1e-4));
  const auto none = [] { return std::optional<std::size_t>(); };
  const auto ignore = [](std::size_t, const Solution<double>&) {};
  expectRefusals({
      {"next", "`next` and `done` is needed", [&] { integrator.integrate(ensemble, {}, ignore); }},
      {"done", "`next` and `done` is needed", [&] { integrator.integrate(ensemble, none, {}); }},
  });
  auto other = std::move(integrator);
  EXPECT_EQ(refusal([&] { other.integrate(ensemble, none, ignore); }), "");
  // NOLINTNEXTLINE(bugprone-use-after-move): that is the test
  EXPECT_EQ(refusal([&] { integrator.integrate(ensemble, none, ignore); }),
            "LaneIntegrator::integrate: the object has been moved from");
}

/// One integrator with an ensemble whose functions call `back`.
struct Calling {
  std::function<void()> back = [] {};
  LaneIntegrator integrator{makeTableau<double>("radau_iia_3"), lanesAt(1e-4)};
  Ensemble ensemble = kPendulums.ensemble();
  std::size_t successes = 0;

  void run() {
    std::size_t next = 0;
    successes = 0;
    integrator.integrate(
        ensemble, [&] { return next < 3 ? std::optional(next++) : std::nullopt; },
        [&](std::size_t, const Solution<double>& s) { successes += s.outcome == Outcome::kSuccess, back(); },
        [&] { return Outcome::kSuccess; });
  }
};

TEST(LaneMisuse, ACallFromACallbackIsRefusedAndTheNextOneWorks) {
  Calling calling;
  calling.back = [&] { calling.run(); };
  EXPECT_NE(refusal([&] { calling.run(); }).find("LaneIntegrator::integrate is called while another call"),
            std::string::npos);
  calling.back = [] { throw std::runtime_error("done"); };
  EXPECT_THROW(calling.run(), std::runtime_error);
  calling.back = [] {};
  calling.run();
  EXPECT_EQ(calling.successes, 3U);
}

}  // namespace
}  // namespace irk::test
