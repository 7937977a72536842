// Where the program finds plots/.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/base/input_file.h"
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

}  // namespace
}  // namespace irk
