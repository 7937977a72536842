// The explorer's page and its data; tests/browser opens it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/report/explorer/explorer.h"
#include "experiments/report/explorer/explorer_data.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/store.h"
#include "experiments/study/run_command.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

using Json = nlohmann::json;

std::string dataOf(const std::filesystem::path& results) {
  std::ostringstream out;
  writeExplorerData(results, out);
  return out.str();
}

std::vector<std::string> wordsOf(const std::string& command) {
  std::istringstream in(command);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  words.erase(words.begin());  // irk
  return words;
}

// Peers, configurations, settings that are words, fixed steps, options of strategies, an end of its own.
constexpr char kAllKinds[] = R"(
[defaults]
max_steps = 200_000

[[block]]
scene = "van_der_pol"
t_end = 0.1
methods = ["radau_iia_3", "cvode_bdf"]
tolerances = [1e-3, 1e-5]
[[block]]
scene = "van_der_pol"
configuration = "variable"
t_end = 0.1
methods = "radau_iia"
tolerances = [1e-3, 1e-5]
[[block]]
scene = "bouncing_mass"
configuration = "paper"
methods = "gauss_2"
t_end = 0.25
time_limit = 3
tolerances = [1e-3, 1e-5]
[[block]]
scene = "slider_crank"
settings = "torque_off_at=0.05"
t_end = 0.1
formulation = "index1"
methods = ["radau_iia_2", "ida_bdf"]
tolerances = [1e-3, 1e-5]
[[block]]
scene = "kepler"
settings = "e=0.1"
t_end = 0.5
steps = [0.1, 0.05]
newton = "broyden"
methods = "lobatto_iiic_3"
[[block]]
scene = "pendulum"
methods = "radau_iia_3"
tolerances = 1e-3
solver = "eigen"
predictor = "previous"
kappa = 0.02
)";

TEST(RunCommand, MakesTheRunOfItsRowAgain) {
  const Table runs = runsOf(kAllKinds).runs;
  ASSERT_GE(runs.rows.size(), 14u);
  for (const auto& row : runs.rows) {
    ASSERT_NE(textAt(runs, row, "outcome"), "refused") << textAt(runs, row, "detail");
    const std::string command = seriesCommand(runs, row).text + sweptOptions(runs, row);
    auto words = wordsOf(command);
    words.emplace_back("--json");
    const auto ended = program(words);
    ASSERT_TRUE(ended.out.starts_with("{")) << command << ": " << ended.err;
    const Json made = Json::parse(ended.out);
    EXPECT_EQ(made["outcome"], textAt(runs, row, "outcome")) << command;
    EXPECT_EQ(made["counters"]["residuals"], std::stoll(textAt(runs, row, "residuals"))) << command;
    for (const auto& [field, value] : made["spec"].items()) {
      if (field == "settings") continue;  // an object there, text here
      if (textAt(runs, row, "integrator") == textAt(runs, row, "method") && field == "configuration") continue;
      const std::string text = textAt(runs, row, field);
      if (value.is_number()) {
        EXPECT_EQ(value.get<double>(), std::stod(text)) << field << " of " << command;
      } else {
        EXPECT_EQ(value, text) << field << " of " << command;
      }
    }
  }
}

TEST(RunCommand, SaysNothingThatIsUsualAndQuotesForTheShell) {
  Table runs{{}, runColumns(), {}};
  TableRow row(runs.columns.size());
  const RunSpec usual;
  for (const auto& field : specFields()) row[runs.column(field.name)] = field.get(usual);
  const auto put = [&](const char* column, const char* text) { row[runs.column(column)] = text; };
  put("scene", "nobody's scene");
  put("integrator", "default:radau_iia_5");
  put("rtol", "1e-06");
  put("atol", "1e-06");
  put("kappa", "0.1");
  put("t_end", "3");
  const auto command = seriesCommand(runs, row);
  EXPECT_EQ(command.text, "irk solve 'nobody'\\''s scene' --method radau_iia_5 --kappa 0.1 --error-bar none --t-end 3");
  EXPECT_EQ(sweptOptions(runs, row), " --tol 1e-06");
  ASSERT_EQ(command.options.size(), 1u);
  EXPECT_EQ(command.options.front().first, "kappa");
}

// A table as `peers` has it: two solvers on one scene, a failure, a wrong success.
Table madeUp() {
  Table runs{{{"study", "peers"}}, runColumns(), {}};
  const RunSpec usual;
  const auto add = [&](const char* method, const char* integrator, const char* tol, const char* outcome,
                       const char* error) {
    TableRow row(runs.columns.size(), "nan");
    for (const auto& field : specFields()) row[runs.column(field.name)] = field.get(usual);
    const auto put = [&](const char* column, const std::string& text) { row[runs.column(column)] = text; };
    put("scene", "van_der_pol");
    put("settings", "");
    put("method", method);
    put("family", std::string(method).starts_with("radau") ? "radau_iia" : method);
    put("integrator", integrator);
    put("rtol", tol);
    put("atol", tol);
    put("outcome", outcome);
    put("error", error);
    put("error_u", error);
    put("error_z", "1");  // multipliers are not judged
    put("cpu_s", "0.00123456");
    put("detail", "a < b @D3@ </script>");
    runs.rows.push_back(row);
  };
  add("radau_iia_5", "default:radau_iia_5", "1e-4", "success", "0.0999");
  add("radau_iia_5", "default:radau_iia_5", "1e-6", "success", "0.0011");
  add("cvode_bdf", "cvode_bdf", "1e-4", "success", "0.11");
  add("cvode_bdf", "cvode_bdf", "1e-6", "timeout", "nan");
  return runs;
}

