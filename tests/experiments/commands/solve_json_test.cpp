// The JSON of `irk solve` against its schema, and what it says of the components.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "irk/statistics.h"
#include "tests/experiments/program.h"
#include "tests/experiments/solve_schema.h"

namespace irk {
namespace {

using Json = nlohmann::json;

// program() compares it with the schema.
TEST(SolveJson, EveryKindOfRunFollowsTheSchema) {
  struct Run {
    std::vector<std::string> arguments;
    int status = 0;
  };
  const Run runs[] = {
      {{"slider_crank", "--tol", "1e-6"}},
      {{"slider_crank", "--formulation", "ggl", "--t-end", "0.1"}},
      {{"slider_crank", "--method", "gauss_3", "--tol", "1e-4"}, 1},
      {{"stick_slip", "--tol", "1e-6"}},
      {{"prothero_robinson", "--set", "lambda=-1e8/h", "--step", "0.1"}},
      {{"kepler", "--max-steps", "2"}, 1},
      {{"kepler", "--method", "cvode_bdf", "--t-end", "1"}},
      {{"bouncing_mass", "--method", "cvode_bdf"}},
      {{"slider_crank", "--method", "ida_bdf"}},
      {{"van_der_pol", "--configuration", "variable"}},
      {{"riccati_tracking", "--scalar", "mp50", "--step", "0.5", "--method", "gauss_3"}},
      {{"riccati_tracking", "--scalar", "mp100", "--step", "0.5", "--method", "gauss_3"}},
  };
  for (const Run& run : runs) {
    SCOPED_TRACE(run.arguments[0] + (run.arguments.size() > 2 ? ' ' + run.arguments[2] : ""));
    const Json json = solvedJson(run.arguments, run.status);
    for (const char* group : {"u", "v", "x", "z"}) {
      EXPECT_EQ(json["names"][group].size(), json[group].size()) << group;
      EXPECT_EQ(json["units"][group].size(), json[group].size()) << group;
    }
  }
}

TEST(SolveJson, TheSchemaRefusesOthers) {
  const Json good = solvedJson({"kepler", "--t-end", "3"});
  const std::vector<Json::json_pointer> places{Json::json_pointer("/names"), Json::json_pointer("/units/z"),
                                               Json::json_pointer("/steps/accepted"), Json::json_pointer("/schema")};
  for (const auto& place : places) {
    Json bad = good;
    bad[place] = 1.5;
    EXPECT_FALSE(againstSolveSchema(bad).empty()) << place.to_string();
    bad = good;
    bad[place.parent_pointer()].erase(place.back());
    EXPECT_FALSE(againstSolveSchema(bad).empty()) << place.to_string();
  }
  Json more = good;
  more["unknown"] = 1;
  EXPECT_FALSE(againstSolveSchema(more).empty());
}

// A new counter is not forgotten.
TEST(SolveJson, EveryCounterIsPrinted) {
  const Json json = solvedJson({"bouncing_mass", "--tol", "1e-4"});
  Counters{}.forEach([&](const std::string& name, std::int64_t) {
    const bool of_steps = name.starts_with("steps_");
    EXPECT_TRUE(json[of_steps ? "steps" : "counters"].contains(of_steps ? name.substr(6) : name)) << name;
  });
}

TEST(SolveJson, NamesAndUnitsAreThoseOfTheScene) {
  const Json json = solvedJson({"slider_crank", "--t-end", "0.1"});
  EXPECT_EQ(json["names"]["u"], (Json{"theta", "phi"}));
  EXPECT_EQ(json["names"]["v"], (Json{"theta'", "phi'"}));
  EXPECT_EQ(json["units"]["v"], (Json{"rad/s", "rad/s"}));
  EXPECT_EQ(json["units"]["t"], "s");
}

// What limits the step: the component by its name, and what rejected the last one.
TEST(SolveJson, AFailureNamesComponentAndCause) {
  const std::pair<const char*, const char*> expected[] = {{"index2", "largest error in lambda"},
                                                          {"ggl", "largest error in GGL's mult"},
                                                          {"first_order", "largest error in theta'"}};
  for (const auto& [formulation, text] : expected) {
    const Ended run = program({"solve", "slider_crank", "--method", "radau_iia_2", "--tol", "1e-9", "--h-min", "1e-4",
                               "--formulation", formulation});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(", the last by the error"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("index2_projected"), std::string::npos) << "Radau IIA keeps the constraint: " << run.out;
  }
  // Which of the two rejects the last step depends on last digits.
  const Ended newton = program({"solve", "slider_crank", "--method", "gauss_3", "--tol", "1e-4"});
  EXPECT_TRUE(std::regex_search(newton.out, std::regex("by Newton [1-9].*, the last by (Newton|the error)")))
      << newton.out;
  EXPECT_NE(newton.out.find("formulation index2_projected projects them"), std::string::npos) << newton.out;
}

}  // namespace
}  // namespace irk
