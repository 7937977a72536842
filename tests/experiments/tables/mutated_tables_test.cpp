// Mutated tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "experiments/store/checksum.h"
#include "experiments/store/part.h"
#include "experiments/tables/table.h"
#include "tests/experiments/support.h"
#include "tests/mutate.h"

namespace irk {
namespace {

const std::string kTableSeeds[] = {
    "# study: small\n# version: 1\nkey,a,b\n0123456789abcdef,1,2\n00000000000000aa,\"x,y\",3\nff,,nan\n",
    "key,a,b\r\n01,\"say \"\"no\"\"\",1e-3\r\n02,\"two\nlines\",4\r\n"};
const std::string kTablePieces[] = {
    "\"", "\"\"", ",", "\n", "\r\n", "#", "# a", "key,a,b\n", "nan", std::string(1, '\0'), "\xff", "ff,1,2\n"};

class MutatedTables : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& text) const {
    const auto file = folder_.path() / "table.csv";
    std::filesystem::remove(file);  // ext4 waits for the disk where a file is truncated and written again
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  TemporaryFolder folder_;
};

// Reading gives a table with complete rows, or a misuse that names the file.
TEST_F(MutatedTables, AreReadOrRefused) {
  const auto [read, refused] = test::readMutated(test::Mutations(kTableSeeds, kTablePieces, 20043), 20'000, "table.csv",
                                                 [this](const std::string& text) {
                                                   const Table table = readTable(written(text));
                                                   for (const auto& row : table.rows)
                                                     EXPECT_EQ(row.size(), table.columns.size()) << text;
                                                 });
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

// In a part, no row is read that was not written.
TEST_F(MutatedTables, PartsGiveWholeRowsOnly) {
  const std::vector<std::string> columns{"key", "a", "b"};
  const std::vector<TableRow> written_rows{{"0123456789abcdef", "1", "2"}, {"aa", "x,y", "3"}, {"ff", "", "nan"}};
  std::string part = store::sealedNames(csvLine(columns)) + '\n';
  for (const auto& row : written_rows) part += store::sealedRow(csvLine(row)) + '\n';
  const std::string seeds[] = {part};
  test::Mutations mutations(seeds, kTablePieces, 20044);
  int rows = 0, damaged = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto file = written(mutations.next());
    const auto reading = store::readPart(file, columns, [&](const auto& cells, std::uint64_t) {
      EXPECT_EQ(std::count(written_rows.begin(), written_rows.end(), plainRow(cells)), 1);
      ++rows;
      return std::string();
    });
    damaged += static_cast<int>(reading.damaged.size());
  }
  EXPECT_GT(rows, 10'000);
  EXPECT_GT(damaged, 1000);
}

}  // namespace
}  // namespace irk
