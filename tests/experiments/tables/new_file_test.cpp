// Files that get their name when they are whole, and the classes of times.
#include "experiments/tables/new_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "experiments/tables/environment.h"
#include "experiments/tables/timing_class.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST(NewFiles, GetTheirNamesWhenTheyAreWhole) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv";
  {
    NewFile first(file), second(file);
    first.out() << "first";
    second.out() << "second";
    EXPECT_FALSE(std::filesystem::exists(file));
    first.close();
    EXPECT_EQ(readInputFile(file), "first");
    second.close();
    NewFile left(file);
    left.out() << "not whole";
  }
  EXPECT_EQ(readInputFile(file), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing is left over";
}

// In a folder that is shared, somebody may have put links where a file is about to be written.
TEST(NewFiles, DoNotFollowLinks) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv", target = folder.path() / "precious";
  std::ofstream(target) << "kept";
  std::filesystem::create_symlink(target, file.string() + ".new");
  std::filesystem::create_symlink(target, file.string() + "." + hostName() + "." + std::to_string(getpid()) + ".1.new");
  writeTable(file, {{}, {"a"}, {{"1"}}});
  EXPECT_EQ(readInputFile(target), "kept");
  EXPECT_EQ(readInputFile(file), "a\n1\n");
}

TEST(TimingClasses, HaveTheLibrariesOfTheIntegrator) {
  const std::vector<std::string> columns{"environment", "cpu", "compiler", "flags", "libraries"};
  const TableRow row{"1", "Fast 9", "GNU 12", "-O3",
                     "Linux; glibc 2.36; Eigen 3.4; GSL 2.7; SUNDIALS 6.4.1, /usr/lib; KLU 1.3"};
  EXPECT_EQ(timingClass(columns, row, libraryOfMethod("gauss_2")),
            "Fast 9; GNU 12; -O3; glibc 2.36; Eigen 3.4; KLU 1.3");
  EXPECT_EQ(timingClass(columns, row, libraryOfMethod("cvode_bdf")),
            "Fast 9; GNU 12; -O3; glibc 2.36; Eigen 3.4; KLU 1.3; SUNDIALS 6.4.1, /usr/lib");
  EXPECT_EQ(libraryOfMethod("gsl_bsimp"), "GSL");
}

}  // namespace
}  // namespace irk
