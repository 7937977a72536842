// A user's files through the program, in processes of their own: what is registered stays in a process.
#include "tests/experiments/own/own_files.h"
#include "experiments/own/compiler.h"
#include "experiments/runs/run_table.h"

namespace irk {
namespace {

// x'' = -x, x(0) = 1 is exact, and has no other reference.
constexpr const char* kOscillator = R"(#include <irk/scene_file.h>
#include "stiffness.h"
using namespace irk;
template <class Real>
struct Oscillator {
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const { r.u[0] = p.a[0] + kStiffness * p.u[0]; }
  static SceneEntry entry() {
    return {.id = "oscillator", .title = "t", .shows = "s", .parameters = {textParameter("file", "a file", "none")}};
  }
  static Scene<Real> make(const Settings&) {
    Scene<Real> scene;
    setProblem(scene, Oscillator{});
    setComponents(scene, {{"x", "m"}});
    scene.start.u << Real(1);
    scene.exact = [](const Real& t) {
      using std::cos;
      using std::sin;
      State<Real> s(Oscillator{}.sizes());
      s.t = t;
      s.u << cos(t);
      s.v << -sin(t);
      return s;
    };
    return scene;
  }
};
IRK_SCENE(Oscillator)
)";

TEST_F(OwnFiles, AreCompiledOnceAndAnewWhenAnIncludedFileChanges) {
  write("oscillator.cpp", kOscillator);
  write("stiffness.h", "constexpr double kStiffness = 1;\n");
  const std::string solve = "solve oscillator.cpp --method gauss_5 --tol 1e-10 --set file=a.txt";
  const Ran first = irk(solve);
  EXPECT_EQ(first.status, 0) << first.text;
  EXPECT_TRUE(containsAll(first.text, {"compiling oscillator.cpp", "0.54030230", "file=a.txt"}));
  const Ran second = irk(solve);
  EXPECT_EQ(second.text.find("compiling"), std::string::npos) << second.text;
  write("stiffness.h", "constexpr double kStiffness = 4;\n");
  const Ran changed = irk(solve);
  EXPECT_TRUE(containsAll(changed.text, {"compiling oscillator.cpp", "-0.416146"}));  // cos 2
  // 50 digits are compiled when a run asks for them.
  write("stiffness.h", "constexpr double kStiffness = 1;\n");
  const Ran digits = irk("solve oscillator.cpp --method gauss_10 --tol 1e-30 --scalar mp50");
  EXPECT_TRUE(containsAll(digits.text, {"in 50 digits", "0.54030230586813971740093660744297"}));
}

// x' = load x, with the load in a file: other contents are other runs, other keys and other references.
TEST_F(OwnFiles, FilesOfNumbersBelongToTheScene) {
  write("push.cpp", R"(#include <irk/data_files.h>
#include <irk/scene_file.h>
#include <fstream>
IRK_DATA_FILES("load.dat")
using namespace irk;
namespace {
template <class Real>
struct Push {
  Real load = load_();
  static Real load_() {
    double load = 0;
    std::ifstream(dataFile("load.dat", __FILE__)) >> load;
    return load;
  }
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const { r.x[0] = p.k[0] - load * p.x[0]; }
  void start(State<Real>& s) const { s.x << Real(1); }
  SceneFrame<Real> frame() const { return {.t_end = 1, .x = {{"x", "m", 1, 1}}}; }
  static SceneEntry entry() { return {.id = "push", .title = "t", .shows = "s"}; }
};
}  // namespace
IRK_SCENE(Push)
)");
  write("mine.toml", "[[block]]\nscene = 'push.cpp'\nmethods = ['gauss_2']\ntolerances = [1e-4]\nreference = 'auto'\n");
  const Ran missing = irk("run mine.toml");
  EXPECT_EQ(missing.status, 2) << missing.text;
  EXPECT_TRUE(containsAll(missing.text, {"push.cpp", "IRK_DATA_FILES", "load.dat"}));
  write("load.dat", "-2\n");
  ASSERT_EQ(irk("run mine.toml").status, 0);
  const std::string before = read("results/mine/runs.csv");
  EXPECT_EQ(irk("run mine.toml").text.find("1 runs made"), std::string::npos);
  write("load.dat", "-3\n");
  const Ran changed = irk("run mine.toml");
  EXPECT_TRUE(containsAll(changed.text, {"1 runs made"})) << changed.text;
  EXPECT_EQ(changed.text.find("compiling"), std::string::npos) << "the code is the same";
  const Table runs = readTable(folder_.path() / "results" / "mine" / "runs.csv");
  EXPECT_LT(numberAt(runs, runs.rows[0], "error"), 1e-2) << "a reference of its own";
  EXPECT_NE(before.find(runs.rows[0][0]), 0u);
}

TEST_F(OwnFiles, TheTemplateRunsAndStudiesTakeItFromTheirFolder) {
  EXPECT_EQ(irk("new scene lift.cpp").status, 0);
  const Ran again = irk("new scene lift.cpp");
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(containsAll(again.text, {"'lift.cpp' exists"}));
  std::filesystem::create_directory(folder_.path() / "sub");
  std::filesystem::rename(folder_.path() / "lift.cpp", folder_.path() / "sub" / "lift.cpp");
  write("sub/mine.toml", "[[block]]\nscene = 'lift.cpp'\nmethods = ['gauss_3']\ntolerances = [1e-4, 1e-6]\n");
  const Ran run = irk("run sub/mine.toml");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_TRUE(containsAll(read("results/mine/runs.csv"), {",lift,", "gauss_3"}));
  EXPECT_TRUE(containsAll(irk("run sub/mine.toml").text, {"2 success"}));
  // Changed equations are other runs.
  write("sub/lift.cpp", replaced("sub/lift.cpp", "sin(5 * p.t)", "sin(6 * p.t)"));
  const std::string before = read("results/mine/runs.csv");
  EXPECT_EQ(irk("run sub/mine.toml").status, 0);
  EXPECT_NE(read("results/mine/runs.csv"), before);
}

// The suite has a struct Pendulum in an unnamed namespace, too. The linker must not take one for the other.
TEST_F(OwnFiles, AStructMayBeCalledAsOneOfTheSuite) {
  ASSERT_EQ(irk("new scene lift.cpp").status, 0);
  std::string text = read("lift.cpp");
  for (auto at = text.find("Lift"); at != text.npos; at = text.find("Lift", at)) text.replace(at, 4, "Pendulum");
  write("lift.cpp", text);
  const Ran ran = irk("solve lift.cpp --method gauss_3 --tol 1e-6");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_TRUE(containsAll(ran.text, {"lift", "gauss_3"})) << ran.text;
}

TEST_F(OwnFiles, MistakesAreNamed) {
  ASSERT_EQ(irk("new scene lift.cpp").status, 0);
  const std::string solve = " --method gauss_3 --tol 1e-6";
  write("broken.cpp", replaced("lift.cpp", "p.v[0]", "p.velocity[0]"));
  write("taken.cpp", replaced("lift.cpp", "\"lift\"", "\"pendulum\""));
  write("id.cpp", replaced("lift.cpp", "\"lift\"", "\"My Lift\""));
  write("default.cpp", replaced("lift.cpp", "\"mass\", \"1\"", "\"mass\", \"-1\""));
  write("range.cpp", replaced("lift.cpp", "positiveParameter(\"m\", \"kg\", \"mass\", \"1\")",
                              "numberParameter(\"m\", \"kg\", \"mass\", \"1\", 2, 0)"));
  write("panel.cpp", replaced("lift.cpp", "\"9.81\")}}", "\"9.81\")}, .panels = {{\"path\", {\"x:z\"}}}}"));
  write("undeclared.cpp", replaced("lift.cpp", "number<Real>(values, \"k\")", "number<Real>(values, \"q\")"));
  write("start.cpp", replaced("lift.cpp", "void start(State<Real>& s) const", "void start(State<Real>& s)"));
  write("jump.cpp", replaced("lift.cpp", "  void start", "  void jump(Index, T*, T*) const {}\n  void start"));
  write("jump.cpp", replaced("jump.cpp", "  void jump", "  template <class T>\n  void jump"));
  write("bound.cpp", replaced("lift.cpp", "  void start", "  bool nonNegative() const { return true; }\n  void start"));
  write("rows.cpp", replaced("lift.cpp", "r.u[1] = ", "r.u[2] = "));
  write("rows.cpp", replaced("rows.cpp", "\"lift\"", "\"rows\""));
  write("empty.cpp", "int unused = 0;\n");
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"broken.cpp", {"broken.cpp:", "velocity", "irk: broken.cpp:", ": it does not compile: "}},
      {"taken.cpp", {"'pendulum' (taken.cpp) is taken by a scene of the program"}},
      {"id.cpp", {"'My Lift' (id.cpp)", "small letters"}},
      {"default.cpp", {"scene lift (default.cpp)", "the default -1 of the parameter m", "1e-15"}},
      {"range.cpp", {"scene lift (range.cpp)", "the parameter m has the range [2, 0]"}},
      {"panel.cpp", {"scene lift: panel 'path': unknown column 'z'; did you mean 'x'?"}},
      {"undeclared.cpp", {"scene lift", "parameter 'q'"}},
      {"start.cpp", {"irk: start.cpp:", "it does not compile", "start(State<Real>& s) const is expected"}},
      {"jump.cpp", {"irk: jump.cpp:", "jump(Index i, const Point<T>& p, T* u, T* v, T* x) const is expected"}},
      {"bound.cpp", {"irk: bound.cpp:", "bool nonNegative(Index i) const is expected"}},
      {"rows.cpp", {"irk: scene rows: its residual writes behind the last row, to r.u[2]", "nu = 2, nx = 0, nz = 0"}},
      {"empty.cpp", {"empty.cpp: it registers nothing"}},
      {"missing.cpp", {"'missing.cpp' cannot be read"}}};
