// FMUs with arrays (tests/fmus/chain.c).
#if defined(IRK_FMUS)
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/experiments/own/fmu_files.h"
#include "tests/experiments/reference/own_cache.h"

namespace irk {
namespace {

class FmuArrays : public WithOwnCache {};

// u'' = -c K u / m with K = tridiag(-1, 2, -1): its vectors sin(j k pi / 4), j = 1, 2, 3, swing alone, with the squares
// of their frequencies 2 c (1 - cos(k pi / 4)) / m. The start is k = 2.
TEST_F(FmuArrays, ArraysAreTheirElements) {
  const auto setup = makeSetup<double>(radauSpec(own::loadFile(fmu("chain", 3))));
  EXPECT_EQ(setup.scene.names, (std::vector<std::string>{"u[1]", "u[2]", "u[3]", "v[1]", "v[2]", "v[3]"}));
  const auto made = integrated(setup);
  ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
  ASSERT_EQ(made.state.u.size(), 3) << "the array that is a derivative has not been found";
  // Within 100 tolerances, as all that follows.
  const double omega = 2, t = 3, expected[] = {std::cos(omega * t), 0, -std::cos(omega * t)};
  for (Index j = 0; j < 3; ++j) {
    EXPECT_NEAR(made.state.u[j], expected[j], 1e-6);
    EXPECT_NEAR(made.state.v[j], (1 - double(j)) * -omega * std::sin(omega * t), 1e-6);
  }
  std::vector<std::string> outputs;
  std::vector<double> values;
  for (const auto& output : setup.scene.outputs) {
    outputs.push_back(output.name);
    values.push_back(output.value(made.state));
  }
  EXPECT_EQ(outputs, (std::vector<std::string>{"stretch[1.1]", "stretch[1.2]", "stretch[2.1]", "stretch[2.2]"}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(values[i], (i == 0 || i == 3 ? 1 : -1) * expected[0], 1e-6) << i;
  }
}

// Elements are set, and u[3] keeps its start: an array is given to the FMU as a whole. The start is then k = 3.
TEST_F(FmuArrays, ElementsOfArraysAreSet) {
  auto spec = radauSpec(own::loadFile(fmu("chain", 3)));
  spec.settings = {{"u[1]", "-1"}, {"u[2]", "1.4142135623730951"}, {"m[1]", "4"}, {"m[2]", "4"}, {"m[3]", "4"}};
  const auto made = integrated(makeSetup<double>(spec));
  ASSERT_EQ(made.outcome, Outcome::kSuccess) << made.detail;
  const double omega = std::sqrt(2 * 2 * (1 - std::cos(3 * std::numbers::pi / 4)) / 4);
  for (Index j = 0; j < 3; ++j) {
    EXPECT_NEAR(made.state.u[j], (j == 1 ? std::numbers::sqrt2 : -1) * std::cos(3 * omega), 1e-6);
  }
}

// The rest position under a force on the second mass, c K u = f, is u = f (1/2, 1, 1/2) / c.
TEST_F(DamagedFmu, ATableIsAnElementOfAnInput) {
  std::filesystem::copy_file(fmu("chain", 3), folder_.path() / "chain.fmu");
  write("force.csv", "time,f[2]\n0,4\n3,4\n");
  const std::string set = " --set u[1]=1 --set u[2]=2 --set u[3]=1 --set f[2]=";
  for (const char* force : {"4", "force.csv"}) {
    const Ran ran = irk("solve chain.fmu" + set + force + " --method radau_iia_3 --tol 1e-8");
    EXPECT_EQ(ran.status, 0) << ran.text;
    for (const char* line : {"u[1]         1 +-", "u[2]         2 +-", "u[3]         1 +-"}) {
      EXPECT_NE(ran.text.find(line), std::string::npos) << ran.text;
    }
  }
}

TEST_F(DamagedFmu, AnArrayThatIsNotAsItShouldBeIsALine) {
  const std::string size = "causality=\"structuralParameter\" variability=\"fixed\" start=\"3\"";
  struct Case {
    std::string name, from, to, text;
  };
  const std::vector<Case> cases{
      {"starts", "start=\"1 0 -1\"", "start=\"1 0\"", "u has 3 elements and 2 start values"},
      {"word", "start=\"1 0 -1\"", "start=\"1 0 x\"", "u[3] has the start value 'x': a number is expected"},
      {"zero", size, "causality=\"structuralParameter\" start=\"0\"", "u: a dimension has start = '0'"},
      {"negative", size, "causality=\"structuralParameter\" start=\"-3\"", "u: a dimension has start = '-3'"},
      {"huge", size, "causality=\"structuralParameter\" start=\"99999999\"", "u: a dimension has start = '99999999'"},
      {"none", size, "causality=\"structuralParameter\"", "u: a dimension has start = ''"},
      {"who", "<Dimension valueReference=\"0\"/>", "<Dimension valueReference=\"77\"/>",
       "there is no variable with valueReference 77"},
      {"many", "<Dimension start=\"3\"/>", "<Dimension start=\"3000\"/><Dimension start=\"3000\"/>",
       "m: a dimension has start = '3000'; arrays of 1 to 1000000 elements are possible"},
      {"shapes", "derivative=\"2\"><Dimension valueReference=\"0\"/>", "derivative=\"2\"><Dimension start=\"2\"/>",
       "the state v has 3 elements, and its derivative der(v) has 2"},
      {"scalar", "derivative=\"2\"><Dimension valueReference=\"0\"/>", "derivative=\"2\">",
       "the state v has 3 elements, and its derivative der(v) has 1"}};
  for (const Case& one : cases) {
    pack(one.name, 3, one.from, one.to, "chain");
    expectRefused(one.name + ".fmu", one.name + ".fmu: modelDescription.xml: " + one.text);
  }
  expectRefused(fmu("chain", 3) + " --set u=1", "unknown parameter of fmu_chain_3 'u'");
  expectRefused(fmu("chain", 3) + " --set u[4]=1", "unknown parameter of fmu_chain_3 'u[4]'");
  expectRefused(fmu("chain", 3) + " --set n=4", "unknown parameter of fmu_chain_3 'n'");
}

}  // namespace
}  // namespace irk
#endif
