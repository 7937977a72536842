// Draws a figure from a synthetic table and reads its curves.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/report/report.h"
#include "experiments/tables/table.h"
#include "tests/experiments/report/answer_tables.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {

inline constexpr AxisScale kLog = AxisScale::kLogarithmic, kLin = AxisScale::kLinear;

inline std::string exact(double x) { return fmt::format("{}", x); }

/// A folder with tables and the figures drawn from them.
class Drawing {
 public:
  /// Writes what tableOf makes.
  void put(const std::string& name, const std::vector<std::string>& columns, const std::vector<Cells>& rows,
           const std::string& other = "nan", const TableHead& head = {{"study", "made_up"}}) {
    writeTable(folder_.path() / name, tableOf(columns, rows, other, head));
  }

  /// Writes a table that is given as it stands in the file, below its head.
  void put(const std::string& name, const std::string& csv) const { folder_.write(name, "# study: made_up\n" + csv); }

  Svg draw(const std::string& script, const std::string& options) {
    const auto out = folder_.path() / fmt::format("figure_{}", ++count_);
    std::ostringstream err;
    EXPECT_TRUE(drawFigure(script,
                           fmt::format("data='{}'; out='{}'; {}", folder_.path().string(), out.string(), options),
                           IRK_SOURCE_DIR, err))
        << err.str();
    EXPECT_EQ(err.str(), "") << script;
    EXPECT_TRUE(std::filesystem::exists(out.string() + ".png")) << script;
    return Svg(out.string() + ".svg");
  }

 private:
  TemporaryFolder folder_;
  int count_ = 0;
};

/// Whether the figure has each of the texts.
inline testing::AssertionResult says(const Svg& svg, const std::vector<std::string>& parts) {
  for (const auto& part : parts) {
    if (svg.occurrences(part) == 0) return testing::AssertionFailure() << "no \"" << part << "\" in the figure";
  }
  return testing::AssertionSuccess();
}

inline const std::vector<std::string> kRunColumns = {"key",
                                                     "scene",
                                                     "settings",
                                                     "method",
                                                     "family",
                                                     "stages",
                                                     "integrator",
                                                     "formulation",
                                                     "scaling",
                                                     "discontinuity",
                                                     "scalar",
                                                     "newton",
                                                     "h",
                                                     "rtol",
                                                     "atol",
                                                     "outcome",
                                                     "error",
                                                     "error_u",
                                                     "error_v",
                                                     "error_x",
                                                     "error_z",
                                                     "drift",
                                                     "residuals",
                                                     "dual_residuals",
                                                     "jacobians",
                                                     "factorizations",
                                                     "solves",
                                                     "newton_iterations",
                                                     "newton_restarts",
                                                     "steps_accepted",
                                                     "steps_rejected_error",
                                                     "cpu_s",
                                                     "cpu_setup_s",
                                                     "cpu_median_s",
                                                     "cpu_spread",
                                                     "detail"};

// A value for run i that differs between columns, and increases or decreases differently with i.
inline double numberOf(const std::string& column, int i) {
  const auto place = std::find(kRunColumns.begin(), kRunColumns.end(), column) - kRunColumns.begin();
  const double j = static_cast<double>(place);
  const double slope = column.starts_with("error") || column == "drift" ? -0.8 - 0.03 * j : 0.1 + 0.02 * j;
  const double level = column.starts_with("error") || column == "drift" ? 1e-2 : 1;
  return level * (1 + 0.13 * j) * std::pow(10, slope * i);
}

inline Cells run(int i, const Cells& cells) {
  Cells row = cells;
  for (const auto& column :
       {"error", "error_u", "error_v", "error_x", "error_z", "drift", "residuals", "dual_residuals", "jacobians",
        "factorizations", "solves", "newton_iterations", "newton_restarts", "steps_accepted", "steps_rejected_error",
        "cpu_s", "cpu_setup_s", "cpu_median_s", "cpu_spread"}) {
    row.try_emplace(column, exact(numberOf(column, i)));
  }
  row.try_emplace("outcome", "success");
  row.try_emplace("settings", "");
  row.try_emplace("rtol", exact(1e-3 * std::pow(0.1, i)));
  row.try_emplace("atol", exact(3e-3 * std::pow(0.1, i)));
  return row;
}

}  // namespace irk
