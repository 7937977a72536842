// Tables of measured data: their values against known ones, what they declare, and what is said of a damaged file.
#include "irk/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "irk/dual.h"
#include "irk/multiprecision.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace irk {
namespace {

class Tables : public testing::Test {
 protected:
  std::string refusal(const std::string& y = "M") const {
    const TableReadings readings(folder_.path().string());
    return irk::refusal([&] { const TimeTable<double> table("torque.csv", "t", y); });
  }

  const TemporaryFolder folder_;
};

TEST_F(Tables, AreLinearBetweenTheRowsAndDeclareTheirKinks) {
  folder_.write("torque.csv", "# a comment\r\nt; n;M\r\n0;7;1\r\n1;7;3\r\n\r\n2;7;5\r\n4;7;+5\r\n5;7;-1e0\r\n");
  const TableReadings readings(folder_.path().string());
  const TimeTable<double> torque("torque.csv", "t", "M");
  EXPECT_EQ(torque(0.0), 1);
  EXPECT_EQ(torque(0.5), 2);
  EXPECT_EQ(torque(3.0), 5);
  EXPECT_EQ(torque(4.5), 2);
  EXPECT_EQ(torque(5.0), -1);
  EXPECT_EQ(torque.kinks(), (std::vector<double>{2, 4})) << "the slope does not change at 1";
  using D = DualNumber<double, 1>;
  D t(4.5);
  t.d[0] = 1;
  EXPECT_EQ(torque(t).value, 2);
  EXPECT_EQ(torque(t).d[0], -6);
  ASSERT_EQ(readings.all().size(), 1u);
  const TableRead& read = readings.all().front();
  EXPECT_EQ(read.first + " " + read.last, "0 5");
  EXPECT_EQ(read.kinks, (std::vector<std::string>{"2", "4"}));
  EXPECT_EQ(std::filesystem::path(read.file), folder_.path() / "torque.csv");
  EXPECT_EQ(kinksRead().size(), 2u);
}

TEST_F(Tables, HaveAllDigitsOfTheirText) {
  folder_.write("torque.csv", "t,M\n0,0\n0.3,0.1\n1,1\n");
  const TableReadings readings(folder_.path().string());
  const TimeTable<BigFloat> torque("torque.csv", "t", "M");
  EXPECT_EQ(torque.kinks().front(), BigFloat("0.3"));
  EXPECT_LT(abs(torque(BigFloat("0.15")) - BigFloat("0.05")), BigFloat(1e-49));
}

// The slopes at the rows 0, 1, 3, 4 by the formulas of Fritsch & Butland, with the secants 1, 2, 0:
// d1 = 9 / (5 / 1 + 4 / 2) = 9/7, d2 = 0, d0 = ((2 + 2) 1 - 1 * 2) / 3 = 2/3, d3 = 0.
TEST_F(Tables, TheCubicIsThatOfFritschAndButland) {
  folder_.write("torque.csv", "t,M\n0,0\n1,1\n3,5\n4,5\n");
  const TableReadings readings(folder_.path().string());
  const TimeTable<double> torque("torque.csv", "t", "M", Interpolation::kCubic);
  const auto slope = [&](double t) {
    DualNumber<double, 1> at(t);
    at.d[0] = 1;
    return torque(at).d[0];
  };
  EXPECT_NEAR(slope(0), 2.0 / 3, 1e-14);
  EXPECT_NEAR(slope(1), 9.0 / 7, 1e-14);
  EXPECT_NEAR(slope(1 - 1e-12), 9.0 / 7, 1e-10) << "the first derivative is continuous";
  EXPECT_NEAR(slope(3), 0, 1e-14);
  EXPECT_NEAR(torque(2.0), 3 + 2 * (9.0 / 7) / 8, 1e-14) << "Hermite's formula in the middle of a piece";
  double before = torque(0.0);
  for (int i = 1; i <= 400; ++i) {
    const double now = torque(0.01 * i);
    EXPECT_GE(now, before - 1e-15) << i;
    before = now;
  }
  EXPECT_EQ(before, 5);
  EXPECT_EQ(torque.kinks(), (std::vector<double>{1, 3}));
}

TEST_F(Tables, MistakesAreNamedWithTheirLine) {
  EXPECT_TRUE(contains(refusal(), "torque.csv' cannot be read: No such file"));
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "torque.csv: it is empty"},
      {"t,moment\n0,1\n1,2\n", "unknown column 'M'; did you mean"},
      {"t,M,M\n0,1,1\n1,2,2\n", "2 columns are called 'M'"},
      {"t,M\n0,1\n1,two\n", "torque.csv:3: M = 'two': a finite number"},
      {"t,M\n0,1\n1,nan\n", "torque.csv:3: M = 'nan': a finite number"},
      {"t,M\n0,1\n1,1e999\n", "torque.csv:3: M = '1e999': a finite number"},
      {"t,M\n0,1\n1,\n", "torque.csv:3: M = '': a finite number"},
      {"t,M\n0,1\n1,2\n1,3\n", "torque.csv:4: t = 1 is not later than 1 in line 3"},
      {"t,M\n0,1\n2,2\n# here\n1,3\n", "torque.csv:5: t = 1 is not later than 2 in line 3"},
      {"t,M\n0,1\n", "torque.csv: 1 row of numbers; at least 2"},
      {"t,M\n0,1\n0,5,2\n", "torque.csv:3: 3 cells; the line with the names has 2"},
      {"t,M\n0,1\n1\n", "torque.csv:3: 1 cells; the line with the names has 2"},
      {"t;M\n0;1\n1;2,5\n", "torque.csv:3: M = '2,5': a finite number with a decimal point"}};
  for (const auto& [text, part] : cases) {
    folder_.write("torque.csv", text);
    EXPECT_TRUE(contains(refusal(), part)) << text;
    EXPECT_EQ(refusal().find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace irk
