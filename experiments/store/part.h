// Part files: CSV files to which one process appends, and which are never rewritten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::store {

/// A line that is not read, and why: its checksum is wrong, its cells are not those of the columns, the last line has
/// no line end, or `take` has refused its row.
struct DamagedLine {
  std::size_t line;  ///< counts from 1
  std::string text;
  std::string why;  ///< `its checksum is wrong`
};

struct PartReading {
  /// What the line of column names says; none of the rows are read unless it is kThese. kMissing: the file is empty.
  /// kDamaged: the line has no checksum, or a wrong one.
  enum class Names { kMissing, kThese, kOthers, kDamaged };
  Names names = Names::kMissing;
  std::vector<DamagedLine> damaged;
};

/// Takes a row: its cells as they are written, without the checksum, and the number of bytes before it. Returns why it
/// refuses the row, or an empty text.
using TakeWritten = std::function<std::string(const std::vector<std::string_view>& cells, std::uint64_t offset)>;

/// Calls `take` for every row in order. Each row is one line, so damage never spreads to other rows. Throws Failure if
/// the file cannot be read.
PartReading readPart(const std::filesystem::path& file, const std::vector<std::string>& columns,
                     const TakeWritten& take);

/// The number of a part, the second word of its name: 12 for `runs.0012.host.4711.csv`; 0 for other names.
std::uint64_t numberOfPart(const std::filesystem::path& part);

/// The name of a new part of this process without `.csv`: `runs.0012.host.4711`, the table, `number`, host and process.
std::string partName(std::string_view table, std::uint64_t number);

/// The parts <table>.*.csv in a folder, in the order in which they were begun: by their numbers, then by their names.
std::vector<std::filesystem::path> partsInOrder(const std::filesystem::path& folder, std::string_view table);

/// Appends rows with checksums to a file that belongs to this process and is created with the first row. Each row is
/// one write at the end of the file: a killed process leaves complete rows and at most one that is cut short. Not
/// thread-safe.
class PartWriter {
 public:
  /// The file is `name`.csv; if that exists, `name`_2.csv and so on.
  PartWriter(std::filesystem::path folder, std::string name, std::vector<std::string> columns);
  ~PartWriter();
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;

  /// Returns the offset of the row in bytes. Line ends inside cells become blanks. Throws Failure, for example if the
  /// disk is full; no row is written behind one that is cut short.
  std::uint64_t append(const TableRow& row);
  /// Empty before the first row is written.
  const std::filesystem::path& file() const { return file_; }

 private:
  void open();
  void write(const std::string& text);

  std::filesystem::path folder_, file_;
  std::string name_;
  std::vector<std::string> columns_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool failed_ = false;
};

}  // namespace irk::store
