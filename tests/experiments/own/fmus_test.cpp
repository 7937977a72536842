// FMUs as scenes. Their models are those of tests/fmus.
#if defined(IRK_FMUS)
#include <cmath>
#include <filesystem>

#include "experiments/runs/run.h"
#include "irk/scene_file.h"
#include "tests/experiments/own/fmu_files.h"
#include "tests/experiments/reference/own_cache.h"

namespace irk {
namespace {

// The models of tests/fmus in C++.
template <class Real>
struct PendulumTwin {
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -9.81 * sin(p.u[0]) - 0.1 * p.v[0] - p.a[0];
  }
  void start(State<Real>& s) const { s.u[0] = Real(1); }
  SceneFrame<Real> frame() const { return {.t_end = 5}; }
};

template <class Real>
struct BallTwin {
  Sizes sizes() const { return {.nu = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -9.81 - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = -p.u[0];
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T*) const {}
  template <class T>
  void jump(Index, const Point<T>& p, T* u, T* v, T*) const {
    u[0] = T(0.0);
    v[0] = -0.7 * p.v[0];
  }
  void start(State<Real>& s) const { s.u[0] = Real(1); }
  SceneFrame<Real> frame() const { return {.t_end = 2}; }
};

template <class Problem>
Solution<double> ofTwin(double tolerance = 1e-8) {
  return integrated(setUp(radauSpec("", tolerance), framedScene<double>(Problem{})));
}

double evaluations(const Solution<double>& s) {
  return static_cast<double>(s.counters.residuals + s.counters.dual_residuals);
}

template <class Problem>
void expectLikeTwin(const std::string& name) {
  const auto twin = ofTwin<Problem>();
  ASSERT_EQ(twin.outcome, Outcome::kSuccess);
  for (const int version : {2, 3}) {
    const auto made = ofFmu(fmu(name, version));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
    ASSERT_EQ(made.state.u.size(), 1) << "the state that is a derivative has not been found";
    EXPECT_NEAR(made.state.u[0], twin.state.u[0], 1e-7) << version;
    EXPECT_NEAR(made.state.v[0], twin.state.v[0], 1e-6) << version;
    EXPECT_LE(evaluations(made), 1.3 * evaluations(twin)) << version;
  }
}

class Fmu : public WithOwnCache {};

TEST_F(Fmu, APendulumIsThatInCpp) { expectLikeTwin<PendulumTwin<double>>("pendulum"); }
TEST_F(Fmu, ABallThatJumpsIsThatInCpp) { expectLikeTwin<BallTwin<double>>("ball"); }

// An event of an FMU is that of its indicator's change of sign; the state after it is the FMU's.
TEST_F(Fmu, StickAndSlipInBothVersions) {
  const auto second = ofFmu(fmu("stick_slip", 2)), third = ofFmu(fmu("stick_slip", 3));
  ASSERT_EQ(second.outcome, Outcome::kSuccess) << second.detail;
  EXPECT_GE(second.counters.switches, 6);  // sticks and slips three times
  EXPECT_EQ(second.counters.switches, third.counters.switches);
  EXPECT_EQ(second.state.u[0], third.state.u[0]);
  const auto finer = ofFmu(fmu("stick_slip", 2), 1e-10);
  EXPECT_NEAR(second.state.u[0], finer.state.u[0], 1e-6);
  EXPECT_NEAR(second.state.v[0], finer.state.v[0], 1e-5);
}

// The exact solution between samples, where the torque is constant.
TEST_F(Fmu, ASampledControllerHasItsSamplesExactly) {
  double phi = 0, omega = 0;
  for (int k = 0; k < 30; ++k) {
    const double torque = 4 * (1 - phi), rest = omega - torque / 2, decay = std::exp(-0.2);
    phi += torque / 2 * 0.1 + rest / 2 * (1 - decay);
    omega = torque / 2 + rest * decay;
  }
  for (const int version : {2, 3}) {
    const auto made = ofFmu(fmu("sampled", version));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
    EXPECT_NEAR(made.state.u[0], phi, 1e-8) << version;
    EXPECT_NEAR(made.state.v[0], omega, 1e-8) << version;
  }
}

TEST_F(Fmu, HysteresisBrakesAndReleases) {
  const auto made = ofFmu(fmu("motor", 2));
  ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
  EXPECT_EQ(made.state.u.size(), 4);
  EXPECT_EQ(made.state.x.size(), 2);
  EXPECT_GE(made.counters.switches, 2);
}

// The second integration begins at the start again: an FMU is brought back there.
TEST_F(Fmu, ARunAgainHasTheSameBits) {
  for (const int version : {2, 3}) {  // by its first state, and by a new instance
    const auto setup = makeSetup<double>(radauSpec(own::loadFile(fmu("stick_slip", version))));
    const auto first = integrated(setup), second = integrated(setup);
    EXPECT_EQ(first.state.u[0], second.state.u[0]) << version;
    EXPECT_EQ(first.state.v[0], second.state.v[0]) << version;
    EXPECT_EQ(first.counters.residuals, second.counters.residuals) << version;
  }
}

TEST_F(DamagedFmu, AnArchiveThatIsNotAsItShouldBeIsALine) {
  write("text.fmu", "no archive");
  expectRefused("text.fmu", "text.fmu: it is no zip archive, as an FMU is");
  expectRefused("missing.fmu", "missing.fmu");
  pack("other", 2, "fmiVersion=\"2.0\"", "fmiVersion=\"1.0\"");
  expectRefused("other.fmu", "other.fmu: fmiVersion = '1.0': 2.0 and 3.0 are possible");
  pack("slave", 2, "<ModelExchange", "<CoSimulation");
  expectRefused("slave.fmu", "slave.fmu: it is for co-simulation only");
  pack("broken", 3, "</ModelVariables>", "</Model>");
  expectRefused("broken.fmu", "broken.fmu: modelDescription.xml: Start-end tags mismatch");
  pack("nameless", 3, "modelIdentifier=\"fmu_pendulum\"", "modelIdentifier=\"pump\"");
  expectRefused("nameless.fmu", "it has no library for this platform, binaries/x86_64-linux/pump.so, and no sources");
  pack("number", 2, "<Unknown index=\"2\"/>", "<Unknown index=\"99\"/>");
  expectRefused("number.fmu", "number.fmu: modelDescription.xml: there is no variable number 99");
  std::filesystem::create_directories(folder_.path() / "empty/resources");
  write("empty/resources/a.txt", "a");
  zip("empty");
  expectRefused("empty.fmu", "empty.fmu: it has no modelDescription.xml");
  pack("wrong", 3, "fmiVersion=\"3.0\"", "fmiVersion=\"2.0\"");
  expectRefused("wrong.fmu", "wrong.fmu: ");
}

TEST_F(DamagedFmu, AnFmuThatFailsIsALine) {
  for (const int version : {2, 3}) {
    const std::string file = fmu("pendulum", version), prefix = "fmi" + std::to_string(version);
    expectRefused(file, version == 2 ? "fmi2Instantiate fails" : "fmi3InstantiateModelExchange fails",
                  "IRK_DAMAGE=instantiate");
    expectRefused(file, prefix + "EnterInitializationMode fails with status 3: the table of friction is empty",
                  "IRK_DAMAGE=initialize");
    expectRefused(file, "event mode does not settle in 1000 passes", "IRK_DAMAGE='does not settle'");
    expectRefused(file, "its start: ", "IRK_DAMAGE='not finite'");
    expectRefused(file + " --set lenght=2", "unknown parameter of fmu_pendulum_");
    expectRefused(fmu("sampled", version) + " --set limit=0.5", "it ends the simulation at t = ");
  }
  const Ran ran = irk("solve " + fmu("pendulum", 2) + " --tol 1e-6 --error-bar none", "IRK_DAMAGE=discards");
  EXPECT_EQ(ran.status, 1) << ran.text;
}

// Each run needs an instance, and there may be only one: runs take turns.
TEST_F(DamagedFmu, OneInstanceForAllRuns) {
  pack("once", 2, "<ModelExchange", "<ModelExchange canBeInstantiatedOnlyOncePerProcess=\"true\"");
  write("mine.toml",
        "title = 'Mine'\n[[block]]\nscene = 'once.fmu'\nmethods = ['radau_iia_3', 'gauss_3']\n"
        "tolerances = [1e-4, 1e-5, 1e-6, 1e-7]\n");
  const Ran study = irk("run mine.toml --jobs 2");
  EXPECT_EQ(study.status, 0) << study.text;
  EXPECT_NE(study.text.find("8 success"), std::string::npos) << study.text;
}

TEST_F(OwnFiles, AnFmuStandsWhereASceneMayStand) {
  write("mine.toml",
        "title = 'Mine'\n[defaults]\nreference = 'auto'\n[[block]]\nscene = '" + fmu("motor", 2) +
            "'\nt_end = 0.3\nmethods = ['radau_iia_3', 'cvode_bdf', 'ida_bdf']\ntolerances = [1e-4, 1e-6]\n" +
            "formulation = 'index1'\n");
  const Ran study = irk("run mine.toml");
  EXPECT_EQ(study.status, 0) << study.text;
  EXPECT_NE(study.text.find("6 success"), std::string::npos) << study.text;
}

// CVODE and IDA end steps at roots, not behind them: the FMU has its events all the same.
TEST_F(Fmu, OtherSolversFindTheSameEvents) {
  const auto id = own::loadFile(fmu("motor", 2));
  for (const char* method : {"radau_iia_3", "cvode_bdf", "ida_bdf"}) {
    for (const double tolerance : {1e-6, 1e-7, 1e-8}) {
      auto spec = radauSpec(id, tolerance);
      spec.method = method;
      spec.formulation = Formulation::kIndex1;
      spec.error_bar = ErrorBarUse::kNone;
      const RunRecord record = execute(resolved(spec));
      EXPECT_EQ(record.outcome, "success") << method << record.detail;
      EXPECT_EQ(record.counters.located_events, 7) << method << " " << tolerance;
    }
  }
}

}  // namespace
}  // namespace irk
#endif
