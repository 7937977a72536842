// Mutated tableau files.
#include <gtest/gtest.h>

#include "core/base/input_file.h"
#include "irk/misuse.h"
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
  Mutations mutations(seeds, pieces, 20042);
  int read = 0, refused = 0;
  for (int i = 0; i < 50'000; ++i) {
    const std::string text = mutations.next();
    try {
      const auto file = parseTableau(text, "mine.txt");
      ASSERT_EQ(file.tableau.A.rows(), file.tableau.b.size()) << text;
      ASSERT_EQ(file.tableau.A.cols(), file.tableau.c.size()) << text;
      ++read;
    } catch (const Misuse& line) {
      ++refused;
      const std::string what = line.what();
      ASSERT_TRUE(what.starts_with("mine.txt")) << what << "\n" << text;
    } catch (const std::exception& other) {
      FAIL() << other.what() << "\n" << text;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 10'000);
}

}  // namespace
}  // namespace irk::test