#ifdef NDEBUG
  constexpr bool kAsserts = false;
#else
  constexpr bool kAsserts = true;  // Eigen's own check comes first, and ends the program
#endif
  for (const auto& [file, parts] : cases) {
    const Ran ran = irk("solve " + file + solve);
    if (kAsserts && file == "rows.cpp") {
      EXPECT_EQ(ran.status, 1) << ran.text;
      EXPECT_TRUE(containsAll(ran.text, {"index < size()", "rows.cpp"}));
      continue;
    }
    EXPECT_EQ(ran.status, 2) << file;
    EXPECT_TRUE(containsAll(ran.text, parts));
  }
}

// Without setProblem the start has no components.
TEST_F(OwnFiles, ACrashIsExplainedAndChecksNameThePlace) {
  write("stiffness.h", "constexpr double kStiffness = 1;\n");
  write("oscillator.cpp", kOscillator);
  write("oscillator.cpp", replaced("oscillator.cpp", "setProblem(scene, Oscillator{});", ""));
  const std::string solve = "solve oscillator.cpp --method gauss_3 --tol 1e-6";
  const Ran crashed = irk(solve);
  EXPECT_EQ(crashed.status, 1) << crashed.text;
  EXPECT_NE(crashed.text.find("crashed while it ran code of oscillator.cpp"), std::string::npos) << crashed.text;
  EXPECT_NE(crashed.text.find("IRK_CHECKED=1"), std::string::npos) << crashed.text;
  const Ran checked = irk(solve, "IRK_CHECKED=1");
  EXPECT_EQ(checked.status, 1) << checked.text;
  EXPECT_NE(checked.text.find("Assertion"), std::string::npos) << checked.text;
  EXPECT_NE(checked.text.find("crashed while it ran code of oscillator.cpp"), std::string::npos) << checked.text;
}

