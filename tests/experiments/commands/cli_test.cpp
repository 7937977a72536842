#include "experiments/commands/cli.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/runs/run_spec.h"
#include "irk/scene.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// What the schema requires is there, and nothing that it does not know: program() checks it.
TEST(Cli, SolveJsonHasExactlyTheKeys) {
  const auto json = solvedJson({"slider_crank", "--method", "radau_iia_5", "--tol", "1e-10", "--t-end", "1"});
  for (const char* key :
       {"mescd", "scd", "error_bar", "error_bar_tolerances", "error_bar_component", "error_bar_cpu_s"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json.size(), 17U + 6U) << "the keys that the schema requires, and these";
  EXPECT_EQ(json["reference"], "file");
  EXPECT_EQ(json["steps"].size(), 3U) << "those that the schema requires";
  EXPECT_EQ(json["counters"].size(), 10U) << "those that the schema requires";
  EXPECT_EQ(json["outcome"], "success");
  EXPECT_NEAR(json["u"][0].get<double>(), 14.127892217751, 1e-7);
  EXPECT_NEAR(json["v"][0].get<double>(), 20.537482851413, 1e-7);
  EXPECT_EQ(json["spec"]["method"], "radau_iia_5");
  EXPECT_TRUE(json["error"].is_number());
}

TEST(Cli, SolveJsonListsSwitches) {
  const auto json =
      solvedJson({"stick_slip", "--method", "radau_iia_10", "--tol", "1e-10", "--discontinuity", "locate"});
  const double times[] = {
      15, 18.536383773289554, 28.536383773289554, 32.07276754657911, 42.07276754657911, 45.609151319868666};
  ASSERT_EQ(json["switches"].size(), std::size(times));
  for (std::size_t i = 0; i < std::size(times); ++i) {
    EXPECT_NEAR(json["switches"][i]["t"].get<double>(), times[i], 1e-10);
    EXPECT_TRUE(json["switches"][i]["name"].is_string());
  }
  EXPECT_EQ(json["counters"]["located_events"], 6);
}

TEST(Cli, UnknownNumbersAreNull) {
  const auto json = solvedJson({"slider_crank", "--t-end", "0.123"});
  EXPECT_TRUE(json["error"].is_null());
  EXPECT_EQ(json["reference"], "none");
  const auto text = program({"solve", "slider_crank", "--t-end", "0.123"});
  EXPECT_TRUE(containsAll(text.out, {"error unknown: no reference at t = 0.123; --reference makes one\n"}));
}

TEST(Cli, AnExactSolutionIsAReference) { EXPECT_EQ(solvedJson({"dahlquist"})["reference"], "exact"); }

// Other libraries' codes make such errors on this circuit; it is no failure.
TEST(Cli, AKnownLargeErrorOfASuccessIsALine) {
  const std::vector<std::string> run{"solve", "ringmod",     "--method", "cvode_bdf", "--t-end",
                                     "1e-3",  "--error-bar", "none",     "--tol"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return program(more);
  };
  const auto large = with({"1e-6"});
  EXPECT_EQ(large.status, 0);
  EXPECT_TRUE(containsAll(large.out, {"\nthe error is ", "e+03 tolerances, though the run is a success\n"}));
  EXPECT_TRUE(containsAll(with({"1e-6,1e-3"}).out, {"  the error is ", "e+03 tolerances\n"}));
  const auto small = program({"solve", "van_der_pol", "--method", "cvode_bdf", "--tol", "1e-6", "--error-bar", "none"});
  EXPECT_EQ(small.out.find("tolerances"), std::string::npos) << small.out;
}

// z = h lambda is known for fixed steps only; the names of components do not depend on it.
TEST(Cli, ASettingOverTheStepIsSolvedAndPrinted) {
  const auto run =
      program({"solve", "prothero_robinson", "--set", "lambda=-1e8/h", "--step", "0.1", "--method", "radau_iia_3"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(containsAll(run.out, {"lambda=-1e8/h", "success", "x  y "}));
}

TEST(Cli, MultiprecisionNumbersAreText) {
  const auto json = solvedJson({"riccati_tracking", "--scalar", "mp50", "--step", "0.5", "--method", "gauss_3"});
  EXPECT_TRUE(json["x"][0].is_string());
}

TEST(Cli, StepMeansFixedSteps) {
  const auto json = solvedJson({"kepler", "--step", "0.1", "--t-end", "1"});
  EXPECT_EQ(json["spec"]["control"], "fixed");
  EXPECT_EQ(json["steps"]["accepted"], 10);
}

// With few unknowns threads would cost more than they give: the command says so in a line and takes one.
TEST(Cli, ThreadsThatDoNotPayAreSaidAndOneIsTaken) {
  const std::vector<std::string> few{"solve", "beam_chain", "--set", "m=99", "--t-end", "1e-3", "--threads", "2"};
  const Ended run = program(few);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "threads = 2 does not pay with 99 unknowns: below 100 one thread is taken\n");
  EXPECT_EQ(run.out.find("remark"), std::string::npos) << "one line is enough";
  const Ended several = program({"solve", "kepler", "--threads", "1,2", "--tol", "1e-3,1e-4", "--t-end", "0.1"});
  EXPECT_EQ(several.status, 0) << several.err;
  EXPECT_EQ(several.err, "threads = 2 does not pay with 2 unknowns: below 100 one thread is taken\n");
  auto enough = few;
  enough[3] = "m=100";
  const Ended two = program(enough);
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_EQ(two.err, "");
}

TEST(Cli, AFailedRunIsStatusOneWithItsCause) {
  EXPECT_EQ(solvedJson({"kepler", "--tol", "1e-10", "--max-steps", "2"}, 1)["outcome"], "max_steps");
}

TEST(Cli, ADamagedTableauFileIsStatusTwo) {
  const TemporaryFolder folder;
  const auto whole = program({"tableau", "export", "radau_iia_3"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string path = folder.path() / "method.txt";
  const auto solveWith = [&](const std::string& text) {
    std::ofstream(path) << text;
    return program({"solve", "riccati_tracking", "--method", path, "--step", "0.1"});
  };
  EXPECT_EQ(solveWith(whole.out).status, 0);

  const auto cut = solveWith(whole.out.substr(0, whole.out.size() * 2 / 3));
  EXPECT_EQ(cut.status, 2);
  EXPECT_TRUE(containsAll(cut.err, {"method.txt:"}));

  std::string lie = whole.out;
  lie.replace(lie.find("order: 5"), 8, "order: 6");
  const auto contradiction = solveWith(lie);
  EXPECT_EQ(contradiction.status, 2);
  EXPECT_TRUE(containsAll(contradiction.err, {"method.txt:", "6"}));

  std::string nan = whole.out;
  const auto number = nan.find("0.", nan.find("\nA"));
  nan.replace(number, nan.find_first_of(" \n", number) - number, "nan");
  const auto not_a_number = solveWith(nan);
  EXPECT_EQ(not_a_number.status, 2);
  EXPECT_TRUE(containsAll(not_a_number.err, {"method.txt:", "nan"}));
}

// Alexander's SDIRK method of order 3, and the same with one wrong sign.
TEST(Cli, ATableauCheckReportsTrueProperties) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "method.txt";
  const auto check = [&](const std::string& sign) {
    std::ofstream(path) << "stages: 3\norder: 3\nstage_order: 1\ndigits: 30\nA\n"
                           "0.435866521508458999416019451194 0 0\n"
                           "0.282066739245770500291990274403 0.435866521508458999416019451194 0\n"
                           "1.208496649176010070336477684063 "
                        << sign
                        << "0.644363170684469069752497135257 0.435866521508458999416019451194\nb\n"
                           "1.208496649176010070336477684063 -0.644363170684469069752497135257 "
                           "0.435866521508458999416019451194\nc\n"
                           "0.435866521508458999416019451194 0.717933260754229499708009725597 1\n";
    return program({"tableau", "check", path});
  };
  const auto right = check("-");
  EXPECT_EQ(right.status, 0);
  EXPECT_TRUE(containsAll(right.out, {"SDIRK", "degrees (2, 3)", "A-stable: yes, L-stable: yes", "0.0258971 z^4",
                                      "DEFECTIVE", "agrees with its declarations"}));
  const auto wrong = check("+");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(containsAll(wrong.out, {"row 3 of A does not sum up", "L-stable: no"}));
}

TEST(Cli, ATableauPlotDrawsAndKeepsItsNumbers) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "figure";
  const auto run = program({"tableau", "plot", "radau_iia_2", "gauss_1", "--out", out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  for (const auto* ending : {".svg", ".png", ".csv"}) {
    EXPECT_TRUE(std::filesystem::exists(out + ending)) << ending;
  }
  EXPECT_EQ(program({"tableau", "plot", "gauss_41", "--out", out}).status, 2);
}

TEST(Cli, ListsNameEverything) {
  const auto all = program({"list"});
  EXPECT_EQ(all.status, 0);
  EXPECT_TRUE(containsAll(all.out, {"slider_crank", "radau_iia_S", "cpu_time", "coupled_dense"}));
  EXPECT_EQ(program({"--help"}).status, 0);
}

TEST(Cli, HelpIsAVerb) {
  EXPECT_EQ(program({"help"}).out, program({"--help"}).out);
  EXPECT_EQ(program({"help", "solve"}).out, program({"solve", "--help"}).out);
  EXPECT_EQ(program({"help", "tableau", "show"}).out, program({"tableau", "show", "--help"}).out);
  EXPECT_NE(program({"help"}).out.find("solve"), std::string::npos);
}

// A line per scene; parameters only in the long form, or of one scene.
TEST(Cli, ListsScenesShortAndLong) {
  const auto lines = [](const Ended& run) { return std::count(run.out.begin(), run.out.end(), '\n'); };
  const auto all = program({"list", "scenes"});
  EXPECT_EQ(lines(all), static_cast<std::ptrdiff_t>(sceneCatalogue().size()));
  EXPECT_TRUE(containsAll(all.out, {"\nkepler ", "two-body problem\n"}));
  EXPECT_EQ(all.out.find("--set"), std::string::npos);
  EXPECT_GT(lines(program({"list", "scenes", "--long"})), 5 * lines(all));
  const auto one = program({"list", "scenes", "kepler"});
  EXPECT_TRUE(containsAll(one.out, {"kepler\n", "--set e="}));
  EXPECT_EQ(one.out.find("slider_crank"), std::string::npos);
}

TEST(Cli, ListsTheScenesOfACollection) {
  const auto ivp = program({"list", "scenes", "--collection", "ivp", "--long"});
  EXPECT_EQ(ivp.status, 0) << ivp.err;
  EXPECT_TRUE(containsAll(ivp.out, {"andrews\n", "unknowns: 7 second-order, 0 first-order, 6 algebraic", "index: 3",
                                    "in: ivp, multibody", "from: IVP test set, ANDREWS"}));
  EXPECT_EQ(ivp.out.find("stick_slip"), std::string::npos);
  const auto json = program({"list", "scenes", "--collection", "probes", "--json"});
  EXPECT_TRUE(containsAll(json.out, {"\"id\": \"kepler\"", "\"nu\": 2", "\"collections\""}));
  EXPECT_EQ(json.out.find("andrews"), std::string::npos);
  const auto unknown = program({"list", "scenes", "--collection", "ipv"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(containsAll(unknown.err, {"'ipv'", "'ivp'"}));
  EXPECT_EQ(program({"list", "studies", "--json"}).status, 2);
}

}  // namespace
}  // namespace irk
