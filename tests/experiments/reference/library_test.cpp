// References of runs: which runs get one, the cache, sweeps.
#include "experiments/reference/library.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/reference/cache.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/program.h"
#include "tests/experiments/reference/own_cache.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

using ReferenceLibraryTest = WithOwnCache;

RunSpec spec(const std::string& text) { return resolved(parseSpec(text)); }

// Nothing is stored for this time. The reference takes a fraction of a second.
const std::string kUnknown = "scene=mechanical_dae;t_end=0.02;rtol=1e-6;atol=1e-6;reference=auto";

std::string value(const MadeReference& reference, std::size_t i) { return reference.values.at(i).value; }

TEST(NeedsReference, WhereNothingIsStored) {
  EXPECT_TRUE(needsReference(spec(kUnknown)));
  EXPECT_FALSE(needsReference(spec("scene=mechanical_dae;t_end=0.02"))) << "not asked for";
  EXPECT_FALSE(needsReference(spec("scene=mechanical_dae;reference=auto"))) << "a file has the scene's end";
  EXPECT_FALSE(needsReference(spec("scene=mechanical_dae;t_end=0.25;reference=auto"))) << "and this time";
  EXPECT_FALSE(needsReference(spec("scene=kaps;t_end=0.123;reference=auto"))) << "exact";
  EXPECT_TRUE(needsReference(spec("scene=slider_crank;settings=m1=0.3;reference=auto"))) << "other settings";
  EXPECT_TRUE(needsReference(spec("scene=bouncing_mass;discontinuity=smooth;reference=auto")))
      << "the exact solution is not that of the regularized problem";
  EXPECT_FALSE(needsReference(spec("scene=bouncing_mass;discontinuity=ignore;reference=auto")));
}

TEST_F(ReferenceLibraryTest, IsMadeOnceAndThenRead) {
  std::vector<std::string> lines;
  const ReferenceLibrary::Options options{.tell = [&](const std::string& line) { lines.push_back(line); }};
  ReferenceLibrary first(options);
  const auto made = first.of(spec(kUnknown));
  ASSERT_EQ(made.values.size(), 5u) << made.problem;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(containsAll(lines[0], {"reference mechanical_dae, t = 0.02: ", " digits, ", " s"}));
  EXPECT_EQ(lines[0].find("double"), std::string::npos);
  static_cast<void>(first.of(spec(kUnknown)));
  ReferenceLibrary second(options);
  const auto read = second.of(spec(kUnknown));
  EXPECT_EQ(lines.size(), 1u) << "neither the same process nor the next one makes it again";
  ASSERT_EQ(read.values.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(value(read, i), value(made, i));
    EXPECT_EQ(read.values[i].component, made.values[i].component);
    EXPECT_EQ(read.values[i].accuracy, made.values[i].accuracy);
  }
  ASSERT_EQ(cached().size(), 1u);
}

TEST_F(ReferenceLibraryTest, ADamagedFileIsMadeAgain) {
  const auto question = referenceQuestion(spec(kUnknown));
  keepReference(question, makeReferences({question}, {}, {}).front());
  ASSERT_EQ(cached().size(), 1u);
  const auto file = cached().front();
  const std::string good = readInputFile(file);
  ASSERT_TRUE(keptReference(question));
  const auto lastDigit = good.find_last_of("0123456789", good.find(',', good.find(",0.02,x,") + 8));
  std::string digit = good;
  digit[lastDigit] = digit[lastDigit] == '1' ? '2' : '1';
  std::string other = good;
  other.replace(other.find("t_end=0.02"), 10, "t_end=0.03");
  for (const std::string& damaged : {digit, other, std::string(), std::string("\0\xff,", 3), good.substr(0, 400),
                                     good.substr(0, good.size() - 3), good.substr(0, good.rfind("\nmech") + 1)}) {
    ASSERT_NE(damaged, good);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_FALSE(keptReference(question)) << damaged;
    std::vector<std::string> lines;
    ReferenceLibrary library({.tell = [&](const std::string& line) { lines.push_back(line); }});
    EXPECT_EQ(library.of(spec(kUnknown)).values.size(), 5u);
    EXPECT_EQ(lines.size(), 1u) << "made again";
    EXPECT_TRUE(keptReference(question)) << "and kept";
  }
}

