// References that are computed for runs: their values, and the reasons for which there are none.
#include "experiments/reference/making.h"

#include <gtest/gtest.h>

#include "experiments/reference/integration.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

ComputedReference make(const ReferenceQuestion& question, const ReferenceLimits& limits = {}) {
  return makeReferences({question}, limits, {}).front();
}

ReferenceLimits onlyDouble() {
  ReferenceLimits limits;
  limits.most_unknowns = 0;
  return limits;
}

const ReferenceValue& valueOf(const ComputedReference& made, const std::string& component) {
  for (const auto& value : made.values) {
    if (value.component == component) return value;
  }
  throw std::out_of_range(component);
}

// kaps has the exact solution exp(-2 t), exp(-t). The four runs do not use it.
void expectKaps(const ComputedReference& made, double least, double most) {
  ASSERT_TRUE(made.problem.empty()) << made.problem;
  ASSERT_EQ(made.values.size(), 2u);
  for (const auto& [component, rate] : {std::pair("y1", -2), {"y2", -1}}) {
    const auto& value = valueOf(made, component);
    const BigFloat exact = exp(rate * BigFloat("0.3"));
    EXPECT_LE(abs(value.value - exact), BigFloat(value.accuracy)) << component;
    EXPECT_GT(value.accuracy, least);
    EXPECT_LT(value.accuracy, most);
  }
  EXPECT_GE(made.accuracy, least);
  EXPECT_LE(made.accuracy, most);
}

TEST(Making, FiftyDigitsAgreeWithAnExactSolution) {
  const auto made = make({"kaps", {}, 0.3});
  expectKaps(made, 1e-35, 1e-24);
  EXPECT_TRUE(made.in_double.empty());
}

TEST(Making, DoubleAgreesWithAnExactSolution) {
  const auto made = make({"kaps", {}, 0.3}, onlyDouble());
  expectKaps(made, 1e-15, 1e-10);
  EXPECT_TRUE(containsAll(made.in_double, {"2 unknowns are too many", "up to 0"}));
}

// torque_off_at switches at a given time; chattering friction switches at times that must be located. The exact
// solutions of these scenes are not used.
TEST(Making, SwitchesAreLocated) {
  for (const auto& [scene, t] : {std::pair("bouncing_mass", 0.9), {"elastoplastic", 1.1}}) {
    const auto entry = makeScene<BigFloat>(scene);
    ASSERT_TRUE(entry.exact) << scene;
    const auto made = make({scene, {}, t});
    ASSERT_TRUE(made.problem.empty()) << made.problem;
    const auto exact = componentsAndOutputs(entry, entry.exact(BigFloat(std::to_string(t))));
    std::size_t compared = 0;
    for (std::size_t i = 0; i < entry.names.size(); ++i) {
      if (!isfinite(exact[i])) continue;
      const auto& value = valueOf(made, entry.names[i]);
      EXPECT_LE(abs(value.value - exact[i]), 2 * BigFloat(value.accuracy)) << value.place();
      EXPECT_LT(value.accuracy, 1e-20) << value.place();
      ++compared;
    }
    EXPECT_GT(compared, 0u) << scene;
  }
}

// A stiff scene at a time of which nothing is stored, against a method of another family at low tolerance.
TEST(Making, AgreesWithAnotherFamily) {
  const auto made = make({"van_der_pol", {}, 0.7});
  ASSERT_TRUE(made.problem.empty()) << made.problem;
  const auto run = execute(parseSpec("scene=van_der_pol;t_end=0.7;scalar=mp50;method=gauss_7;rtol=1e-17;atol=1e-17"));
  ASSERT_TRUE(run.succeeded());
  EXPECT_LT(abs(valueOf(made, "y1").value - BigFloat(run.digits[0])), BigFloat("1e-14"));
  EXPECT_LT(abs(valueOf(made, "y2").value - BigFloat(run.digits[1])), BigFloat("1e-14"));
  EXPECT_LT(made.accuracy, 1e-22);
}

