// `irk reference`: digits, tables, and the command itself.
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/reference/agreement.h"
#include "experiments/reference/integration.h"
#include "experiments/reference/tables.h"
#include "experiments/runs/fields.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

ReferenceValue value(const char* component, const char* number, double accuracy) {
  return {"kaps", "", "0.5", component, BigFloat(number), accuracy, "a test"};
}

TEST(Agreement, RoundsUpToOneDigit) {
  EXPECT_EQ(roundedUp(2.3e-20), 3e-20);
  EXPECT_EQ(roundedUp(3e-20), 3e-20);
  EXPECT_EQ(roundedUp(9.6e-5), 1e-4);
  EXPECT_EQ(roundedUp(1), 1);
  EXPECT_EQ(roundedUp(120), 200);
}

TEST(Agreement, IsTheLargestDifferenceOfTheRuns) {
  const BigFloat runs[] = {BigFloat("1.00000000000000000012"), BigFloat("1.0000000000000000001"),
                           BigFloat("0.99999999999999999998"), BigFloat("1")};
  const AgreedValue found = agreed(runs, 1e-30);
  EXPECT_EQ(found.value, BigFloat(1)) << "the last run is the best";
  EXPECT_DOUBLE_EQ(found.accuracy, 2e-19);
  EXPECT_DOUBLE_EQ(agreed(runs, 5e-10).accuracy, 5e-10) << "no better than what was asked for";
}

TEST(Agreement, WritesTheDigitsThatItStatesAndOneMore) {
  EXPECT_EQ(decimalText(BigFloat("1.23456789"), 1e-4), "1.23457");
  EXPECT_EQ(decimalText(BigFloat("-1.23456789"), 3e-4), "-1.23457");
  EXPECT_EQ(decimalText(BigFloat("12345.678"), 1e-1), "12345.68");
  EXPECT_EQ(decimalText(BigFloat("0.0012345678"), 1e-6), "0.0012346");
  EXPECT_EQ(decimalText(BigFloat("8.3333607703347e-14"), 1e-20), "8.3333608e-14");
  EXPECT_EQ(decimalText(BigFloat("9.99999"), 1e-2), "10.000");
  EXPECT_EQ(decimalText(BigFloat(0), 1e-30), "0");
  EXPECT_EQ(decimalText(BigFloat("-2.7e-50"), 1e-38), "0") << "round-off";
  // Not all of the fifty digits are correct.
  EXPECT_EQ(decimalText(BigFloat(1) / 3, 1e-60).size(), std::string("0.").size() + 40);
}

TEST(ReferenceTable, ReadsBackWhatItWrote) {
  const std::vector<ReferenceValue> values = {value("y1", "0.36787944117144232159", 1e-20),
                                              value("y2", "-6.0653e-14", 1e-18)};
  const auto read = referenceValues("kaps.csv", referenceTable({}, values));
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(samePlace(read[i], values[i]));
    EXPECT_LE(abs(read[i].value - values[i].value), BigFloat(values[i].accuracy) / 10);
    EXPECT_EQ(read[i].accuracy, values[i].accuracy);
    EXPECT_EQ(read[i].source, "a test");
  }
}

TEST(ReferenceTable, RefusesDamage) {
  const Table good = referenceTable({}, {value("y1", "0.5", 1e-10)});
  const auto message = [&](const char* column, const char* cell) {
    Table damaged = good;
    damaged.rows[0][damaged.column(column)] = cell;
    return misuseOf([&] { referenceValues("kaps.csv", damaged); });
  };
  EXPECT_TRUE(containsAll(message("value", "0.5x"), {"kaps.csv, row 1: value", "0.5x"}));
  EXPECT_TRUE(containsAll(message("value", ""), {"kaps.csv, row 1: value"}));
  EXPECT_TRUE(containsAll(message("t", "one"), {"kaps.csv, row 1: t", "one"}));
  EXPECT_TRUE(containsAll(message("t", "0.314159265358979323"), {"row 1: t", "digits"}));
  EXPECT_TRUE(containsAll(message("accuracy", "0"), {"kaps.csv, row 1: accuracy", "> 0"}));
  EXPECT_TRUE(containsAll(message("scene", "kap"), {"kap", "did you mean 'kaps'"}));
  EXPECT_TRUE(containsAll(message("settings", "epsilon=1"), {"epsilon", "did you mean 'eps'"}));
  Table renamed = good;
  renamed.columns[4] = "number";
  EXPECT_TRUE(containsAll(misuseOf([&] { referenceValues("kaps.csv", renamed); }), {"value"}));
}

