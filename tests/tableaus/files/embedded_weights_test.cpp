// Embedded weights in tableau files: read, checked, written, refused; and tableaus as source text.
#include <cstdlib>

#include "core/base/input_file.h"
#include "tableaus/catalogue/report.h"
#include "tableaus/files/file.h"
#include "tests/tableaus/support.h"
#include "tests/temporary_folder.h"

namespace irk {
namespace {

// HW II, table IV.6.5.
std::string sdirk4(const std::string& order_hat = "order_hat: 3\n",
                   const std::string& b_hat = "b_hat\n59/48 -17/96 225/32 -85/12 0\n") {
  const std::string last = "25/24 -49/48 125/16 -85/12 1/4\n";
  return "family: sdirk4\nstages: 5\norder: 4\nstage_order: 1\ndigits: 70\n" + order_hat +
         "A\n1/4 0 0 0 0\n1/2 1/4 0 0 0\n17/50 -1/25 1/4 0 0\n371/1360 -137/2720 15/544 1/4 0\n" + last + "b\n" + last +
         "c\n1/4 3/4 11/20 1/2 1\n" + b_hat;
}

std::string verdictOf(const std::string& text) { return checkTableau(parseTableau(text, "x")).text; }

/// The output of `command` in a folder where the file `name` holds sdirk4 as `format`, and `after`.
std::string outputWith(const std::string& format, const std::string& name, const std::string& after,
                       const std::string& command) {
  const TemporaryFolder folder;
  folder.write(name, exportTableau(folder.write("tableau.txt", sdirk4()), format) + after);
  const std::string all = "cd '" + folder.path().string() + "' && " + command + " > out 2>&1";
  const int status = std::system(all.c_str());
  return (status == 0 ? "" : "failed: ") + readInputFile(folder.path() / "out");
}

TEST(EmbeddedWeights, AreReadCheckedAndWritten) {
  const TableauFile file = parseTableau(sdirk4(), "x");
  EXPECT_EQ(file.tableau.order_hat, 3);
  EXPECT_EQ(static_cast<double>(file.tableau.b_hat[1]), -17.0 / 96);
  const TableauReport report = checkTableau(file);
  EXPECT_TRUE(report.ok) << report.text;
  EXPECT_TRUE(contains(report.text, "b_hat: the sum is 1, by all rooted trees the order is 3"));
  EXPECT_TRUE(contains(report.text, "R_hat(inf) = "));
  const Vec<BigFloat> read = parseTableau(writeTableau(file), "x").tableau.b_hat;
  EXPECT_LT(largestDifference<BigFloat>(read, file.tableau.b_hat), 1e-48) << "files have 50 digits";
  EXPECT_EQ(file.tableau.cast<double>().order_hat, 3);
}

TEST(EmbeddedWeights, ThatContradictTheirHeaderAreWrong) {
  EXPECT_TRUE(contains(verdictOf(sdirk4("order_hat: 4\n")), "order_hat 4 is contradicted by a rooted tree: it is 3"));
  EXPECT_TRUE(contains(verdictOf(sdirk4("order_hat: 3\n", "b_hat\n1 1 0 0 0\n")), "the sum of b_hat is 2"));
  EXPECT_TRUE(
      contains(verdictOf(sdirk4("order_hat: 3\n", "b_hat\n25/24 -49/48 125/16 -85/12 1/4\n")), "b_hat equals b"));
  EXPECT_TRUE(contains(verdictOf(sdirk4("order_hat: 2\n")), "note"));
}

// Where A has an explicit first stage, R_hat is unbounded.
TEST(EmbeddedWeights, SayWhereTheyAreUnbounded) {
  const std::string trapezoidal =
      "stages: 2\norder: 2\norder_hat: 1\ndigits: 70\nA\n0 0\n1/2 1/2\nb\n1/2 1/2\nc\n0 1\nb_hat\n1 0\n";
  EXPECT_TRUE(contains(verdictOf(trapezoidal), "unbounded for stiff components"));
}

TEST(EmbeddedWeights, AreRefusedWithLineAndReason) {
  const auto refused = [](const std::string& text, const std::string& reason) {
    EXPECT_TRUE(contains(refusal([&] { parseTableau(text, "x"); }), reason));
  };
  refused(sdirk4(""), "the header has no 'order_hat'");
  refused(sdirk4("order_hat: 3\n", ""), "x:6: 'order_hat' without a block b_hat after block c");
  refused(sdirk4("order_hat: 11\n"), "x:6: order_hat: '11' is not a whole number from 1 to 10");
  refused(sdirk4("order_hat: 3\n", "b_hat\n"), "cut short: the row of b_hat is missing");
  refused(sdirk4("order_hat: 3\n", "b_hat\n1 0\n"), "the row of b_hat has 2 numbers, not 5");
  refused(sdirk4("order_hat: 3\n", "b_hat\n1 0 0 0 nan\n"), "'nan' is not a finite number");
  refused(sdirk4() + "1 0 0 0 0\n", "'1 0 0 0 0' after the end of block b_hat");
  refused(sdirk4("b_hat: 3\n"), "a block begins with a line 'b_hat' without ':'");
}

TEST(TableauText, IsCThatCompiles) {
  EXPECT_EQ(outputWith("c", "t.c",
                       "#include <stdio.h>\nint main(void) { printf(\"%.17g %.17g %.17g %.17g\\n\", A[3][1], b[1], "
                       "c[2], b_hat[0]); return sizeof A != 25 * sizeof(double); }\n",
                       "cc -std=c99 -Wall -Wextra -Werror t.c -o t && ./t"),
            fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", -137.0 / 2720, -49.0 / 48, 11.0 / 20, 59.0 / 48));
}

TEST(TableauText, IsPythonThatRuns) {
  if (std::system("python3 -c 'import numpy' > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 has no numpy";
  EXPECT_EQ(outputWith("numpy", "t.py", "print(A.shape, A[3, 1] == -137 / 2720, b_hat[0] == 59 / 48, c.sum())\n",
                       "python3 t.py"),
            "(5, 5) True True 3.05\n");
}

TEST(TableauText, IsALatexArray) {
  EXPECT_EQ(exportTableau("radau_iia_2", "latex"),
            "% Butcher tableau radau_iia_2, order 3\n"
            "\\begin{array}{c|cc}\n"
            "0.3333333333 & 0.4166666667 & -0.08333333333 \\\\\n"
            "1 & 0.75 & 0.25 \\\\\n"
            "\\hline\n"
            " & 0.75 & 0.25\n"
            "\\end{array}\n");
}

TEST(TableauText, HasFormatsWithNames) {
  EXPECT_TRUE(contains(refusal([] { exportTableau("radau_iia_2", "latx"); }), "did you mean 'latex'"));
}

}  // namespace
}  // namespace irk
