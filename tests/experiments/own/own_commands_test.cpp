// Commands that the program prints for runs of a user's files: pasted into a shell, they make the same run.
#include "experiments/runs/run_table.h"
#include "experiments/study/run_command.h"
#include "tests/experiments/own/own_files.h"

namespace irk {
namespace {

class OwnCommands : public OwnFiles {
 protected:
  // As a user does it in another folder, with the name that the program has there.
  Ran paste(const std::string& command) const {
    EXPECT_TRUE(command.starts_with("irk solve ")) << command;
    std::filesystem::create_directories(folder_.path() / "elsewhere");
    return irk(command.substr(4), "cd elsewhere;");
  }
  Table runs(const std::string& study) const { return readTable(folder_.path() / "results" / study / "runs.csv"); }
};

constexpr const char* kStudy = R"(load = ["my files/damped.cpp", "SOLVERS/euler_ode.so"]
[[block]]
scene = "my files/lift.cpp"
methods = ["my files/mine.txt", "euler_ode", "gauss_2"]
tolerances = [1e-3]
t_end = 0.25
[[block]]
scene = "my files/lift.cpp"
methods = ["gauss_3"]
control = "damped"
tolerances = [1e-3]
t_end = 0.25
)";

TEST_F(OwnCommands, OfAStudyMakeTheSameRuns) {
  std::filesystem::create_directory(folder_.path() / "my files");
  ASSERT_EQ(irk("new scene 'my files/lift.cpp'").status, 0);
  ASSERT_EQ(irk("tableau export radau_iia_2 > 'my files/mine.txt'").status, 0);
  std::filesystem::copy_file(IRK_SOURCE_DIR "/experiments/examples/pi_control.cpp",
                             folder_.path() / "my files" / "damped.cpp");
  write("my files/damped.cpp", replaced("my files/damped.cpp", "\"pi\"", "\"damped\""));
  std::string study = kStudy;
  study.replace(study.find("SOLVERS"), 7, IRK_SOLVERS);
  write("mine.toml", study);
  const Ran ran = irk("run mine.toml");
  ASSERT_EQ(ran.status, 0) << ran.text;
  const Table table = runs("mine");
  ASSERT_EQ(table.rows.size(), 4U);
  for (const auto& row : table.rows) {
    const std::string command = seriesCommand(table, row).text + sweptOptions(table, row);
    const Ran again = paste(command + " --json");
    EXPECT_EQ(again.status, 0) << command << "\n" << again.text;
    EXPECT_TRUE(containsAll(again.text, {"\"accepted\": " + textAt(table, row, "steps_accepted") + ","})) << command;
  }
}

TEST_F(OwnCommands, OfTheProgramsOwnPartsNameNoFile) {
  write("mine.toml", "[[block]]\nscene = 'kepler'\nmethods = ['gauss_2']\ntolerances = [1e-3]\nt_end = 1\n");
  ASSERT_EQ(irk("run mine.toml").status, 0);
  const Table table = runs("mine");
  EXPECT_EQ(textAt(table, table.rows.at(0), "files"), "");
  EXPECT_EQ(seriesCommand(table, table.rows[0]).text.find("--load"), std::string::npos);
}

TEST_F(OwnCommands, ANewStudyRunsAndDrawsOneFigure) {
  ASSERT_EQ(irk("new scene lift.cpp").status, 0);
  write("lift.cpp", replaced("lift.cpp", ".t_end = 5", ".t_end = 0.1"));
  const Ran made = irk("new study lift.cpp");
  ASSERT_EQ(made.status, 0) << made.text;
  EXPECT_TRUE(containsAll(made.text, {"irk run lift_costs.toml"}));
  const Ran again = irk("new study lift.cpp");
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(containsAll(again.text, {"'lift_costs.toml' exists"}));
  write("lift_costs.toml",
        replaced("lift_costs.toml", "1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10", "1e-4, 1e-8"));
  const Ran ran = irk("run lift_costs.toml");
  ASSERT_EQ(ran.status, 0) << ran.text;
  const Table table = runs("lift_costs");
  EXPECT_EQ(table.rows.size(), 12U);
  for (const auto& row : table.rows) {
    EXPECT_EQ(textAt(table, row, "outcome"), "success");
    EXPECT_LT(numberAt(table, row, "error"), 1e-2);
    EXPECT_GT(numberAt(table, row, "cpu_s"), 0);
  }
  const Ran drawn = irk("plot lift_costs.toml");
  EXPECT_EQ(drawn.status, 0) << drawn.text;
  const auto figures = folder_.path() / "results" / "report" / "figures";
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(figures)) {
    if (file.path().extension() == ".svg") names.push_back(file.path().stem().string());
  }
  EXPECT_EQ(names, std::vector<std::string>{"lift_costs_work_by"});
}

