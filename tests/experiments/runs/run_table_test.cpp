#include "experiments/runs/run_table.h"

#include <gtest/gtest.h>

namespace irk {
namespace {

// A table of an older version with fewer columns is read with the columns that it has.
TEST(RunTable, OldTablesHaveTheirSeries) {
  Table runs{{}, {"scene", "method", "max_steps", "outcome"}, {}};
  runs.rows = {{"kepler", "gauss_2", "10", "success"},
               {"kepler", "gauss_2", "20", "success"},
               {"kepler", "gauss_2", "10", "timeout"}};
  EXPECT_EQ(seriesColumns(runs), (std::vector<std::string>{"scene", "method", "max_steps"}));
  const auto series = seriesOf(runs);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].rows.size(), 2u);
}

}  // namespace
}  // namespace irk
