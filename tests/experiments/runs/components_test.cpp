// Settings, results and names of single components: absolute tolerances by name, invariants.
#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/runs/texts/component_names.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

RunRecord run(const std::string& text) { return execute(resolved(parseSpec(text))); }

// y1' = -y1, and y2 follows it fast. Loose tolerances for both components, or for one.
TEST(AtolOf, ReplacesAtolTimesTheScaleOfOneComponent) {
  const std::string text = "scene=kaps;method=radau_iia_3;rtol=1e-12;atol=1e-2";
  const RunRecord loose = run(text), tight = run(text + ";atol_of=y1=1e-10 y2=1e-10"),
                  one = run(text + ";atol_of=y2=1e-2");
  ASSERT_TRUE(loose.succeeded() && tight.succeeded() && one.succeeded());
  EXPECT_LT(tight.errors.all, 1e-2 * loose.errors.all);
  EXPECT_GT(tight.counters.steps_accepted, loose.counters.steps_accepted);
  // kaps has the scale 1: the same tolerance in other words.
  EXPECT_EQ(one.counters.steps_accepted, loose.counters.steps_accepted);
  EXPECT_EQ(one.errors.all, loose.errors.all);
  const RunRecord peer = run("scene=kaps;method=cvode_bdf;rtol=1e-9;atol=1e-2");
  const RunRecord tight_peer = run("scene=kaps;method=cvode_bdf;rtol=1e-9;atol=1e-2;atol_of=y1=1e-9 y2=1e-9");
  EXPECT_LT(tight_peer.errors.all, 0.1 * peer.errors.all);
}

// The integrator of a whole call, which is timed, is that of the run.
TEST(AtolOf, IsThatOfTheCallThatIsTimed) {
  const RunSpec spec =
      resolved(parseSpec("scene=kaps;method=radau_iia_3;rtol=1e-12;atol=1e-2;atol_of=y1=1e-10 y2=1e-10"));
  const auto scene = sceneOf<double>(spec);
  auto integrator = newIntegrator(spec, scene);
  const auto solution = integrator.integrate(scene.start, scene.t_end);
  EXPECT_EQ(solution.counters.steps_accepted, execute(spec).counters.steps_accepted);
  EXPECT_GT(solution.counters.steps_accepted, 0);
}

TEST(AtolOf, MistakesAreNamed) {
  const auto message = [](const std::string& value) {
    return misuseOf([&] { run("scene=kaps;method=radau_iia_3;atol_of=" + value); });
  };
  EXPECT_TRUE(containsAll(message("y3=1e-3"), {"atol_of", "'y3'", "y1"}));
  EXPECT_TRUE(containsAll(message("y1=0"), {"atol_of y1 = 0", "> 0"}));
  EXPECT_TRUE(containsAll(message("y1"), {"'y1'", "name=value"}));
  const Ended fixed = program({"solve", "kaps", "--method", "gauss_2", "--step", "0.1", "--atol-of", "y1=1e-3"});
  EXPECT_EQ(fixed.status, 2);
  EXPECT_TRUE(containsAll(fixed.err, {"--atol-of", "fixed"}));
}

TEST(Invariants, TheLargestChangeIsPrinted) {
  const Ended coarse = program({"solve", "kepler", "--method", "radau_iia_2", "--step", "0.05", "--json"});
  const Ended fine = program({"solve", "kepler", "--method", "gauss_5", "--tol", "1e-11"});
  EXPECT_TRUE(containsAll(coarse.out, {"\"invariants\"", "\"energy\"", "\"angular_momentum\"", "\"change\""}));
  EXPECT_TRUE(containsAll(fine.out, {"invariant energy", "invariant angular_momentum", "changes by at most"}));
  RunSpec spec = resolved(parseSpec("scene=kepler;method=radau_iia_2;h=0.05;control=fixed;estimate=none"));
  Watch watch;
  EXPECT_TRUE(execute(spec, watch).invariants.empty());
  watch.invariants = true;
  const RunRecord record = execute(spec, watch);
  ASSERT_EQ(record.invariants.size(), 2u);
  // The change at the end is a lower bound; energy of the exact orbit is -1/2.
  const double energy = record.v.squaredNorm() / 2 - 1 / record.u.norm();
  EXPECT_EQ(record.invariants[0].name, "energy");
  EXPECT_GE(record.invariants[0].change, std::abs(energy + 0.5) * (1 - 1e-9));
  EXPECT_GT(record.invariants[0].change, 1e-6);
  EXPECT_LT(record.invariants[0].change, 1);
  EXPECT_EQ(record.invariants[0].start, -0.5);
}

// One number for the row of a run: the worst of all, relative where it can be.
TEST(Invariants, AreAColumnOfRuns) {
  EXPECT_TRUE(std::isnan(largestChange({})));
  EXPECT_EQ(largestChange({{"energy", "J", -4, 2}, {"momentum", "", 0, 0.25}}), 0.5);
  EXPECT_EQ(largestChange({{"energy", "J", -4, 0.5}, {"momentum", "", 0, 0.25}}), 0.25);
  EXPECT_EQ(largestChange({{"energy", "J", 4e-29, 1e-4}}), 1e-4);  // a zero with round-off
  EXPECT_EQ(largestChange({{"energy", "J", 1e-8, 1}}), 1e8);
  EXPECT_EQ(largestChange({{"energy", "J", 0, 0}}), 0);
  EXPECT_TRUE(std::isnan(largestChange({{"energy", "J", 1, std::nan("")}, {"momentum", "", 1, 2}})));
  const auto cell = [](const char* scene) {
    RunSpec spec = resolved(
        parseSpec("method=radau_iia_2;h=0.05;control=fixed;estimate=none;t_end=1;scene=" + std::string(scene)));
    Watch watch;
    watch.invariants = true;
    const RunRecord record = execute(spec, watch);
    const Table table{{}, runColumns(), {}};
    return numberAt(table, runRow("k", "s", record), "invariant_change") / largestChange(record.invariants);
  };
  EXPECT_EQ(cell("kepler"), 1);
  EXPECT_TRUE(std::isnan(cell("van_der_pol"))) << "without invariants";
}

const Sizes kScene{.nu = 2, .nx = 1, .nz = 1};
const std::vector<std::string> kNames{"theta", "phi", "theta'", "phi'", "i", "lambda"};

std::string named(const std::string& message, const Sizes& system) {
  return withNames(message, kNames, kScene, system);
}

TEST(ComponentNames, AreThoseOfTheScene) {
  EXPECT_EQ(named("largest error in u[1]) at t = 2", kScene), "largest error in phi) at t = 2");
  EXPECT_EQ(named("v[0], x[0] and z[0]", kScene), "theta', i and lambda");
  EXPECT_EQ(named("nothing here", kScene), "nothing here");
}

// Formulations of first order have (u, v, x) as x; GGL has multipliers of its own.
TEST(ComponentNames, OfFormulationsOfFirstOrder) {
  const Sizes ggl{.nu = 0, .nx = 5, .nz = 2};
  EXPECT_EQ(named("x[0] x[3] x[4] z[0] z[1]", ggl), "theta phi' i lambda GGL's multiplier 0");
  EXPECT_EQ(named("at the start: x[0] = nan", ggl), "at the start: i = nan");
}

TEST(ComponentNames, UnknownComponentsKeepTheirNames) {
  EXPECT_EQ(named("u[2] x[1] z[7] g[0] index[3]", kScene), "u[2] x[1] z[7] g[0] index[3]");
}

}  // namespace
}  // namespace irk