TEST(ReferenceTable, ComparesWithinBothAccuracies) {
  const auto computed = std::vector{value("y1", "1.00", 1e-3), value("y2", "2", 1e-3)};
  EXPECT_TRUE(disagreements({value("y1", "1.0019", 1e-3)}, computed).empty());
  EXPECT_EQ(disagreements({value("y1", "1.0021", 1e-3)}, computed).size(), 1U);
  EXPECT_EQ(disagreements({value("y3", "1", 1e-3)}, computed).size(), 1U) << "not computed";
  ReferenceValue later = value("y1", "1", 1e-3);
  later.t = "0.50";
  EXPECT_TRUE(disagreements({later}, computed).empty()) << "the same time, written differently";
  later.t = "0.51";
  EXPECT_EQ(disagreements({later}, computed).size(), 1U);
  EXPECT_TRUE(differences(computed, computed).empty());
  EXPECT_EQ(differences({computed[0]}, computed).size(), 1U) << "y2 is missing";
}

TEST(ReferenceTasks, CoverEverySceneOnceWithEachSetting) {
  std::vector<std::string> tasks;
  for (const auto& task : referenceTasks()) {
    const RunSpec spec = referenceSpec(task, "radau_iia_16", Fineness::kFine);
    tasks.push_back(spec.scene + " " + settingsText(spec.settings));
  }
  for (const auto& scene : sceneCatalogue()) {
    EXPECT_EQ(std::count(tasks.begin(), tasks.end(), scene.id + " "), 1) << scene.id;
  }
  std::sort(tasks.begin(), tasks.end());
  EXPECT_EQ(std::adjacent_find(tasks.begin(), tasks.end()), tasks.end());
}

std::vector<ReferenceValue> valuesOfFile(const std::string& name) {
  const std::string file = IRK_SOURCE_DIR "/problems/reference/" + name;
  return referenceValues(file, readTable(file));
}

TEST(ReferenceTasks, CoverEveryIndependentValue) {
  std::vector<std::string> covered;
  for (const auto& task : referenceTasks()) {
    const RunSpec spec = referenceSpec(task, "radau_iia_16", Fineness::kFine);
    covered.push_back(spec.scene + " " + settingsText(spec.settings));
  }
  for (const auto& [file, least] : {std::pair("independent.csv", 150U), std::pair("test_set.csv", 1500U)}) {
    const auto values = valuesOfFile(file);
    EXPECT_GT(values.size(), least);
    for (const auto& value : values) {
      const auto count = std::count(covered.begin(), covered.end(), value.scene + " " + value.settings);
      EXPECT_EQ(count, 1) << value.place();
    }
  }
}

// Other programs and the 50 digits of this one agree to the digits that both state.
TEST(ReferenceTable, OfTheTestSetAgreesWithFiftyDigits) {
  const auto others = valuesOfFile("test_set.csv");
  int compared = 0;
  for (const char* scene : {"chemakzo", "pollution"}) {
    const auto computed = valuesOfFile(std::string(scene) + ".csv");
    std::vector<ReferenceValue> of_scene;
    std::copy_if(others.begin(), others.end(), std::back_inserter(of_scene),
                 [&](const auto& value) { return value.scene == scene; });
    for (const auto& line : disagreements(of_scene, computed)) ADD_FAILURE() << line;
    compared += static_cast<int>(of_scene.size());
  }
  EXPECT_EQ(compared, 26);
}

