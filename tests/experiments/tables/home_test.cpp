// Where the program finds plots/.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "experiments/tables/environment.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// bin/irk and share/irk/plots, as cmake --install places them: they may be moved together. The sources, which this
// program was built from and still finds, count less.
TEST(Home, OfAnInstalledProgramIsBesideIt) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const fs::path plots = folder.path() / "share" / "irk" / "plots";
  fs::create_directories(folder.path() / "bin");
  fs::create_directories(plots);
  fs::create_symlink(IRK_PROGRAM, folder.path() / "link");
  fs::copy_file(IRK_PROGRAM, folder.path() / "bin" / "irk");
  std::ofstream(plots / "figures.txt") << "of_the_installation|work_by.gp|a|A|B|\n";
  const auto messageOf = [&](const std::string& before, const std::string& program) {
    const auto file = folder.path() / "err";
    const std::string command = "cd " + folder.path().string() + " && env -u IRK_HOME " + before + " " + program +
                                " plot nothing > /dev/null 2> " + file.string();
    EXPECT_NE(std::system(command.c_str()), 0);
    return readInputFile(file);
  };
  EXPECT_TRUE(containsAll(messageOf("", "bin/irk"), {"Known: of_the_installation"}));
  EXPECT_TRUE(containsAll(messageOf("", "./link"), {"Known: tableaus", "drift"})) << "of the sources";
  const std::string sources = std::string("IRK_HOME=") + IRK_SOURCE_DIR;
  EXPECT_TRUE(containsAll(messageOf(sources, "bin/irk"), {"Known: tableaus", "drift"})) << "IRK_HOME comes first";
}

/// Another working folder and IRK_HOME until the end of the test.
class Elsewhere {
 public:
  explicit Elsewhere(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~Elsewhere() {
    std::filesystem::current_path(before_);
    unsetenv("IRK_HOME");
  }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;

 private:
  std::filesystem::path before_;
};

TEST(Home, AFolderPlotsOfTheWorkingFolderIsNotUsed) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "plots");
  folder.write("plots/figures.txt", "mine|mine.gp|mine|Mine|Mine|\n");
  folder.write("plots/stability.gp", "system 'touch " + (folder.path() / "executed").string() + "'\n");
  const Elsewhere here(folder.path());
  const Ended plotted = program({"tableau", "plot", "gauss_2", "--out", "figure"});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
  EXPECT_TRUE(std::filesystem::exists("figure.svg"));
  EXPECT_FALSE(std::filesystem::exists("executed"));
  EXPECT_EQ(homeFolder(), std::filesystem::path(IRK_SOURCE_DIR));
  // A folder that the user names in IRK_HOME is used.
  setenv("IRK_HOME", folder.path().c_str(), 1);
  EXPECT_EQ(homeFolder(), folder.path());
  setenv("IRK_HOME", (folder.path() / "empty").c_str(), 1);
  for (const auto& line : {std::vector<std::string>{"plot", "drift"}, {"tableau", "plot", "gauss_2"}}) {
    const Ended ended = program(line);
    EXPECT_EQ(ended.status, 2);
    EXPECT_TRUE(contains(ended.err, "IRK_HOME"));
  }
}

}  // namespace
}  // namespace irk
