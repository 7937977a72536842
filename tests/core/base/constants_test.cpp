// The table of the numbers that decide.
#include "core/base/constants.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "core/base/input_file.h"

namespace irk::test {
namespace {

TEST(Constants, EachHasAnotherNameAndSaysWhatItDecidesAndWhy) {
  std::set<std::string_view> names;
  for (const Constant* one : kConstants) {
    EXPECT_TRUE(names.insert(one->name).second) << one->name;
    EXPECT_GT(one->value, 0) << one->name;
    EXPECT_GT(one->decides.size(), 15U) << one->name;
    EXPECT_FALSE(one->source.empty()) << one->name;
    EXPECT_TRUE(one->name.find('.') != std::string_view::npos) << one->name;
  }
}

TEST(Constants, AllAreInTheTable) {
  const std::string header = readInputFile(std::filesystem::path(IRK_SOURCE_DIR) / "core/base/constants.h");
  const std::regex declared("inline constexpr Constant k");
  const auto count = std::distance(std::sregex_iterator(header.begin(), header.end(), declared), {});
  EXPECT_EQ(count, static_cast<std::ptrdiff_t>(std::size(kConstants)));
}

// Numbers elsewhere in the solver choose between algorithms of equal results, or stand for `unknown`.
TEST(Constants, NoOthersDecide) {
  const std::set<std::string> known{"kExact",
                                    "kTinyError",
                                    "kKeepBelow",
                                    "kAway",
                                    "kEps",
                                    "kFurther",
                                    "kBeside",
                                    "kDualCheck",
                                    "kDecayed",
                                    "kLooser",
                                    "kSparseFill",
                                    "kDistance",
                                    "kNever",
                                    "kSameEigenvalue",
                                    "kAmplificationLimit",
                                    "kAboutZero",
                                    "kInner",
                                    "kSamePoint",
                                    "kUnknown",
                                    "kFirstLook",
                                    "kEigenConditionGrowth",
                                    "kEigenConditionPerStage",
                                    "kLeast",
                                    "kMostMultiplier",
                                    "kSmallerPivot",
                                    "kDenseUnknowns",
                                    "kOfCostlyOnes",
                                    "kUnknownFloor",
                                    "kUnknownTheta",
                                    "kProbe",
                                    "kWorthUpdates",
                                    "kNothing"};
  const std::regex number("constexpr double (k[A-Z][A-Za-z]*)");
  int seen = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(IRK_SOURCE_DIR) / "core")) {
    const auto& file = entry.path();
    if ((file.extension() != ".h" && file.extension() != ".cpp") || file.filename() == "constants.h") continue;
    const std::string text = readInputFile(file);
    for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at, ++seen) {
      EXPECT_TRUE(known.contains((*at)[1]))
          << file << ": " << (*at)[1] << ": a number that decides belongs into core/base/constants.h";
    }
  }
  EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace irk::test