/// x' = 1, whose code does `what` where x > 0.5. `with` is called with the parameter `start`.
std::string risingScene(const std::string& id, const std::string& what, const std::string& with = "") {
  return "#include <irk/scene_file.h>\n#include <stdexcept>\nusing namespace irk;\nnamespace {\n"
         "template <class Real> struct Rising {\n  Real x0;\n  Sizes sizes() const { return {.nx = 1}; }\n"
         "  template <class T> void residual(const Point<T>& p, Rows<T> r) const {\n"
         "    r.x[0] = 1.0 - p.k[0];\n    if (p.x[0] > T(0.5)) { " +
         what +
         " }\n  }\n"
         "  static Rising with(const Settings& v) {\n    const Real x0 = number<Real>(v, \"start\");\n" +
         with +
         "    return {x0};\n  }\n"
         "  void start(State<Real>& s) const { s.x[0] = x0; }\n"
         "  SceneFrame<Real> frame() const { return {.t_end = 1, .x = {{\"x\"}}}; }\n"
         "  static SceneEntry entry() { return {.id = \"" +
         id +
         "\", .title = \"t\", .shows = \"s\", .parameters = {numberParameter(\"start\", \"\", \"x at 0\", \"0\", -10, "
         "10)}}; "
         "}\n};\n}\nIRK_SCENE(Rising)\n";
}

