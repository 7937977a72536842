// Rows of a table in a file, found by the cell of their first column.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "experiments/tables/table_rows.h"

namespace irk {

/// Memory holds 16 bytes per row. Not thread-safe. Throws what readTable throws.
class KeyedFile {
 public:
  /// Reads the file once.
  explicit KeyedFile(const std::filesystem::path& file);

  /// Head and columns, no rows.
  const Table& names() const { return file_.names(); }
  /// The last row with this key; nullopt if there is none.
  std::optional<TableRow> find(std::string_view key);

 private:
  struct Place {
    std::uint64_t hash, position;
  };
  TableFile file_;
  std::vector<Place> places_;  // sorted
};

}  // namespace irk
