// Tables of measured data as a user meets them: in a scene of C++ and one of C, with keys, references and refusals.
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>
#include <vector>

#include "experiments/runs/run_table.h"
#include "tests/experiments/own/own_files.h"

namespace irk {
namespace {

constexpr const char* kDrive = R"(#include <irk/scene_file.h>
using namespace irk;
namespace {
template <class Real>
struct Drive {
  Real inertia;
  TimeTable<Real> torque{"torque.csv", "t", "M"};
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const { r.u[0] = inertia * p.a[0] - torque(p.t); }
  static Drive with(const Settings& values) { return {number<Real>(values, "inertia")}; }
  SceneFrame<Real> frame() const { return {.t_end = 2, .u = {{"phi", "rad", 1, 1}}}; }
  static SceneEntry entry() {
    return {.id = "drive", .title = "t", .shows = "s", .parameters = {positiveParameter("inertia", "", "m", "1")}};
  }
};
}  // namespace
IRK_SCENE(Drive)
)";

// phi'' = M: with M = 0 up to 1/3 and then 3 t - 1, phi' = 3/2 (t - 1/3)^2 and phi = (t - 1/3)^3 / 2.
constexpr const char* kTorque = "t,M\n0,0\n0.33333333333333331,0\n2,5\n";

class ScenesWithTables : public OwnFiles {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_.path() / "sub");
    write("sub/drive.cpp", kDrive);
  }
};

TEST_F(ScenesWithTables, StepsEndAtKinksAndTheFileIsPartOfTheKey) {
  write("sub/torque.csv", kTorque);
  const std::string solve = "solve sub/drive.cpp --method radau_iia_3 --tol 1e-6";
  const Ran ran = irk(solve);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_TRUE(containsAll(ran.text, {"2.3148148148", "4.16666666666"}));  // one step per piece is exact
  write("sub/mine.toml",
        "[[block]]\nscene = 'drive.cpp'\nmethods = ['gauss_1']\ntolerances = [1e-4]\nreference = 'auto'\n");
  ASSERT_EQ(irk("run sub/mine.toml").status, 0);
  const Table before = readTable(folder_.path() / "results" / "mine" / "runs.csv");
  EXPECT_EQ(irk("run sub/mine.toml").text.find("1 runs made"), std::string::npos);
  write("sub/torque.csv", "t,M\n0,0\n1,6\n2,6\n");
  const Ran after = irk("run sub/mine.toml");
  EXPECT_EQ(after.status, 0) << after.text;
  const Table runs = readTable(folder_.path() / "results" / "mine" / "runs.csv");
  EXPECT_NE(textAt(runs, runs.rows[0], "key"), textAt(before, before.rows[0], "key"));
  EXPECT_LT(numberAt(runs, runs.rows[0], "error"), 1e-2) << "a reference of its own";
}

TEST_F(ScenesWithTables, MistakesAreNamedInOneLine) {
  const std::string solve = "solve sub/drive.cpp --tol 1e-6";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "it is empty"},
      {"t,moment\n0,1\n2,2\n", "unknown column 'M'"},
      {"time,M\n0,1\n2,2\n", "unknown column 't'"},
      {"t,M\n0,1\n2,two\n", "torque.csv:3: M = 'two'"},
      {"t,M\n0,1\n2,nan\n", "torque.csv:3: M = 'nan'"},
      {"t,M\n0,1\n1,2\n1,3\n2,3\n", "torque.csv:4: t = 1 is not later than 1 in line 3"},
      {"t,M\n0,1\n", "1 row of numbers"},
      {"t,M\n0,1\n2,1,5\n", "torque.csv:3: 3 cells"},
      {"t,M\n0,1\n1.5,2\n", "torque.csv has M from t = 0 to 1.5, and the run goes from 0 to 2"}};
  const auto expect = [&](const std::string& part) {
    const Ran ran = irk(solve);
    EXPECT_EQ(ran.status, 2) << part << ran.text;
    EXPECT_NE(ran.text.find(part), std::string::npos) << part << ran.text;
    const auto last = ran.text.rfind("irk: ");
    ASSERT_NE(last, std::string::npos) << ran.text;
    EXPECT_EQ(ran.text.find('\n', last), ran.text.size() - 1) << ran.text;
  };
  expect("torque.csv' cannot be read: No such file");
  for (const auto& [text, part] : cases) {
    write("sub/torque.csv", text);
    expect(part);
  }
  // A shorter run stays inside the rows.
  EXPECT_EQ(irk(solve + " --t-end 1.5").status, 0);
}