// CVODE solves ordinary equations: on a pendulum those of index 1, of an index 2 without constraints none.
TEST_F(OwnCommands, ANewStudyHasPeersWhereTheyCanRun) {
  ASSERT_EQ(irk("new study pendulum").status, 0);
  const std::string study = read("pendulum_costs.toml");
  EXPECT_TRUE(containsAll(study, {"scene = \"pendulum\"", "methods = [\"cvode_bdf\"]\nformulation = \"index1\"",
                                  "methods = [\"ida_bdf\"]\n\n"}))
      << study;
  write("pendulum_costs.toml",
        replaced("pendulum_costs.toml", "1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10", "1e-4, 1e-8"));
  const Ran ran = irk("run pendulum_costs.toml");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_EQ(runs("pendulum_costs").rows.size(), 12U);
  ASSERT_EQ(irk("new study index2_nonlinear").status, 0);
  const std::string index2 = read("index2_nonlinear_costs.toml");
  EXPECT_EQ(index2.find("cvode_bdf"), index2.npos);
  EXPECT_NE(index2.find("ida_bdf"), index2.npos);
  ASSERT_EQ(irk("new study index3_nonlinear").status, 0);
  EXPECT_EQ(read("index3_nonlinear_costs.toml").find("_bdf"), std::string::npos);
  const Ran none = irk("new study no_such_scene");
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(containsAll(none.text, {"no_such_scene"}));
}

TEST_F(OwnCommands, LoadALibrary) {
  const std::string load = " --load " IRK_SOLVERS "/euler_ode.so";
  EXPECT_TRUE(containsAll(irk("list methods" + load).text, {"euler_ode", "Implicit Euler, extrapolated"}));
  EXPECT_TRUE(containsAll(irk("list methods --load radau5@" IRK_SOLVERS "/fortran_like.so").text, {"radau5  "}));
  EXPECT_EQ(irk("list methods").text.find("euler_ode"), std::string::npos);
  EXPECT_EQ(irk("solve van_der_pol --tol 1e-4 --t-end 0.1 --method euler_ode" + load).status, 0);
  const Ran refused = irk("list methods --load notes.txt");
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(containsAll(refused.text, {"notes.txt", ".so"})) << refused.text;
}

TEST_F(OwnFiles, AReferenceOfASceneIsItsEndWithItsDefaults) {
  ASSERT_EQ(irk("new scene lift.cpp").status, 0);
  write("lift.cpp", replaced("lift.cpp", ".t_end = 5", ".t_end = 0.1"));
  const Ran made = irk("reference lift.cpp --out mine");
  EXPECT_EQ(made.status, 0) << made.text;
  EXPECT_TRUE(containsAll(made.text, {"lift: 4 values, fewest digits"})) << made.text;
  EXPECT_TRUE(containsAll(read("mine/lift.csv"), {"lift,,0.1,x,", "lift,,0.1,y',"})) << read("mine/lift.csv");
  const Ran checked = irk("reference lift.cpp --check --out mine");
  EXPECT_EQ(checked.status, 0) << checked.text;
}

}  // namespace
}  // namespace irk
