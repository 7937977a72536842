// Scenes in shared libraries: irk/scene_c.h.
#include <array>
#include <cmath>
#include <filesystem>

#include "experiments/own/files.h"
#include "experiments/runs/setup.h"
#include "tests/experiments/own/own_files.h"
#include "tests/refusal.h"

namespace irk {
namespace {

const std::string kScenes = IRK_SCENES "/";

Vec<double> valuesAtEnd(const State<double>& s) {
  Vec<double> all(s.u.size() + s.v.size() + s.x.size() + s.z().size());
  all << s.u, s.v, s.x, s.z();
  return all;
}

// The same equations in C++ and in C, whatever derivatives the library gives.
TEST(ForeignScene, ARunEqualsThatOfTheSceneInCpp) {
  const auto solutionOf = [](const std::string& scene) {
    RunSpec spec = radauSpec(scene);
    spec.t_end = 20;
    return integrated(makeSetup<double>(spec));
  };
  const auto reference = solutionOf("kepler");
  for (const char* derivatives : {"differences", "full", "entries", "products"}) {
    const auto made = solutionOf(own::loadFile(kScenes + "bodies_" + derivatives + ".so"));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << derivatives;
    EXPECT_LE((valuesAtEnd(made.state) - valuesAtEnd(reference.state)).cwiseAbs().maxCoeff(), 1e-6) << derivatives;
    const auto& counted = made.counters;
    const auto& known = reference.counters;
    EXPECT_LE(static_cast<double>(counted.residuals), 1.3 * static_cast<double>(known.residuals)) << derivatives;
  }
}

// Derivatives with all columns, for each kind: those of the scene in C++.
TEST(ForeignScene, DerivativesAreThoseOfTheSceneInCpp) {
  const auto own = makeScene<double>("kepler");
  const auto known = own.system({});
  for (const char* derivatives : {"differences", "full", "entries", "products"}) {
    const auto scene = makeScene<double>(own::loadFile(kScenes + "bodies_" + derivatives + ".so"));
    const auto system = scene.system({});
    State<Dual<double>> at(system->sizes());
    for (Index i = 0; i < 2; ++i) {
      at.u[i] = 0.4 + 0.1 * static_cast<double>(i);
      at.u[i].d[static_cast<std::size_t>(i)] = 1;
      at.w[i].d[static_cast<std::size_t>(2 + i)] = 1;
      at.v[i].d[4] = 1;
    }
    Vec<Dual<double>> r(2), expected(2);
    system->evaluate(Level::kFormulated, pointOf(at), {r.data(), 2});
    at.d.resize(0);
    known->evaluate(Level::kFormulated, pointOf(at), {expected.data(), 2});
    for (Index i = 0; i < 2; ++i) {
      for (std::size_t c = 0; c < 5; ++c) {
        EXPECT_NEAR(r[i].d[c], expected[i].d[c], 1e-8 * 15) << derivatives << " row " << i << " direction " << c;
      }
    }
  }
}

TEST_F(OwnFiles, ADamagedSceneInALibraryIsALine) {
  const std::vector<std::array<std::string, 3>> cases{
      {"version", "differences", "irk_scene_version() = 7: this program has version 1"},
      {"long title", "differences", "irk_scene_title writes a text without a 0 at its end"},
      {"default", "differences", "the default 2 of the parameter e is not in [0, 0.99]"},
      {"refuses", "differences", "the table of e ends at 0.5"},
      {"size", "differences", "sizes: nu = -2: 0 to"},
      {"times", "differences", "times = 1, but there is no function irk_scene_times"},
      {"constraints", "differences", "constraints = 1, but the problem has no function constraints"},
      {"index", "differences", "algebraic_index = 3: 1 or 2 is allowed"},
      {"twice a name", "differences", "two components are called 'q1'"},
      {"scale", "differences", "the typical magnitude of q1 is -1: a number > 0 is expected"},
      {"end", "differences", "the end, t[1] = -1, lies before the start"},
      {"start", "differences", "irk_scene_start: y[0] is nan"},
      {"start behind", "differences", "irk_scene_start writes w[2], but w has 2 numbers"},
      {"row", "differences", "irk_scene_rates does not write f[1]"},
      {"row behind", "differences", "irk_scene_rates writes f[2], but f has 2 numbers"},
      {"row before", "differences", "irk_scene_rates writes f[-1], but f has 2 numbers"},
      {"argument", "differences", "irk_scene_rates changes y, w or d"},
      {"rows", "differences", "its start:"},
      {"slope", "full", "irk_scene_jacobian: row 0, column 1 is"},
      {"slope behind", "full", "irk_scene_jacobian writes J[8], but J has 8 numbers"},
      {"slope", "products", "irk_scene_product: row 0, column 1 is"},
      {"entry", "entries", "irk_scene_entries: entry 3 is at row 1, column 4: 0 to 1 and 0 to 3 are allowed"},
      {"entries", "entries", "irk_scene_entries returns 9 entries; the Jacobian has 2 rows and 4 columns"},
      {"switch behind", "differences", "irk_scene_on_switch writes d[1], but d has 1 numbers"}};
  for (const auto& [damage, library, text] : cases) {
    SCOPED_TRACE(damage);
    expectRefused(kScenes + "bodies_" + library + ".so", text, "IRK_DAMAGE='" + damage + "'");
  }
}

// x(3) = 2 (e^-1 + 1) e^-2 by hand: the state jumps at declared times, with every treatment of switches.
TEST(ForeignScene, TheStateJumpsAtDeclaredTimes) {
  for (const auto& treatment : {Discontinuity::kLocate, Discontinuity::kIgnore}) {
    RunSpec spec = radauSpec(own::loadFile(kScenes + "doses.so"));
    spec.t_end = 3;
    spec.discontinuity = treatment;
    const auto made = integrated(makeSetup<double>(spec));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
    EXPECT_NEAR(made.state.x[0], 2 * (std::exp(-1.0) + 1) * std::exp(-2.0), 1e-7);
  }
}

TEST_F(OwnFiles, AJumpAtATimeWritesTheStateOnly) {
  expectRefused(kScenes + "doses.so", "irk_scene_jump_at_time writes y[1], but y has 1 numbers", "IRK_DAMAGE=behind");
}

TEST_F(OwnFiles, WhatIsNoSceneIsRefused) {
  write("text.so", "no library");
  std::filesystem::copy(IRK_SOLVERS "/euler_ode.so", folder_.path() / "solver.so");
  expectRefused("missing.so", "missing.so");
  expectRefused("text.so", "text.so: it cannot be loaded");
  expectRefused("solver.so", "solver.so: it has no function 'irk_scene_version'");
}

// A function that fails during a run makes the step smaller; the run then ends as a failure.
TEST_F(OwnFiles, ASceneThatCannotBeEvaluatedEndsTheRun) {
  const Ran ran =
      irk("solve " + kScenes + "bodies_full.so --method radau_iia_3 --tol 1e-6 --error-bar none", "IRK_DAMAGE=fails");
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_NE(ran.text.find("bodies_full with radau_iia_3 failed: "), std::string::npos) << ran.text;
}

TEST_F(OwnFiles, ALibraryStandsWhereASceneMayStand) {
  std::filesystem::copy(kScenes + "contact_scene.so", folder_.path() / "my_contact.so");
  write("mine.toml",
        "title = 'Mine'\n[defaults]\nreference = 'auto'\n[[block]]\nscene = ['my_contact.so', 'bouncing_ball']\n"
        "methods = ['radau_iia_3', 'ida_bdf']\ntolerances = [1e-4, 1e-6]\n");
  const Ran study = irk("run mine.toml");
  EXPECT_EQ(study.status, 0) << study.text;
  EXPECT_NE(study.text.find("8 success"), std::string::npos) << study.text;
  const Ran solved = irk("solve my_contact.so --tol 1e-6 --method radau_iia_3 --set b=0 --json --reference");
  EXPECT_NE(solved.text.find("contact"), std::string::npos) << solved.text;
  EXPECT_NE(solved.text.find("in double: the scene has no 50-digit instance"), std::string::npos) << solved.text;
  EXPECT_EQ(irk("list scenes my_contact --load my_contact.so").status, 0);
  const Ran digits = irk("solve my_contact.so --tol 1e-6 --method radau_iia_3 --scalar mp50");
  EXPECT_EQ(digits.status, 2);
  EXPECT_NE(digits.text.find("scalar = 'mp50': scene my_contact offers double"), std::string::npos) << digits.text;
}

// g, dg/dt and d2g/dt2 of the example in Fortran are those of the pendulum of the suite.
TEST(ForeignScene, ConstraintsInFortran) {
  const std::string library = kScenes + "pendulum_scene.so";
  if (!std::filesystem::exists(library)) GTEST_SKIP() << "no compiler of Fortran";
  const auto id = own::loadFile(library);
  for (const auto formulation :
       {Formulation::kIndex3, Formulation::kIndex2, Formulation::kIndex2Projected, Formulation::kIndex1}) {
    auto spec = radauSpec(id);
    spec.t_end = 2;
    spec.options.tolerances.rtol = spec.options.tolerances.atol = 1e-10;  // index 1 drifts
    spec.formulation = formulation;
    const auto made = integrated(makeSetup<double>(spec));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
    EXPECT_NEAR(made.state.u[0], 0.7935661953, 1e-6);
    EXPECT_NEAR(made.state.z()[0], 17.90768206, 1e-4);
  }
  auto spec = radauSpec(id);
  spec.formulation = Formulation::kGgl;
  EXPECT_NE(refusal([&] { makeSetup<double>(spec); }).find("formulation 'ggl'"), std::string::npos);
}

}  // namespace
}  // namespace irk