// The file that was loaded last is not the one whose code throws or crashes.
TEST_F(OwnFiles, WhatThrowsIsARowThatNamesItsFile) {
  write("thrower.cpp", risingScene("thrower", "throw std::domain_error(\"above a half\");"));
  write("quiet.cpp", risingScene("quiet", ""));
  write("both.toml",
        "[[block]]\nscene = ['thrower.cpp', 'quiet.cpp']\nmethods = ['radau_iia_3']\ntolerances = [1e-4, 1e-6]\n");
  const Ran study = irk("run both.toml --jobs 1");
  EXPECT_TRUE(containsAll(study.text, {"4 runs in", "2 success", "2 exception"})) << study.text;
  EXPECT_TRUE(containsAll(read("results/both/runs.csv"), {"code of thrower.cpp throws: above a half"}));
  EXPECT_EQ(read("results/both/runs.csv").find("code of quiet.cpp"), std::string::npos);
  const Ran sweep = irk("solve thrower.cpp --method radau_iia_3 --tol 1e-4 --set start=-2,0,-3");
  EXPECT_EQ(sweep.status, 1) << sweep.text;
  EXPECT_TRUE(containsAll(sweep.text, {"1 of 3 runs failed"})) << sweep.text;
  const Ran ensemble = irk("ensemble thrower.cpp --set start=-2,0,-3");
  EXPECT_TRUE(containsAll(ensemble.text, {"3 of 3 runs", "1 exception", "2 success"})) << ensemble.text;
}

TEST_F(OwnFiles, ACrashInAStudyNamesItsFile) {
  write("crasher.cpp", risingScene("crasher", "*static_cast<volatile int*>(nullptr) = 1;"));
  write("quiet.cpp", risingScene("quiet", ""));
  for (const char* scenes : {"'crasher.cpp', 'quiet.cpp'", "'quiet.cpp', 'crasher.cpp'"}) {
    write("both.toml",
          "[[block]]\nscene = [" + std::string(scenes) + "]\nmethods = ['radau_iia_3']\ntolerances = [1e-4]\n");
    const Ran study = irk("run both.toml --jobs 1 --fresh");
    EXPECT_EQ(study.status, 1) << study.text;
    EXPECT_TRUE(containsAll(study.text, {"crashed while it ran code of crasher.cpp,"})) << study.text;
  }
}

TEST_F(OwnFiles, AMemberWhoseSceneCannotBeMadeIsRefused) {
  write("picky.cpp", risingScene("picky", "", "    if (x0 > Real(1)) throw std::invalid_argument(\"too far\");\n"));
  const Ran ensemble = irk("ensemble picky.cpp --set start=0,2,0.5");
  EXPECT_TRUE(containsAll(ensemble.text, {"3 of 3 runs", "1 refused", "2 success", "picky.cpp: it throws", "too far"}))
      << ensemble.text;
}

// A row that a mode leaves out kept what the mode before had written.
TEST_F(OwnFiles, ARowThatIsNotWrittenIsNamed) {
  write("forgets.cpp", risingScene("forgets", ""));
  write("forgets.cpp", replaced("forgets.cpp", "r.x[0] = 1.0 - p.k[0];", ""));
  const Ran ran = irk("solve forgets.cpp --method radau_iia_3 --tol 1e-4");
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_TRUE(
      containsAll(ran.text, {"row 0: residual = nan (not a number, or a row that the residual does not write)"}))
      << ran.text;
}

