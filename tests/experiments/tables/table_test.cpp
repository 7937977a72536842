#include "experiments/tables/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/table_rows.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

Table sample() {
  return {{{"study", "order"}, {"flags", "-O3: all"}},
          {"key", "value", "detail"},
          {{"a", "1", "plain"}, {"b", "nan", "a \"quoted\", comma"}, {"c", "3", "two\nlines"}, {"d", "", "empty"}}};
}

TEST(Table, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "deep" / "runs.csv";
  writeTable(path, sample());
  const Table back = readTable(path);
  EXPECT_EQ(back.head, sample().head);
  EXPECT_EQ(back.columns, sample().columns);
  EXPECT_EQ(back.rows, sample().rows);
}

TEST(Table, QuotesAsRfc4180Says) { EXPECT_EQ(csvLine({"a", "b,c", "say \"x\"", ""}), "a,\"b,c\",\"say \"\"x\"\"\","); }

TEST(Table, SplitsTheLineThatIsWritten) {
  const TableRow row{"a", "b,c", "say \"x\"", "", "\"", ","};
  std::vector<std::string_view> cells;
  const std::string line = csvLine(row);
  ASSERT_TRUE(splitLine(line, cells));
  EXPECT_EQ(plainRow(cells), row);
  for (const char* damaged : {"a,\"b,c", "a,b\"c", "\"a\"b,c", "\"", "a,\"\"\""}) {
    EXPECT_FALSE(splitLine(damaged, cells)) << damaged;
  }
}

TEST(Table, IsWrittenRowByRow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "deep" / "runs.csv", whole = folder.path() / "whole.csv";
  writeTable(whole, sample());
  {
    TableWriter writer(path, sample().head, sample().columns);
    for (const auto& row : sample().rows) writer.add(row);
    EXPECT_FALSE(std::filesystem::exists(path)) << "not before it is whole";
    writer.close();
  }
  EXPECT_EQ(readInputFile(path), readInputFile(whole));
  {
    TableWriter given_up(path, {}, {"other"});
    given_up.add({"1"});
  }
  EXPECT_EQ(readInputFile(path), readInputFile(whole));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1) << "nothing is left beside";
  EXPECT_THROW(TableWriter("/dev/full/runs.csv", {}, {"key"}), std::exception);
}

TEST(Table, RowsAreReadFromWhereTheyBegin) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "runs.csv";
  writeTable(path, sample());
  TableFile file(path);
  EXPECT_EQ(file.names().head, sample().head);
  std::vector<std::uint64_t> begins;
  for (begins.push_back(file.position()); file.next(); begins.push_back(file.position())) {
  }
  ASSERT_EQ(begins.size(), sample().rows.size() + 1);
  std::filesystem::remove(path);  // it stays open
  for (const std::size_t i : {3u, 0u, 2u, 2u, 1u}) {
    file.seek(begins[i]);
    EXPECT_EQ(file.next(), sample().rows[i]);
    EXPECT_EQ(file.position(), begins[i + 1]);
  }
  file.seek(begins.back());
  EXPECT_EQ(file.next(), std::nullopt);
  file.seek(begins[1]);
  EXPECT_EQ(file.next(), sample().rows[1]) << "behind the end, too";
}

// One row at a time, they are those of the whole table.
TEST(Table, RowsTakeNoMoreMemoryThanTheirCells) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "runs.csv";
  Table wide = sample();
  for (int i = 0; i < 70; ++i) {
    wide.columns.push_back("column_" + std::to_string(i));
    for (auto& row : wide.rows) row.emplace_back();
  }
  writeTable(path, wide);
  for (const auto& row : readTable(path).rows) EXPECT_EQ(row.capacity(), wide.columns.size());
  std::vector<TableRow> rows;
  const Table names = forEachRow(path, [&rows](const Table& head, TableRow row) {
    EXPECT_EQ(textAt(head, row, "column_3"), "");
    rows.push_back(std::move(row));
  });
  EXPECT_EQ(rows, wide.rows);
  EXPECT_EQ(names.head, wide.head);
  EXPECT_EQ(names.columns, wide.columns);
  EXPECT_TRUE(names.rows.empty());
}

TEST(Table, DropsAHalfWrittenLastRow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "runs.csv";
  writeTable(path, sample());
  const std::string whole = readInputFile(path);
  // Cuts the last row short at every position, its line end included.
  const std::size_t last_row = whole.rfind("d,");
  for (std::size_t length = last_row; length < whole.size(); ++length) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_EQ(readTable(path).rows.size(), 3u) << length;
  }
}

TEST(Table, AppendedRowsAreThereAtOnce) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "runs.csv";
  RowWriter writer(path, sample());
  writer.append({"e", "5", "more"});
  const Table back = readTable(path);
  ASSERT_EQ(back.rows.size(), 5u);
  EXPECT_EQ(back.rows.back(), (TableRow{"e", "5", "more"}));
}

TEST(Table, RefusesDamageInTheMiddle) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "runs.csv";
  std::ofstream(path) << "# study: x\na,b\n1,2\n3\n4,5\n";
  EXPECT_TRUE(containsAll(misuseOf([&] { readTable(path); }), {"runs.csv:4", "1 cells", "2"}));
  std::ofstream(path) << "a,b\n1,2\n3,x\"y\"\n4,5\n";
  EXPECT_TRUE(containsAll(misuseOf([&] { readTable(path); }), {"runs.csv:3", "quote", "unbalanced"}));
  std::ofstream(path) << "a,b\n1,\"2\n3,4\n5,6\n";
  EXPECT_TRUE(containsAll(misuseOf([&] { readTable(path); }), {"runs.csv:2", "quote has no end"}));
  EXPECT_TRUE(containsAll(misuseOf([&] { readTable(folder.path() / "no.csv"); }), {"no.csv"}));
  EXPECT_TRUE(containsAll(misuseOf([] { (void)sample().column("valu"); }), {"valu", "'value'"}));
}

TEST(Numbers, TextKeepsAllBits) {
  for (const double x : {0.1, 1.0 / 3, -2.5e-308, 1e300, 0.0}) {
    EXPECT_EQ(cellNumber(numberText(x)), x);
  }
  EXPECT_EQ(numberText(std::nan("")), "nan");
  EXPECT_TRUE(std::isnan(cellNumber("nan")));
  EXPECT_TRUE(std::isnan(cellNumber("1.5 m")));
}

TEST(Numbers, HashIsFnv1a) {
  // Test vectors of the FNV specification.
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace irk
