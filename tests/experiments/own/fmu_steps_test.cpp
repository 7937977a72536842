// FMUs that ask for events at the ends of steps (tests/fmus/charts.c), and codes without a search for roots.
#if defined(IRK_FMUS)
#include <cmath>
#include <numbers>
#include <string>

#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/run.h"
#include "tests/experiments/own/fmu_files.h"
#include "tests/experiments/reference/own_cache.h"

namespace irk {
namespace {

// The coordinate of the chart in which |s| < 1, of the angle phi.
double coordinate(double phi) {
  const double chart = std::round(phi / std::numbers::pi);
  return std::tan((phi - chart * std::numbers::pi) / 2);
}

class FmuSteps : public WithOwnCache {};

// Without its events s becomes infinite at t = pi.
TEST_F(FmuSteps, AnEventThatAStepAsksForHappensAtItsEnd) {
  for (const int version : {2, 3}) {
    const auto made = ofFmu(fmu("charts", version));
    ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
    EXPECT_EQ(made.counters.switches, 3) << version;  // phi = 10 is in chart 3
    EXPECT_EQ(made.counters.located_events, 0) << version;
    EXPECT_NEAR(made.state.x[0], coordinate(10), 1e-7) << version;
  }
}

TEST_F(FmuSteps, OtherIntegratorsCarryThemOut) {
  const auto id = own::loadFile(fmu("charts", 2));
  const std::string radau5 = "radau5@" IRK_SOLVERS "/fortran_like.so";
  for (const std::string& method :
       {std::string("cvode_bdf"), std::string("ida_bdf"), std::string("gsl_bsimp"), radau5}) {
    if (method == "gsl_bsimp" && !hasGsl()) continue;
    for (const char* formulation : {"index1", "first_order"}) {
      const RunRecord record = execute(parseSpec("method=" + method + ";scene=" + id + ";formulation=" + formulation +
                                                 ";rtol=1e-6;atol=1e-6;error_bar=none"));
      EXPECT_EQ(record.outcome, "success") << method << record.detail;
      EXPECT_EQ(record.counters.switches, 3) << method;
      EXPECT_NEAR(record.x[0], coordinate(10), 1e-3) << method;
    }
  }
}

// The second integration has its own steps and thus its own events; both come to the same chart.
TEST_F(FmuSteps, TheErrorBarHoldsAndARunAgainHasTheSameBits) {
  for (const int version : {2, 3}) {
    const auto id = own::loadFile(fmu("charts", version));
    auto spec = radauSpec(id, 1e-6);
    spec.error_bar = ErrorBarUse::kMeasured;
    const RunRecord record = execute(resolved(spec));
    EXPECT_EQ(record.outcome, "success") << record.detail;
    EXPECT_GE(2 * record.error_bar.x[0], std::abs(record.x[0] - coordinate(10))) << version;
    EXPECT_LT(record.error_bar.tolerances, 100) << version;
    const auto setup = makeSetup<double>(radauSpec(id));
    const auto first = integrated(setup), second = integrated(setup);
    EXPECT_EQ(first.state.x[0], second.state.x[0]) << version;
    EXPECT_EQ(first.counters.residuals, second.counters.residuals) << version;
  }
}

TEST_F(DamagedFmu, StepsOfAnFmuThatGoWrongAreALine) {
  for (const int version : {2, 3}) {
    const std::string file = fmu("charts", version), prefix = "fmi" + std::to_string(version);
    expectRefused(file + " --set last=1", "it ends the simulation at t = ");
    expectRefused(file, prefix + "CompletedIntegratorStep fails with status 3", "IRK_DAMAGE=step");
    expectRefused(file, "event mode does not settle in 1000 passes", "IRK_DAMAGE='does not settle'");
    expectRefused(file, "sets an event in time, t = 7: an FMU without event indicators", "IRK_DAMAGE=time");
  }
}

// RADAU5 looks for no roots: an FMU that has no events needs none.
TEST_F(OwnFiles, Radau5TakesAnFmuWithoutEvents) {
  const std::string study =
      "title = 'Mine'\n[defaults]\nreference = 'auto'\nformulation = 'index1'\n[[block]]\nscene = '";
  const std::string rest = "'\nmethods = ['radau_iia_3', 'cvode_bdf', 'ida_bdf', 'radau5@" IRK_SOLVERS
                           "/fortran_like.so']\ntolerances = [1e-5]\n";
  write("mine.toml", study + fmu("pendulum", 2) + rest);
  const Ran made = irk("run mine.toml");
  EXPECT_EQ(made.status, 0) << made.text;
  EXPECT_NE(made.text.find("4 success"), std::string::npos) << made.text;
  const Ran ball = irk("solve " + fmu("ball", 3) + " --tol 1e-5 --method radau5@" IRK_SOLVERS "/fortran_like.so");
  EXPECT_EQ(ball.status, 2) << ball.text;
  EXPECT_NE(ball.text.find("the library has no root finding"), std::string::npos) << ball.text;
}

}  // namespace
}  // namespace irk
#endif
