// `irk solve` with lists: all combinations.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/commands/commands.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

using Json = nlohmann::json;

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(SolveSweep, AllCombinationsTheLastListFastest) {
  SolveOptions options;
  options.settings = {"a=1,2", "b=3"};
  options.fields = {{"newton", "simplified,full"}};
  options.tol = "1e-4,1e-6";
  const Sweep sweep = sweepOf(options);
  EXPECT_EQ(sweep.names, (std::vector<std::string>{"a", "newton", "tol"}));
  ASSERT_EQ(sweep.runs.size(), 8u);
  EXPECT_EQ(sweep.runs[1].values, (std::vector<std::string>{"1", "simplified", "1e-6"}));
  EXPECT_EQ(sweep.runs[6].values, (std::vector<std::string>{"2", "full", "1e-4"}));
  EXPECT_EQ(sweep.runs[6].options.settings, (std::vector<std::string>{"a=2", "b=3"}));
  EXPECT_EQ(sweep.runs[6].options.fields.front().second, "full");
  EXPECT_EQ(sweep.runs[6].options.tol, "1e-4");
}

TEST(SolveSweep, EachLineIsThatRun) {
  const Ended sweep = program({"solve", "kepler", "--set", "e=0.1,0.3", "--method", "radau_iia_5,gauss_5", "--json"});
  ASSERT_EQ(sweep.status, 0) << sweep.err;
  const auto lines = linesOf(sweep.out);
  ASSERT_EQ(lines.size(), 4u);
  std::size_t i = 0;
  for (const char* e : {"e=0.1", "e=0.3"}) {
    for (const char* method : {"radau_iia_5", "gauss_5"}) {
      const Json expected = Json::parse(program({"solve", "kepler", "--set", e, "--method", method, "--json"}).out);
      const Json line = Json::parse(lines[i++]);
      EXPECT_EQ(line["u"], expected["u"]);
      EXPECT_EQ(line["counters"], expected["counters"]);
      EXPECT_EQ(line["spec"], expected["spec"]);
    }
  }
}

TEST(SolveSweep, ATableWithTheRunsThatFail) {
  const Ended sweep = program({"solve", "slider_crank", "--method", "gauss_3,radau_iia_3", "--tol", "1e-4"});
  EXPECT_EQ(sweep.status, 1);
  const auto lines = linesOf(sweep.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(containsAll(lines[0], {"method", "outcome", "error", "accepted", "cpu_s"}));
  EXPECT_TRUE(containsAll(lines[1], {"gauss_3", "step_too_small", "largest error in "})) << lines[1];
  EXPECT_TRUE(containsAll(lines[2], {"radau_iia_3", "success"})) << lines[2];
}

// A combination that cannot work is a line, too; a value that no run takes is refused before the first.
TEST(SolveSweep, RefusedRunsAndBadLists) {
  const Ended one = program({"solve", "pendulum", "--method", "lobatto_iiib_3,radau_iia_3"});
  EXPECT_EQ(one.status, 1);
  EXPECT_TRUE(containsAll(one.out, {"refused", "success"})) << one.out;
  expectOneLine({{2, {"solve", "kepler", "--set", "e=0.1,,0.2"}, "e", {"empty item"}},
                 {2, {"solve", "kepler", "--set", "e=0.1,"}, "e", {"empty item"}},
                 {2, {"solve", "kepler", "--tol", "1e-4,1e-4"}, "tol", {"twice"}},
                 {2, {"solve", "kepler", "--set", "e=0.1,2"}, "e", {"2", "0.99"}},
                 {2, {"solve", "kepler", "--method", "gauss_3,gaus_2"}, "gaus_2"},
                 {2, {"solve", "kepler", "--set", "ee=1,2"}, "'ee'"},
                 {2, {"solve", "kepler", "--newton", "simplified,simple"}, "'simple'"}});
}

}  // namespace
}  // namespace irk
