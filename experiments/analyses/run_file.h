// runs.csv as analyses read it: one series at a time, so that a table may be larger than the memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/tables/table_rows.h"

namespace irk {

/// A series (seriesOf) with its rows.
struct HeldSeries {
  std::vector<TableRow> rows;
  RunSeries series;  ///< points to `rows`

  HeldSeries() = default;
  HeldSeries(HeldSeries&&) = default;
  HeldSeries& operator=(HeldSeries&&) = default;
};

/// The series that seriesOf finds in a runs.csv. Memory holds 44 bytes per series, 24 more for each further piece of
/// one whose rows do not follow each other, and the rows of the series in use. Not thread-safe. Throws what readTable
/// throws.
class RunFile {
 public:
  /// Reads the file once.
  explicit RunFile(const std::filesystem::path& file);

  /// Head and columns, no rows.
  const Table& names() const { return file_.names(); }
  std::size_t rows() const { return rows_; }
  void forEachRow(const std::function<void(const TableRow&)>& take) const;

  /// The number of series.
  std::size_t size() const { return first_.size() - 1; }
  /// Series i. Throws Failure if the hash of its name is also that of another series.
  HeldSeries operator[](std::size_t i) const;
  void forEachSeries(const std::function<void(const RunSeries&)>& take) const;

  /// The number of the series with these cells of seriesColumns.
  std::optional<std::size_t> find(const TableRow& name) const;
  /// The cells of seriesColumns in a row.
  TableRow nameOf(const TableRow& row) const;

 private:
  /// Rows of one series that follow each other in the file.
  struct Piece {
    std::uint64_t series;  // where its first row begins
    std::uint64_t begin;
    std::uint32_t rows;
  };
  struct Name {
    std::uint64_t hash;
    std::uint64_t series;  // as above
  };
  void findPieces();
  void group();

  mutable TableFile file_;
  std::uint64_t start_;             // of the first row
  std::vector<std::size_t> cells_;  // places of seriesColumns in a row
  std::size_t rows_ = 0;
  std::vector<Piece> pieces_;         // by series, then in the order of the file
  std::vector<std::uint32_t> first_;  // number of each series' first piece, and of all pieces
  std::vector<Name> names_;           // by hash
};

}  // namespace irk