// Digits are drawn as the errors that they count.
TEST(ExplorerData, HasTheDigitsOfTheIvpTestSet) {
  const TemporaryFolder folder;
  Table runs = madeUp();
  runs.rows[0][runs.column("mescd")] = "2";
  runs.rows[0][runs.column("scd")] = "1.5";
  std::filesystem::create_directories(folder.path() / "peers");
  writeTable(folder.path() / "peers" / "runs.csv", runs);
  const Json data = Json::parse(dataOf(folder.path()))["runs"];
  EXPECT_DOUBLE_EQ(data["error_mescd"][0].get<double>(), 0.01);
  EXPECT_DOUBLE_EQ(data["error_scd"][0].get<double>(), 0.03162);
  EXPECT_TRUE(data["error_mescd"][1].is_null());
}

TEST(ExplorerData, HasNoTimesOfSeveralProcessors) {
  const TemporaryFolder folder;
  Table runs = madeUp();
  const auto file = folder.path() / "peers" / "runs.csv";
  std::filesystem::create_directories(file.parent_path());
  writeTable(file, runs);
  EXPECT_TRUE(Json::parse(dataOf(folder.path()))["runs"].contains("cpu_s"));
  runs.head.emplace_back(store::kTimesRefused, "two processors");
  writeTable(file, runs);
  const Json data = Json::parse(dataOf(folder.path()));
  EXPECT_FALSE(data["runs"].contains("cpu_s"));
  EXPECT_NE(data["studies"][0]["no_times"], "");
}

class ExplorerPage : public testing::Test {
 protected:
  ExplorerPage() {
    std::filesystem::create_directories(results() / "peers");
    writeTable(results() / "peers" / "runs.csv", madeUp());
  }
  std::filesystem::path results() const { return folder_.path() / "quick"; }
  std::optional<std::filesystem::path> write(const std::filesystem::path& library) {
    err_.str("");
    return writeExplorer({results(), IRK_SOURCE_DIR}, err_, library);
  }

  TemporaryFolder folder_;
  std::ostringstream err_;
};

TEST_F(ExplorerPage, HasRunsSeriesAndJudgements) {
  const Json data = Json::parse(dataOf(results()));
  ASSERT_EQ(data["studies"].size(), 1u);
  EXPECT_EQ(data["studies"][0]["id"], "peers");
  ASSERT_EQ(data["series"].size(), 2u);
  EXPECT_EQ(data["series"][0]["family"], "radau_iia");
  EXPECT_EQ(data["series"][0]["peer"], false);
  EXPECT_EQ(data["series"][1]["family"], "cvode_bdf");
  EXPECT_EQ(data["series"][1]["peer"], true);
  const Json& runs = data["runs"];
  EXPECT_EQ(runs["series"], Json({0, 0, 1, 1}));
  // The bar is 1000 tolerances: 0.1 for 1e-4, 0.001 for 1e-6. A failure is not a wrong success.
  EXPECT_EQ(runs["wrong"], Json({0, 1, 1, 0}));
  EXPECT_EQ(runs["error"], Json({0.0999, 0.0011, 0.11, nullptr}));
  EXPECT_EQ(runs["cpu_s"][0], 0.001235);
  EXPECT_EQ(data["words"]["outcome"], Json({"success", "timeout"}));
  EXPECT_EQ(runs["outcome"], Json({0, 0, 0, 1}));
  for (const auto& [name, values] : runs.items()) EXPECT_EQ(values.size(), 4u) << name;
}

TEST_F(ExplorerPage, IsOneFileWithItsDataAndItsLibrary) {
  const auto library = folder_.path() / "d3.js";
  std::ofstream(library) << "/* a library */";
  const auto path = write(library);
  ASSERT_TRUE(path) << err_.str();
  const std::string page = readInputFile(*path);
  EXPECT_TRUE(containsAll(
      page, {"/* a library */", "A quick run", "<noscript>", "href=\"../peers/runs.csv\"", "\\u003c/script>"}));
  for (const auto* placeholder : {"@DATA@", "@D3@", "@BANNER@", "@DATE@", "@TABLES@"}) {
    EXPECT_EQ(page.find(placeholder), page.npos) << placeholder;
  }
  for (const auto* remote : {"src=\"http", "<link", "import "}) EXPECT_EQ(page.find(remote), page.npos) << remote;
  EXPECT_EQ(err_.str(), "");
}

TEST_F(ExplorerPage, IsLeftOutWithoutTheLibrary) {
  const auto library = folder_.path() / "d3.js";
  std::ofstream(library) << "/* a library */";
  const auto path = write(library);
  ASSERT_TRUE(path);
  std::filesystem::remove(library);
  EXPECT_FALSE(write(library));
  EXPECT_TRUE(containsAll(err_.str(), {"explorer", "node-d3"}));
  const std::string message = err_.str();
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(*path)) << "an older page has older runs";
}

}  // namespace
}  // namespace irk