TEST_F(ReferenceLibraryTest, TheReasonWhyThereIsNoneIsKeptToo) {
  std::vector<std::string> lines;
  ReferenceLibrary::Options options{.tell = [&](const std::string& line) { lines.push_back(line); }};
  options.limits.disagreement = 1e-45;
  for (int turn = 0; turn < 2; ++turn) {
    ReferenceLibrary library(options);
    const auto none = library.of(spec(kUnknown));
    EXPECT_TRUE(none.values.empty());
    EXPECT_TRUE(containsAll(none.problem, {"no reference: in 50 digits the four runs disagree"}));
  }
  ASSERT_EQ(lines.size(), 2u) << "each time one line";
  EXPECT_EQ(lines[0], lines[1]);
  Watch watch;
  watch.reference = [&](const RunSpec& s) { return ReferenceLibrary(options).of(s); };
  const auto run = execute(spec(kUnknown), watch);
  EXPECT_TRUE(run.succeeded());
  EXPECT_TRUE(std::isnan(run.errors.all));
  EXPECT_TRUE(containsAll(run.errors.remark, {"no reference: ", "disagree"}));
}

TEST_F(ReferenceLibraryTest, IsUsedThoughItCannotBeKept) {
  const auto file = folder() / "file";
  std::ofstream(file) << "not a folder";
  setenv("IRK_CACHE", file.c_str(), 1);
  std::vector<std::string> lines;
  ReferenceLibrary library({.tell = [&](const std::string& line) { lines.push_back(line); }});
  EXPECT_EQ(library.of(spec(kUnknown)).values.size(), 5u);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(containsAll(lines[1], {"not kept", "file"}));
}

TEST_F(ReferenceLibraryTest, AnInterruptedOneIsNotKept) {
  const std::atomic<bool> stop = true;
  ReferenceLibrary library({.stop = &stop});
  EXPECT_TRUE(library.of(spec(kUnknown)).values.empty());
  EXPECT_TRUE(cached().empty());
}

TEST_F(ReferenceLibraryTest, SolveHasAnErrorWithTheFlagOnly) {
  const std::vector<std::string> arguments{"solve",    "mechanical_dae", "--t-end", "0.02",
                                           "--method", "radau_iia_2",    "--tol",   "1e-4"};
  const auto with = [&](std::vector<std::string> more) {
    auto all = arguments;
    all.insert(all.end(), more.begin(), more.end());
    return program(all);
  };
  EXPECT_TRUE(containsAll(with({}).out, {"error unknown: no reference at t = 0.02; --reference makes one"}));
  EXPECT_TRUE(cached().empty());
  const auto first = with({"--reference", "--json"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(containsAll(first.err, {"reference mechanical_dae, t = 0.02: "}));
  const auto json = nlohmann::json::parse(first.out);
  EXPECT_EQ(json["reference"], "computed");
  EXPECT_LT(json["reference_accuracy"].get<double>(), 1e-22);
  // The difference to a run of another method with a far smaller tolerance, at which the error is negligible.
  const auto fine = execute(spec("scene=mechanical_dae;t_end=0.02;scalar=mp50;method=gauss_6;rtol=1e-16;atol=1e-16"));
  const auto coarse = execute(spec("scene=mechanical_dae;t_end=0.02;method=radau_iia_2;rtol=1e-4;atol=1e-4"));
  const Vec<double> scale = makeScene<double>("mechanical_dae").scale;
  double largest = 0;
  const auto compare = [&](const Vec<double>& a, const Vec<double>& b, Index from) {
    for (Index i = 0; i < a.size(); ++i) {
      const double size = from + i < scale.size() ? scale[from + i] : 1;
      largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(std::abs(b[i]), size));
    }
  };
  compare(coarse.u, fine.u, 0);
  compare(coarse.v, fine.v, 2);
  compare(coarse.z, fine.z, 4);
  ASSERT_GT(largest, 1e-12);
  EXPECT_NEAR(json["error"].get<double>(), largest, 1e-3 * largest);
  const auto second = with({"--reference"});
  EXPECT_TRUE(second.err.empty()) << second.err;
  EXPECT_TRUE(containsAll(second.out, {"\nerror "}));
  EXPECT_EQ(cached().size(), 1u);
}

// Standard error as a terminal, while one lives.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)), before_(dup(STDERR_FILENO)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no terminal");
    const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY);
    dup2(slave, STDERR_FILENO);
    close(slave);
  }
  ~Terminal() {
    dup2(before_, STDERR_FILENO);
    close(before_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  /// What was printed, up to 64 kB.
  std::string text() const {
    std::string text(65536, '\0');
    fcntl(master_, F_SETFL, O_NONBLOCK);
    std::size_t length = 0;
    for (ssize_t n = 0; (n = read(master_, text.data() + length, text.size() - length)) > 0;) {
      length += static_cast<std::size_t>(n);
    }
    text.resize(length);
    return text;
  }

 private:
  int master_, before_;
};

TEST_F(ReferenceLibraryTest, OnlyATerminalSeesHowFarItIs) {
  const std::vector<std::string> arguments{"solve",       "mechanical_dae",    "--t-end", "0.02",
                                           "--method",    "radau_iia_2",       "--tol",   "1e-4",
                                           "--reference", "--reference-times", "2"};
  const auto silent = program(arguments);
  EXPECT_EQ(std::count(silent.err.begin(), silent.err.end(), '\n'), 1) << silent.err;
  EXPECT_TRUE(silent.err.starts_with("reference mechanical_dae, t = 0.01 ... 0.02 (2 times): ")) << silent.err;
  std::filesystem::remove_all(folder() / "references");
  const Terminal terminal;
  std::ostringstream out;
  EXPECT_EQ(runProgram(arguments, {out, std::cerr}), 0);
  const std::string seen = terminal.text();
  const std::string line = "\r\033[Kreference mechanical_dae, t = 0.01 ... 0.02 (2 times): ";
  EXPECT_TRUE(containsAll(seen, {line + "in 50 digits, 0:0", " of CPU time, at most 1:00", line + "3", " digits, "}));
}

TEST_F(ReferenceLibraryTest, SolveReportsErrorsThatAreNotMeasurable) {
  std::vector<std::string> arguments{"solve",    "mechanical_dae", "--t-end", "0.02",  "--scalar",   "mp50",
                                     "--method", "radau_iia_16",   "--tol",   "1e-30", "--reference"};
  const auto run = program(arguments);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<std::string> parts{"error below ", "ten times the reference's accuracy: not measurable"};
  EXPECT_TRUE(containsAll(run.out, parts));
  arguments.emplace_back("--json");
  const auto json = nlohmann::json::parse(program(arguments).out);
  EXPECT_TRUE(json["error"].is_null());
  EXPECT_TRUE(containsAll(json["error_remark"].get<std::string>(), parts));
}

constexpr std::string_view kLibraryStudy = R"(
targets = [1e-3, 1e-6]
[[block]]
scene = "mechanical_dae"
t_end = [0.02, 0.03]
methods = ["radau_iia_2", "gauss_2", "cvode_bdf"]
formulation = "index1"
tolerances = [1e-4, 1e-6, 1e-8]
)";