TEST_F(OwnFiles, AnUnknownMethodHasANearestOne) {
  for (const auto& [given, nearest] : {std::pair{"cvode", "'cvode_bdf'"}, {"radu_iia_5", "'radau_iia_5'"}}) {
    const Ran ran = irk(std::string("solve van_der_pol --tol 1e-5 --method ") + given);
    EXPECT_EQ(ran.status, 2);
    EXPECT_TRUE(containsAll(ran.text, {given, nearest})) << ran.text;
  }
  write("wrong.toml", "[[block]]\nscene = 'van_der_pol'\nmethods = ['cvode']\n");
  EXPECT_TRUE(containsAll(irk("run wrong.toml").text, {"wrong.toml:3", "'cvode_bdf'"}));
  write("wrong.toml", "[[block]]\nscene = 'keplr'\nmethods = ['gauss_2']\n");
  const Ran scene = irk("run wrong.toml");
  EXPECT_TRUE(scene.text.starts_with("irk: wrong.toml:2: unknown scene 'keplr'")) << scene.text;
  write("no_library.so", "text");
  const Ran library = irk("solve van_der_pol --method ./no_library.so");
  EXPECT_EQ(library.status, 2);
  EXPECT_TRUE(containsAll(library.text, {"no_library.so: it cannot be loaded: ", "too short"})) << library.text;
}

TEST_F(OwnFiles, ASolverIsAMethod) {
  const std::string file = IRK_SOURCE_DIR "/experiments/examples/ros2_solver.cpp";
  const Ran ran = irk("solve van_der_pol --tol 1e-5 --method " + file);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_TRUE(containsAll(ran.text, {"van_der_pol   ros2", "1.706"}));
  const Ran listed = irk("list methods --load " + file);
  EXPECT_TRUE(containsAll(listed.text, {"ros2", "Rosenbrock"}));
  EXPECT_EQ(listed.text.find("compiling"), std::string::npos) << "compiled once, though it is in the sources' folder";
  const Ran none = irk("solve van_der_pol --tol 1e-5 --method " IRK_SOURCE_DIR "/experiments/examples/pi_control.cpp");
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(containsAll(none.text, {"holds no solver"}));
}

struct Example {
  const char *file, *axis, *id;
  const char* with = "";  // options that it needs
};
// The name is GoogleTest's.
void PrintTo(const Example& example, std::ostream* out) {  // NOLINT(readability-identifier-naming)
  *out << example.file;
}

class OwnStrategy : public OwnFiles, public testing::WithParamInterface<Example> {};

TEST_P(OwnStrategy, IsAnOptionLikeAllOthers) {
  const auto [file, axis, id, with] = GetParam();
  const std::string load = std::string(" --load " IRK_SOURCE_DIR "/experiments/examples/") + file;
  const std::string solve =
      std::string("solve slider_crank --method radau_iia_5 --tol 1e-7 --t-end 1") + with + " --" + axis + ' ' + id;
  const Ran ran = irk(solve + load);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_TRUE(containsAll(ran.text, {"14.1278"}));
  EXPECT_TRUE(containsAll(irk("list strategies" + load).text, {std::string("    ") + id}));
  EXPECT_EQ(irk(solve).status, 2) << "unknown without its file";
}

INSTANTIATE_TEST_SUITE_P(
    Examples, OwnStrategy,
    testing::Values(Example{"pi_control.cpp", "control", "pi"}, Example{"linear_predictor.cpp", "predictor", "linear"},
                    Example{"chord_newton.cpp", "newton", "chord"},
                    Example{"smoothness_estimate.cpp", "estimate", "smoothness"},
                    Example{"full_pivot_solver.cpp", "solver", "full_pivot"},
                    Example{"no_stiffness.cpp", "jacobian", "no_stiffness"},
                    Example{"contraction_order.cpp", "order", "contraction", " --estimate embedded"}),
    [](const auto& example) { return std::string(example.param.id); });

TEST(CompilerMessages, KeepErrorsAndWhatBelongsToTheFile) {
  const std::string text =
      "In file included from /usr/include/x.h:1,\n                 from mine.cpp:2:\nmine.cpp: In function 'f':\n"
      "mine.cpp:3:1: warning: w\n    3 | x\n/usr/include/x.h:7:2: note: n\n    7 | y\n/usr/include/x.h:9:2: error: e\n"
      "    9 | z\n";
  EXPECT_EQ(
      own::messagesAbout("mine.cpp", text),
      "mine.cpp: In function 'f':\nmine.cpp:3:1: warning: w\n    3 | x\n/usr/include/x.h:9:2: error: e\n    9 | z\n");
}

}  // namespace
}  // namespace irk