// An integration that begins at a time of the system, where an input jumps, goes on behind the jump.
TEST(Integrated, PassesTheTimesOfTheSystem) {
  RunSpec spec;
  findField("scene").set(spec, "medakzo");
  findField("settings").set(spec, "N=10");
  spec.options.tolerances.rtol = spec.options.tolerances.atol = 1e-10;
  spec = resolved(spec);
  const auto at_once = integrated(spec, {"8"}, {}), stopped = integrated(spec, {"5", "8"}, {});
  ASSERT_EQ(at_once.failure, "");
  ASSERT_EQ(stopped.failure, "");
  const auto &wanted = at_once.rows.back(), &found = stopped.rows.back();
  ASSERT_EQ(found.size(), 20U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(found[i]), static_cast<double>(wanted[i]), 1e-8) << i;
  }
}

TEST(Compute, AStoppedRunIsNoValue) {
  const std::atomic<bool> stop = true;
  const auto computed = compute({"kaps"}, {"1"}, {.stop = &stop});
  EXPECT_TRUE(computed.values.empty());
  ASSERT_EQ(computed.problems.size(), 1U);
  EXPECT_TRUE(containsAll(computed.problems[0], {"kaps", "_16 at tol", "interrupted"}));
}

// A task without exact solution: its values come from the four runs alone. The value at tolerance 1e-12 must agree
// with that at 1e-28 within its stated accuracy, and state about as many digits as requested.
TEST(Compute, StatesWhatTheRunsAgreeOn) {
  ReferenceTask coarse{"mechanical_dae"}, fine = coarse;
  coarse.of.tolerance = 1e-12;
  fine.of.tolerance = 1e-28;
  const auto by_coarse = compute(coarse, {"0.25", "1"}, {.jobs = 2}), by_fine = compute(fine, {"0.25", "1"}, {});
  ASSERT_TRUE(by_coarse.problems.empty() && by_fine.problems.empty());
  ASSERT_EQ(by_coarse.values.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto &rough = by_coarse.values[i], &good = by_fine.values[i];
    EXPECT_TRUE(samePlace(rough, good));
    EXPECT_LE(abs(rough.value - good.value), BigFloat(rough.accuracy)) << rough.place();
    EXPECT_LT(rough.accuracy, 1e-9) << rough.place();
    EXPECT_GE(rough.accuracy, 1e-15 / 2) << "the finer tolerance; " << rough.place();
    EXPECT_LT(good.accuracy, 1e-24) << good.place();
  }
}

Ended reference(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "reference");
  return program(arguments);
}

void replaceIn(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = readInputFile(file);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos);
  std::ofstream(file) << text.replace(at, from.size(), to);
}

TEST(ReferenceCommand, WritesAndChecks) {
  const TemporaryFolder folder;
  const auto out = folder.path().string();
  const auto written = reference({"kaps", "--out", out});
  ASSERT_EQ(written.status, 0) << written.out << written.err;
  const auto file = folder.path() / "kaps.csv";
  const auto values = referenceValues(file.string(), readTable(file));
  ASSERT_EQ(values.size(), 6U) << "two components at three times";
  for (const auto& value : values) {
    const BigFloat rate = value.component == "y1" ? -2 : -1;
    EXPECT_LT(abs(value.value - exp(rate * BigFloat(value.t))), BigFloat("1e-37")) << value.place();
  }
  const auto check = [&] { return reference({"kaps", "--check", "--out", out}); };
  EXPECT_EQ(check().status, 0);
  replaceIn(file, "0.60653065971263342", "0.60653065971263343");
  const auto damaged = check();
  EXPECT_EQ(damaged.status, 1);
  EXPECT_TRUE(containsAll(damaged.out, {"kaps, y1 at t = 0.25", "0.60653065971263343"}));
  std::filesystem::remove(file);
  EXPECT_EQ(check().status, 1) << "no file";
  EXPECT_FALSE(std::filesystem::exists(file)) << "checking writes nothing";
}

}  // namespace
}  // namespace irk