TEST_F(ReferenceLibraryTest, SweepsMakeEachOnceAndHaveErrors) {
  const auto without = runsOf(kLibraryStudy);
  for (const auto& row : without.runs.rows) EXPECT_TRUE(std::isnan(numberAt(without.runs, row, "error")));
  EXPECT_TRUE(cached().empty());
  const auto with = runsOf(std::string(kLibraryStudy) + "reference = \"auto\"\n");
  EXPECT_EQ(cached().size(), 2u) << "one for each t_end";
  ASSERT_EQ(with.runs.rows.size(), 18u);
  for (std::size_t i = 0; i < with.runs.rows.size(); ++i) {
    const auto& row = with.runs.rows[i];
    ASSERT_TRUE(succeededAt(with.runs, row)) << textAt(with.runs, row, "detail");
    const double tolerance = numberAt(with.runs, row, "rtol"), error = numberAt(with.runs, row, "error");
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 100 * tolerance) << textAt(with.runs, row, "method");
    EXPECT_EQ(textAt(with.runs, row, "reference"), "auto");
    EXPECT_LT(numberAt(with.runs, row, "reference_accuracy"), 1e-20);
    const auto& other = without.runs.rows[i];
    EXPECT_EQ(textAt(with.runs, row, "residuals"), textAt(without.runs, other, "residuals")) << "the same run";
    EXPECT_NE(textAt(with.runs, row, "key"), textAt(without.runs, other, "key")) << "made again for its error";
  }
}

TEST_F(ReferenceLibraryTest, FinishedSweepsNeedNone) {
  const TemporaryFolder results;
  RunnerOptions options;
  options.results = results.path();
  options.jobs = 1;
  const Study study =
      parseStudy(std::string(kLibraryStudy) + "reference = \"auto\"\n", "small.toml", StudyVariant::kFull);
  std::ostringstream first, second;
  static_cast<void>(runStudy(study, options, first));
  EXPECT_TRUE(containsAll(
      first.str(), {"small references: 2 runs made", "reference mechanical_dae, t = 0.02 ... 0.03 (2 times): "}));
  std::filesystem::remove_all(folder() / "references");
  static_cast<void>(runStudy(study, options, second));
  EXPECT_TRUE(cached().empty());
  EXPECT_EQ(second.str().find("reference"), std::string::npos) << second.str();
}

TEST(ReferenceKeyOfStudies, RefusesOtherWords) {
  const std::string start = "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\n";
  const auto message = misuseOf(
      [&] { parseStudy(start + "tolerances = 1e-4\nreference = \"atuo\"\n", "mine.toml", StudyVariant::kFull); });
  EXPECT_TRUE(containsAll(message, {"mine.toml:5", "reference", "atuo", "did you mean 'auto'"}));
  const Study all = parseStudy("[defaults]\nreference = \"auto\"\n" + start, "mine.toml", StudyVariant::kFull);
  EXPECT_EQ(all.series.front().runs.front().reference, ReferenceUse::kAuto);
}

}  // namespace
}  // namespace irk
