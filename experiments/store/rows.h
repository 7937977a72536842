// All rows of one kind that a study has stored; for each key one of them is valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "experiments/store/entry.h"
#include "experiments/store/part.h"
#include "experiments/tables/table.h"

namespace irk::store {

/// The number that the hexadecimal text `0123456789abcdef` stands for.
std::uint64_t keyNumber(std::string_view key);

/// Seconds since 1970 of `2026-01-31T12:00:00Z`; 0 for other text.
std::uint32_t secondsOf(std::string_view date);

/// The rows of parts/<name>.*.csv by the key in their first column, 16 hexadecimal digits or fewer. If several rows
/// have one key, one of them is valid, by these criteria in order:
///   1. made by this program's code;
///   2. the last request to make it again (`--fresh`: column `remade`);
///   3. measured by the timing pass (column `cpu_runs`);
///   4. written later: in the part that was begun later (partsInOrder), or further down in it.
/// No date decides, because a clock can be set back: the number of a new part is one above all that its writer has
/// read. Writers that did not see each other's parts may have equal numbers; then the names of the parts decide.
/// Reading takes one pass over the parts and keeps one Entry per key: about 72 bytes of memory. Not thread-safe.
class Rows {
 public:
  /// `code` is the fingerprint of this program.
  Rows(const std::filesystem::path& folder, std::string name, std::vector<std::string> columns, std::string_view code);
  ~Rows();

  /// Reads all parts. kSetAside copies unreadable lines to parts/<part>.damaged and reports new ones, kReport reports
  /// all, with a line on `messages`, as for parts with other columns. Throws Failure.
  enum class Damage { kReport, kSetAside };
  void read(Damage damage, std::ostream& messages);

  /// `runs`, `states`, ...
  const std::string& kind() const { return name_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t size() const { return index_.size(); }
  /// The valid row of this key, if there is one.
  std::optional<Entry> find(std::uint64_t key) const;
  bool isCurrent(const Entry& entry) const { return entry.code == current_; }
  /// Criteria 1 to 3. Those of several Rows can be compared; the order of criterion 4 is known within one only.
  std::tuple<bool, std::uint32_t, bool> merit(const Entry& entry) const {
    return {isCurrent(entry), entry.request, entry.repetitions > 0};
  }
  const std::string& name(std::uint16_t id) const { return names_[id]; }
  TableRow row(const Entry& entry) const;
  /// The cells of `row` as they are written, with commas between them: what csvLine(row) gives, in less time.
  std::string csv(const Entry& entry) const;

  /// The row is in the file when this returns; the destructor flushes it to the device. Throws Failure.
  void append(const TableRow& row);

  /// Visits every entry, in the order of the parts and of the rows in them.
  void forEach(const std::function<void(const Entry&)>& take) const;
  /// The number of lines that could not be read.
  std::size_t damaged() const { return damaged_; }

 private:
  struct Columns;
  bool better(const Entry& a, const Entry& b) const;
  void put(const Entry& entry);
  std::optional<Entry> entryOf(const std::vector<std::string_view>& cells);
  std::uint16_t idOf(std::string_view name);
  void readOne(const std::filesystem::path& file, std::uint32_t part, Damage damage, std::ostream& messages);
  int descriptor(std::uint32_t part) const;
  std::string_view readBlock(const Entry& entry, std::size_t size) const;
  std::string_view line(const Entry& entry) const;

  /// The bytes of a part that were read last.
  struct Block {
    std::uint32_t part = 0;
    std::uint64_t begin = 0;
    std::string bytes;

    /// From the row's first byte on; empty if that is not in the block.
    std::string_view from(const Entry& entry) const {
      const bool has = entry.part == part && entry.offset >= begin && entry.offset - begin < bytes.size();
      return has ? std::string_view(bytes).substr(entry.offset - begin) : std::string_view();
    }
    /// Whether the row begins in the block or shortly behind it.
    bool isBefore(const Entry& entry) const {
      const std::uint64_t end = begin + bytes.size();
      return entry.part == part && entry.offset >= begin && entry.offset <= end + bytes.size();
    }
  };

  std::filesystem::path folder_;
  std::string name_;
  std::vector<std::string> columns_;
  std::unique_ptr<Columns> at_;
  std::vector<std::filesystem::path> parts_;
  std::vector<std::string> names_;
  std::uint16_t current_;
  std::unordered_map<std::uint64_t, Entry> index_;  // the valid rows by their keys
  std::optional<PartWriter> writer_;                // since the first row was appended
  std::size_t damaged_ = 0;
  mutable std::vector<int> descriptors_;  // one for each of parts_; -1 = closed
  mutable std::size_t open_ = 0;
  mutable Block block_;
};

}  // namespace irk::store
