// Bad command lines: each gives its exit status and one line that names the mistake, and prints nothing else. Also
// valid ones that must stay accepted.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "experiments/commands/cli.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"
#include "experiments/runs/unused_options.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// The files that the program reads in these tests.
class Lines : public testing::Test {
 protected:
  void SetUp() override {
    namespace fs = std::filesystem;
    write("file", "no study\n");
    write("refused.toml",
          "[[block]]\nscene = \"pendulum\"\nmethods = \"lobatto_iiib_3\"\nt_end = 0.1\ntolerances = 0.1\n");
    write("good.toml", "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\nt_end = 0.1\ntolerances = 0.1\n");
    write("open.toml", "[[block]]\nscene = \"kepler\"\n[\n");
    write("brace.toml", "[[block]]\nscene = [\"kepler\", }\"pendulum\"]\n");
    write("both.toml", "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\ntolerances = 0.1\nsteps = 0.1\n");
    write("quote.toml", "title = \"Mine\n[[block]]\nscene = \"kepler\"\n");
    write("range.toml",
          "[[block]]\nmethods = \"gauss_2\"\nscene = \"pendulum\"\nsettings = \"m=-1\"\ntolerances = 0.1\n");
    write("only.toml",
          "[[block]]\nname = \"a\"\nscene = \"kepler\"\nmethods = \"gauss_2\"\ntolerances = 0.1\n[[figure]]\n"
          "script = \"work_by\"\nvariant = \"method\"\nonly = \"block=b\"\n");
    write("method.txt", "stages: 1\norder: 2\nA\n0.5\nb\n1\nc\n");
    fs::create_directories(folder_.path() / "empty");
    fs::create_directories(folder_.path() / "study");
    write("study/runs.csv", "");
    fs::create_directories(folder_.path() / "endless");
    fs::create_symlink("/dev/zero", folder_.path() / "endless" / "runs.csv");
    fs::create_directories(folder_.path() / "waiting");
    ASSERT_EQ(mkfifo((folder_.path() / "waiting" / "runs.csv").c_str(), 0600), 0);
    write("large.toml", "");
    fs::resize_file(folder_.path() / "large.toml", std::uintmax_t{1} << 40U);  // takes no space on disk
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
  void expectOneLine(const std::vector<BadLine>& lines) const { irk::expectOneLine(lines, folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(Lines, Verbs) {
  expectOneLine({{2, {}, "subcommand"},
                 {2, {""}, "verb"},
                 {2, {"slove", "kepler"}, "unknown verb 'slove'; did you mean 'solve'?"},
                 {2, {"help", "slove"}, "unknown verb 'slove'; did you mean 'solve'?"},
                 {2, {"--foo"}, "--foo"},
                 {2, {"-x", "solve"}, "-x"},
                 {2, {"tableau"}, "subcommand"},
                 {2, {"tableau", "shwo", "gauss_2"}, "shwo"},
                 {2, {"tableau", "show"}, "method"},
                 {2, {"tableau", ""}, "tableau"},
                 {2, {"list", "scene"}, "unknown list 'scene'; did you mean 'scenes'?"},
                 {2, {"list", "scenes", "keplr"}, "unknown scene 'keplr'; did you mean 'kepler'?"},
                 {2, {"list", "methods", "kepler"}, "irk list methods takes no name: 'kepler'"},
                 {2, {"list", "methods", "--long"}, "--long and --json belong to: irk list scenes"},
                 {2, {"list", "scenes", "methods"}, "methods"},
                 {2, {"list", ""}, "list"},
                 {2, {"paper", "order"}, "order"},
                 {2, {"completion", "fsh"}, "fsh", {"shell", "bash, zsh, fish"}},
                 {2, {"merge"}, "folders"},
                 {2, {"compare", "@/study"}, "second"},
                 {2, {"solve"}, "scene is required"},
                 {2, {"run"}, "study"},
                 {2, {"run", "ordr"}, "unknown study or file 'ordr'; did you mean 'order'?"},
                 {2, {"plot"}, "study"},
                 {2, {"solve", "kepler", "pendulum"}, "pendulum"}});
}

TEST_F(Lines, EmptyValues) {
  std::vector<BadLine> lines;
  for (const auto& field : specFields()) {
    if (field.name == "scene" || field.name == "settings" || field.name == "h") continue;
    const std::string option = optionName(field.name);
    lines.push_back({2, {"solve", "kepler", option, ""}, option});
    lines.push_back({2, {"solve", "kepler", option + "=", "--json"}, option});
  }
  for (const std::string option : {"--tol", "--step", "--set", "--plot"}) {
    lines.push_back({2, {"solve", "kepler", option, ""}, option});
    lines.push_back({2, {"solve", "kepler", option + "="}, option});
  }
  for (const std::string option : {"--jobs", "--results", "--shard"}) {
    lines.push_back({2, {"run", "@/good.toml", option, ""}, option});
    lines.push_back({2, {"run", "@/good.toml", option + "=", "1/1"}, option});
  }
  expectOneLine(lines);
  expectOneLine({{2, {"tableau", "show", "gauss_2", "--digits", ""}, "--digits"},
                 {2, {"tableau", "plot", "gauss_2", "--out="}, "--out"},
                 {2, {"reference", "kaps", "--out", ""}, "--out"},
                 {2, {"merge", "@/study", "--study="}, "--study"},
                 {2, {"compare", "@/study", "@/study", "--times="}, "--times"},
                 {2, {"solve", "kepler", "--set", "e="}, "e="},
                 {2, {"solve", "kepler", "--set", "=0.5"}, "=0.5"},
                 {2, {"solve", ""}, "solve"},
                 {2, {"run", ""}, "run"}});
}

TEST_F(Lines, ValuesOutOfRange) {
  expectOneLine(
      {{2, {"solve", "slider_krank"}, "unknown scene 'slider_krank'; did you mean 'slider_crank'?"},
       {2,
        {"solve", "kepler", "--methd", "gauss_2"},
        "'--methd' of irk solve; did you mean '--method'? All options: irk solve --help"},
       {2, {"solve", "kepler", "--newtn=full"}, "'--newtn' of irk solve; did you mean '--newton'?"},
       {2, {"tableau", "show", "gauss_2", "--digit", "3"}, "'--digit' of irk tableau show; did you mean '--digits'?"},
       {2, {"solve", "kepler", "--method", "radau_ia_"}, "'' stages, but radau_ia has 1 to 100"},
       {2, {"solve", "kepler", "--method", "gaus_3"}, "unknown method 'gaus_3'; did you mean 'gauss_3'?"},
       {2, {"solve", "kepler", "--method", "Radau-IIA-5"}, "'Radau-IIA-5'; did you mean 'radau_iia_5'?"},
       {2, {"solve", "kepler", "--solver", "schurr"}, "unknown solver 'schurr'; did you mean 'schur'?"},
       {2, {"solve", "kepler", "--jacobian", "no_mas"}, "unknown jacobian 'no_mas'; did you mean 'no_mass'?"},
       {2, {"solve", "kepler", "--method", "gauss_0"}, "gauss_0"},
       {2, {"solve", "kepler", "--method", "gauss_101"}, "gauss_101"},
       {2, {"solve", "kepler", "--method", "a\nb"}, "a\\nb"},
       {2, {"solve", "kepler", "--method", "a\x1b[31mb"}, "\\x1b"},
       {2, {"solve", "kepler", "--newton", "simple"}, "unknown newton 'simple'; did you mean 'simplified'?"},
       {2, {"solve", "kepler", "--tol", "-2"}, "--tol = -2 is out of range: > 0"},
       {2, {"solve", "kepler", "--tol", "1e-8s"}, "--tol = '1e-8s' is not a finite number: > 0"},
       {2, {"solve", "kepler", "--tol", "nan"}, "nan"},
       {2, {"solve", "kepler", "--tol", " "}, "tol"},
       {2, {"solve", "kepler", "--tol", "1e-400"}, "1e-400"},
       {2, {"solve", "kepler", "--tol", "1e-6", "--tol", "1e-7"}, "--tol"},
       {2, {"solve", "kepler", "--tol"}, "--tol"},
       {2, {"solve", "kepler", "--step", "-0.1"}, "h = -0.1 is out of range: >= 0"},
       {2, {"solve", "kepler", "--step", "0"}, "fixed steps need h > 0"},
       {2, {"solve", "kepler", "--step", "inf"}, "inf"},
       {2, {"solve", "kepler", "--step", "0x1p-3"}, "0x1p-3"},
       {2, {"solve", "kepler", "--threads", "0"}, "threads"},
       {2, {"solve", "kepler", "--threads", "1.5"}, "1.5"},
       {2, {"solve", "kepler", "--max-steps", "0"}, "max_steps"},
       {2, {"solve", "kepler", "--t-end", "nan"}, "nan"},
       {2, {"solve", "kepler", "--set", "ee=0.5"}, "unknown parameter of kepler 'ee'; did you mean 'e'?"},
       {2, {"solve", "kepler", "--set", "e"}, "setting 'e' is not of the form name=value"},
       {2, {"solve", "kepler", "--set", "e=0.1", "--set", "e=0.2"}, "twice"},
       {2, {"solve", "kepler", "--scalar", "mp1e2"}, "mp1e2"},
       {2, {"solve", "kepler", "--scalar", "mp20"}, "scalar 'mp20': mp30 to mp1000 expected"},
       {2, {"solve", "kepler", "--digits", "1001"}, "scalar 'mp1001': mp30 to mp1000 expected"},
       {2, {"solve", "kepler", "--scalar", "mp50", "--digits", "60"}, "scalar"},
       {2, {"run", "@/good.toml", "--jobs", "-1"}, "jobs = '-1' is out of range: an integer from 0 to 1024"},
       {2, {"run", "@/good.toml", "--jobs", "1e99"}, "1e99"},
       {2, {"paper", "--jobs", "-1"}, "jobs"},
       {2, {"run", "@/good.toml", "--shard", "0/2"}, "shard"},
       {2, {"run", "@/good.toml", "--shard", "3/2"}, "shard = '3' is out of range: an integer from 1 to 2"},
       {2, {"run", "@/good.toml", "--shard", "1"}, "i/n"},
       {2, {"tableau", "show", "gauss_2", "--digits", "76"}, "76"},
       {2, {"tableau", "check", "gaus_2"}, "gaus_2"},
       {2, {"reference", "kap", "--check"}, "'kap'; did you mean 'kaps'?"},
       {2, {"compare", "@/study", "@/study", "--alpha", "1"}, "alpha"}});
}

TEST_F(Lines, OptionsWithoutEffect) {
  expectOneLine(
      {{2, {"solve", "kepler", "--step", "0.1", "--tol", "1e-6"}, "step and tol: fixed steps have no tolerance"},
       {2, {"solve", "kepler", "--step", "0.1", "--rtol", "1e-6"}, "--rtol"},
       {2, {"solve", "kepler", "--step", "0.1", "--atol", "1e-6"}, "--atol"},
       {2, {"solve", "kepler", "--step", "0.1", "--norm", "absolute"}, "--norm"},
       {2, {"solve", "kepler", "--step", "0.1", "--kappa", "0.1"}, "--kappa"},
       {2, {"solve", "kepler", "--step", "0.1", "--h-max", "0.1"}, "--h-max"},
       {2, {"solve", "kepler", "--step", "0.1", "--estimate", "doubling"}, "--estimate"},
       {2, {"solve", "kepler", "--tol", "0.1", "--rtol", "0.1", "--atol", "0.1"}, "--tol"},
       {2, {"solve", "kepler", "--max-stages", "5"}, "--max-stages"},
       {2, {"solve", "kepler", "--residual-tolerance", "0.1"}, "--residual-tolerance"},
       {2, {"solve", "kepler", "--contractivity-limit", "0.1"}, "--contractivity-limit"},
       {2, {"solve", "kepler", "--contractivity-after", "1"}, "--contractivity-after"},
       {2, {"solve", "kepler", "--newton", "modified", "--kappa", "0.1"}, "--kappa"},
       {2, {"solve", "kepler", "--newton", "modified", "--keep-jacobian-below", "0.1"}, "--keep-jacobian-below"},
       {2, {"reference", "kaps"}, "--into-sources"},
       {2, {"reference", "kaps", "--out", "@", "--into-sources"}, "--into-sources"},
       {2, {"reference", "kaps", "--check", "--into-sources"}, "--check"}});
}

TEST_F(Lines, Combinations) {
  expectOneLine(
      {{2, {"solve", "kepler", "--control", "fixed"}, "fixed steps need h > 0"},
       {2, {"solve", "kepler", "--estimate", "none"}, "control 'predictive' with estimate 'none'"},
       {2, {"solve", "kepler", "--newton", "full", "--solver", "schur"}, "newton 'full' with solver 'schur'"},
       {2, {"solve", "pendulum", "--method", "lobatto_iiib_3"}, "with a system of 1 algebraic unknowns"},
       {2, {"solve", "stick_slip", "--t-end", "-1"}, "t_end lies before the start, and the system has 3 swit"},
       {2, {"solve", "kepler", "--t-end", "-1", "--method", "cvode_bdf"}, "t_end = -1 lies before the start"}});
}

// Every field of a run is either used by peers or refused with them.
TEST_F(Lines, PeersRefuseWhatTheyDoNotTake) {
  const auto& taken = peerFields();
  std::size_t refused = 0;
  for (const auto& field : specFields()) {
    const bool listed = std::find(taken.begin(), taken.end(), field.name) != taken.end();
    if (listed || field.name == "scene" || field.name == "settings" || field.name == "h") continue;
    const std::string option = optionName(field.name);
    const std::string given = field.get(RunSpec{}), value = given.empty() ? "impact" : given;
    for (const std::string peer : {"cvode_bdf", "ida_bdf", "gsl_msbdf"}) {
      expectOneLine({{2, {"solve", "kepler", "--method", peer, option, value}, option + " has no effect"}});
    }
    ++refused;
  }
  EXPECT_GT(refused, 0u);
}

TEST_F(Lines, Files) {
  expectOneLine({{2, {"run", "/dev/zero"}, "/dev/zero"},
                 {2, {"run", "@/waiting/runs.csv"}, "pipe"},
                 {2, {"run", "@/empty"}, "folder"},
                 {2, {"run", "@/large.toml"}, "too long"},
                 {2, {"run", "@/no.toml"}, "no.toml: there is no such file"},
                 {2, {"run", "@/nowhere/order"}, "nowhere/order: there is no such file"},
                 {2, {"run", "@/file"}, "file:1"},
                 {2, {"run", "@/file/below"}, "below"},
                 {2, {"run", "@/open.toml"}, "open.toml:3"},
                 {2, {"run", "@/brace.toml"}, "brace.toml:2"},
                 {2, {"run", "@/both.toml"}, "both.toml:5"},
                 {2, {"run", "@/quote.toml"}, "quote.toml:1: a text without its closing quote"},
                 {2, {"run", "@/range.toml"}, "range.toml:3: scene pendulum: parameter m = '-1' must be a number in ["},
                 {2, {"run", "@/only.toml"}, "only.toml:9: only: unknown block 'b'"},
                 {2, {"run", std::string(5000, 'x')}, "xxx"},
                 {2, {"run", "@/good.toml", "--results", "@/file"}, "file"},
                 {2, {"run", "@/good.toml", "--results", "/dev/full"}, "/dev/full"},
                 {2, {"tableau", "check", "/dev/zero"}, "/dev/zero"},
                 {2, {"tableau", "check", "@/waiting/runs.csv"}, "pipe"},
                 {2, {"tableau", "show", "@/empty"}, "folder"},
                 {2, {"tableau", "check", "@/large.toml"}, "too long"},
                 {2, {"tableau", "check", "@/no.txt"}, "no.txt"},
                 {2, {"tableau", "check", "@/method.txt"}, "method.txt:7"},
                 {2, {"tableau", "export", "@/method.txt"}, "method.txt:7"},
                 {2, {"solve", "kepler", "--method", "/dev/zero"}, "/dev/zero"},
                 {2, {"solve", "kepler", "--method", "@/waiting/runs.csv"}, "pipe"},
                 {2, {"merge", "@/empty"}, "runs.csv"},
                 {2, {"merge", "@/nowhere"}, "nowhere: a folder of a study is expected"},
                 {2, {"merge", "@/endless"}, "device"},
                 {2, {"merge", "@/waiting"}, "pipe"},
                 {2, {"merge", "@/study"}, "runs.csv"},
                 {2, {"compare", "@/empty", "@/study"}, "empty"},
                 {2, {"compare", "@/file", "@/study"}, "file"},
                 {2, {"compare", "@/study", "@/nowhere"}, "nowhere"}});
}

TEST_F(Lines, FiguresAndReports) {
  expectOneLine({{2, {"plot", "nosuch"}, "nosuch"},
                 {2, {"plot", "drift", "--results", "@/nowhere"}, "nowhere"},
                 {2, {"plot", "drift", "--results", "@/file"}, "file"},
                 {1, {"plot", "drift", "--results", "@/empty"}, "irk run drift"},
                 {1, {"plot", "tableaus", "--results", "@/empty"}, "irk tableau table"},
                 {2, {"report", "--results", "@/nowhere"}, "nowhere"},
                 {2, {"report", "--results", "@/file"}, "file"},
                 {1, {"report", "--results", "@/empty"}, "no tables"},
                 {2, {"claims", "--results", "@/nowhere"}, "nowhere"},
                 {2, {"claims", "--results", "@/file"}, "file"},
                 {2, {"solve", "kepler", "--plot", "@/nowhere/figure"}, "nowhere"},
                 {2, {"solve", "kepler", "--plot", "@/file/figure"}, "file"},
                 {2, {"solve", "kepler", "--plot", "@/empty/"}, "--plot"},
                 {2, {"solve", "kepler", "--plot", "@/a'.'b"}, "--plot"},
                 {2, {"solve", "kepler", "--plot", "@/$(touch x)"}, "--plot"},
                 {2, {"tableau", "plot", "gauss_2", "--out", "@/nowhere/figure"}, "nowhere"},
                 {2, {"tableau", "plot", "gauss_2", "--out", "@/a\"b"}, "--out"}});
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "empty")) << "nothing is left behind";
}

TEST_F(Lines, AStudyOfRefusedRunsFails) {
  const Ended ended = program(withFolder({"run", "@/refused.toml", "--results", "@/results"}, folder_.path()));
  EXPECT_EQ(ended.status, 1) << ended.out << ended.err;
  EXPECT_TRUE(containsAll(ended.err, {"irk: refused: all 1 runs were refused", "lobatto_iiib_3"}));
}

TEST_F(Lines, OutputThatCannotBeWrittenIsAFailure) {
  for (const Line& line : {Line{"list", "scenes"}, Line{"--help"}, Line{"--version"},
                           Line{"tableau", "show", "gauss_2"}, Line{"solve", "kepler", "--t-end", "0.1"}}) {
    std::ofstream full("/dev/full");
    std::ostringstream err;
    EXPECT_EQ(runProgram(line, {full, err}), 1) << line[0];
    EXPECT_EQ(err.str(), "irk: the output cannot be written: is the disk full?\n") << line[0];
  }
}

TEST_F(Lines, GoodLinesStayGood) {
  const std::vector<Line> lines = {
      {"--help"},
      {"--version"},
      {"solve", "--help"},
      {"tableau", "show", "--help"},
      {"list", "studies"},
      {"solve", "kepler", "--t-end=0.1", "--tol=1e-3"},
      {"solve", "kepler", "--t-end", "0.1", "--set", "e=0.5", "--json"},
      {"solve", "kepler", "--t-end", "0.1", "--rtol", "1e-3", "--atol", "1e-4"},
      {"solve", "kepler", "--t-end", "0.1", "--tol", "1e-3", "--atol", "1e-4"},
      {"solve", "kepler", "--t-end", "0.1", "--step", "0.05", "--estimate", "none"},
      {"solve", "kepler", "--t-end", "0.1", "--step", "0.05", "--control", "paper", "--tol", "1e-3"},
      {"solve", "kepler", "--t-end", "0.1", "--newton", "modified", "--residual-tolerance", "1e-8"},
      {"solve", "kepler", "--t-end", "0.1", "--configuration", "variable", "--max-stages", "5"},
      {"solve", "kepler", "--t-end", "0.1", "--configuration", "paper", "--contractivity-limit", "0.5"},
      {"solve", "kepler", "--t-end", "0.1", "--method", "cvode_bdf", "--tol", "1e-4", "--h-max", "0.1"},
      {"solve", "kepler", "--t-end", "0.1", "--method", "cvode_bdf", "--step", "0.001", "--tol", "1e-4"},
      {"solve", "pendulum", "--t-end", "0.1", "--method", "ida_bdf", "--formulation", "ggl", "--multipliers", "stages"},
      {"run", "@/good.toml", "--quick", "--jobs=1", "--results=@/results"},
      {"run", "@/good.toml", "--shard", "1/2", "--results", "@/results"},
      {"compare", "@/results/good", "@/results/good", "--times=10%"},
      {"claims", "--results", "@/results"},
      {"tableau", "table", "--help"},
      {"reference", "kaps", "--check"}};
  for (const auto& line : lines) {
    std::string text;
    for (const auto& argument : line) text += argument + " ";
    const Ended ended = program(withFolder(line, folder_.path()));
    EXPECT_EQ(ended.status, 0) << text << ended.err << ended.out;
  }
}

}  // namespace
}  // namespace irk