TEST(Making, TheRegularizedProblemHasAnotherReference) {
  const Settings settings{{"torque_off_at", "0.1"}};
  const auto sharp = make({"slider_crank", settings, 0.2}, onlyDouble());
  const auto smooth = make({"slider_crank", settings, 0.2, true}, onlyDouble());
  ASSERT_TRUE(sharp.problem.empty() && smooth.problem.empty()) << sharp.problem << smooth.problem;
  const auto &a = valueOf(sharp, "theta"), &b = valueOf(smooth, "theta");
  EXPECT_GT(abs(a.value - b.value), BigFloat(1e-6));
  EXPECT_LT(a.accuracy, 1e-8);
  EXPECT_LT(b.accuracy, 1e-8);
}

TEST(Making, RunsThatDisagreeGiveNone) {
  ReferenceLimits strict;
  strict.disagreement = 1e-45;
  const auto made = make({"mechanical_dae", {}, 0.02}, strict);
  EXPECT_TRUE(made.values.empty());
  EXPECT_TRUE(containsAll(made.problem, {"in 50 digits the four runs disagree, ", " by "}));
  strict.most_unknowns = 0;
  const auto in_double = make({"mechanical_dae", {}, 0.02}, strict);
  EXPECT_TRUE(in_double.values.empty());
  EXPECT_TRUE(containsAll(in_double.problem, {"too many", "in double: the four runs disagree"}));
}

TEST(Making, TakesNoLongerThanItMay) {
  ReferenceLimits limits;
  limits.cpu_s = 1e-9;
  const auto made = make({"mechanical_dae", {}, 0.02}, limits);
  EXPECT_TRUE(made.values.empty());
  EXPECT_TRUE(containsAll(made.problem, {"in 50 digits: ", "more than 1e-09 s", "; in double: lobatto_iiic at"}))
      << made.problem;
}

// Each of the four runs is one integration through all times. kaps has the solution exp(-t).
TEST(Making, SeveralTimesAreMadeTogether) {
  const std::vector<ReferenceQuestion> questions{{"kaps", {}, 0.1}, {"kaps", {}, 0.25}, {"kaps", {}, 0.3}};
  std::vector<std::string> shown;
  const auto made = makeReferences(questions, {}, {.show = [&](const std::string& text) { shown.push_back(text); }});
  ASSERT_EQ(made.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(made[k].problem.empty()) << made[k].problem;
    const auto& value = valueOf(made[k], "y2");
    EXPECT_LE(abs(value.value - exp(-BigFloat(std::to_string(questions[k].t_end)))), BigFloat(value.accuracy));
    EXPECT_LT(value.accuracy, 1e-24);
    EXPECT_EQ(made[k].seconds, made[0].seconds) << "together";
  }
  ASSERT_FALSE(shown.empty());
  EXPECT_TRUE(containsAll(shown[0], {"reference kaps, t = 0.1 ... 0.3 (3 times): in 50 digits, "}));
}

TEST(Making, AnInterruptIsNoAnswer) {
  const std::atomic<bool> stop = true;
  const auto made = makeReferences({{"mechanical_dae", {}, 0.02}}, {}, {.stop = &stop}).front();
  EXPECT_TRUE(made.interrupted);
  EXPECT_TRUE(made.values.empty());
}

TEST(Making, NamesTheMistakeInTheScene) {
  EXPECT_TRUE(containsAll(make({"kaps", {{"epsilon", "1"}}, 1}).problem, {"epsilon"}));
}

TEST(ReferenceKey, DiffersWhereTheSolutionMay) {
  const ReferenceQuestion question{"kaps", {}, 0.3};
  std::vector<ReferenceQuestion> others(4, question);
  others[0].scene = "kepler";
  others[1].settings = {{"eps", "1e-3"}};
  others[2].t_end = 0.30000000000000004;
  others[3].smooth = true;
  for (const auto& other : others) EXPECT_NE(keyText(other), keyText(question));
  EXPECT_TRUE(containsAll(keyText(question), {"scene=kaps", "source=", "eps=", "t_end=0.3", "code="}));
}

}  // namespace
}  // namespace irk
