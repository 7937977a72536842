// Mutated tableau files.
#include <gtest/gtest.h>

#include "core/base/input_file.h"
#include "tableaus/files/file.h"
#include "tests/mutate.h"

namespace irk::test {
namespace {

// Reading gives a tableau, or a misuse of one line that names the file.
TEST(TableauFile, SurvivesMutatedTexts) {
  const std::string folder = IRK_SOURCE_DIR "/tableaus/data/";
  const std::string seeds[] = {readInputFile(folder + "gauss_2.txt"), readInputFile(folder + "lobatto_iiic_3.txt"),
                               "family: none\nstages: 1\norder: 2\nstage_order: 1\ndigits: 16\nA\n0.5\nb\n1\nc\n0.5\n"};
  const std::string pieces[] = {
      "A\n", "b\n",   "c\n",    "\n",    "stages: 3", "stages: -1", "stages: 99999999999", "nan",
      "inf", "1e999", "1e-999", "0x1p3", ":",         "#",          "digits: 0",           "\r",
      "\t",  "+",     "-",      ".",     "1/2",       "1e",         std::string(1, '\0'),  "\xff"};
  const auto [read, refused] =
      readMutated(Mutations(seeds, pieces, 20042), 50'000, "mine.txt", [](const std::string& text) {
        const auto file = parseTableau(text, "mine.txt");
        EXPECT_EQ(file.tableau.A.rows(), file.tableau.b.size()) << text;
        EXPECT_EQ(file.tableau.A.cols(), file.tableau.c.size()) << text;
      });
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 10'000);
}

}  // namespace
}  // namespace irk::test