TEST_F(ScenesWithTables, AreOpenedByScenesInCToo) {
  write("sub/drive.c", R"(#include <irk/scene_c.h>
int irk_scene_version(void) { return IRK_SCENE_VERSION; }
int irk_scene_open(const double* parameters, void** self, char* message) {
  *self = (void*)irk_table_open("torque.csv", "t", "M", 0);
  return *self ? 0 : 1;
}
void irk_scene_size(void* self, irk_scene_sizes* n) { n->nu = 1; }
void irk_scene_start(void* self, double* t, double* y, double* w, double* d) { t[1] = 2; }
int irk_scene_rates(void* self, double t, const double* y, const double* d, double* f) {
  f[0] = irk_table_value((const irk_table*)self, t);
  return 0;
}
)");
  const std::string folder = folder_.path() / "sub";
  const std::string compile = "cc -O2 -shared -fPIC -w -I " IRK_SOURCE_DIR "/experiments/include " + folder +
                              "/drive.c -o " + folder + "/drive.so";
  ASSERT_EQ(std::system(compile.c_str()), 0);
  expectRefused("sub/drive.so", "torque.csv' cannot be read");
  write("sub/torque.csv", kTorque);
  const Ran ran = irk("solve sub/drive.so --method radau_iia_3 --tol 1e-6");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_TRUE(containsAll(ran.text, {"2.3148148148", "4.16666666666"}));
}

#if defined(IRK_FMUS)
// The lines of components: with error bars, without times.
std::string components(const std::string& text) {
  std::string lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("  u  ") || line.starts_with("  v  ") || line.starts_with("  x  ")) lines += line + '\n';
  }
  return lines;
}

TEST_F(ScenesWithTables, AreInputsOfAnFmu) {
  std::filesystem::copy_file(IRK_FMUS "/fmu_motor_2.fmu", folder_.path() / "motor.fmu");
  write("volt.csv", "time,voltage,U\n0,24,0\n0.05,24,12\n0.1,24,12\n");
  const std::string solve = "solve motor.fmu --tol 1e-6 --t-end 0.1";
  const Ran constant = irk(solve), table = irk(solve + " --set voltage=volt.csv");
  EXPECT_EQ(table.status, 0) << table.text;
  EXPECT_NE(components(table.text), "");
  EXPECT_EQ(components(table.text), components(constant.text));
  const Ran ramp = irk(solve + " --set voltage=volt.csv:U --json");
  EXPECT_EQ(ramp.status, 0) << ramp.text;
  EXPECT_NE(components(irk(solve + " --set voltage=volt.csv:U").text), components(constant.text));
  const std::vector<std::pair<std::string, std::string>> refused{
      {"volt.csv:W", "volt.csv: unknown column 'W'"},
      {"vold.csv", "vold.csv' cannot be read"},
      {"volt.csv;U", "is not allowed here"},
      {"volt.csvU", "file.csv or file.csv:column is expected"},
      {"volts", "or a table: file.csv or file.csv:column"}};
  for (const auto& [value, part] : refused) expectRefused("motor.fmu --t-end 0.1 --set 'voltage=" + value + "'", part);
  expectRefused("motor.fmu --set voltage=volt.csv", "has voltage from t = 0 to 0.1, and the run goes from 0 to 2");
}
#endif

}  // namespace
}  // namespace irk
