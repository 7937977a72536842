// The rows of a runs.csv by their blocks, so that the table may be larger than the memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/tables/table_rows.h"

namespace irk::claims {

/// Memory holds 16 bytes for each piece of the file whose rows have the same blocks and follow each other. Not
/// thread-safe.
class BlockFile {
 public:
  /// Reads the file once. Throws Misuse for a table without the column of blocks, and what readTable throws.
  explicit BlockFile(const std::filesystem::path& file);

  /// Head and columns, no rows.
  const Table& names() const { return file_.names(); }
  /// Reads the rows, in their order, whose cell of blocks the test accepts.
  void forEachRow(const std::function<bool(const std::string& blocks)>& wanted,
                  const std::function<void(TableRow row)>& take);

 private:
  struct Piece {
    std::uint64_t begin;
    std::uint32_t blocks, rows;
  };
  TableFile file_;
  std::vector<std::string> blocks_;  // different cells
  std::vector<Piece> pieces_;
};

}  // namespace irk::claims
