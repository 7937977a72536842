// All rows of one kind that a study has ever been given, and which of them counts.
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
#include <unordered_map>
#include <vector>

#include "experiments/store/part.h"
#include "experiments/tables/table.h"

namespace irk::store {

/// What the store knows of a row without reading it again: 40 bytes, whatever the row's length. `code`,
/// `environment`, `cpu_environment`, `outcome`: as `Rows::name` says; 0 is the empty text.
struct Entry {
  std::uint64_t key = 0, offset = 0;
  std::uint32_t part = 0;
  std::uint32_t date = 0, remade = 0;  ///< seconds since 1970; 0: none
  std::uint16_t repetitions = 0;       ///< of the timing pass
  std::uint16_t code = 0, environment = 0, cpu_environment = 0, outcome = 0;
};

/// Seconds since 1970 of `2026-01-31T12:00:00Z`; 0 for other text.
std::uint32_t secondsOf(std::string_view date);

/// What the writer of a folder is called: date, host and process, in the order in which they sort.
std::string writerName();

/// The rows of parts/<name>.*.csv, by their first column, 16 hexadecimal digits or fewer. Of several rows of one key one
/// counts, by this rule:
///   1. made by this program's code, before all others;
///   2. the one asked for anew last (`--fresh`: column `remade`);
///   3. one that the timing pass has measured (column `cpu_runs`);
///   4. the later date; of one second the one in the later part, or further down in it.
/// Reading needs one pass over the parts and keeps one Entry per key. Not thread-safe.
class Rows {
 public:
  /// `code`: of this program.
  Rows(std::filesystem::path folder, std::string name, std::vector<std::string> columns, std::string_view code);
  ~Rows();

  /// Reads all parts; where there is none, the exported <name>.csv. kSetAside: what cannot be read is copied to
  /// parts/<part>.damaged. Each new damage, and parts with other columns, are a line on `messages`. Throws Failure.
  enum class Damage { kReport, kSetAside };
  void read(Damage damage, std::ostream& messages);

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t size() const { return sorted_.size() + added_.size(); }
  /// Null where there is none. Valid until the next append.
  const Entry* find(std::uint64_t key) const;
  bool isCurrent(const Entry& entry) const { return entry.code == current_; }
  const std::string& name(std::uint16_t id) const { return names_[id]; }
  TableRow row(const Entry& entry) const;
  /// As it is written, without its end.
  std::string line(const Entry& entry) const;

  /// On disk when it returns; flushed to the device at the end. Throws Failure.
  void append(const TableRow& row);

  /// Every entry, in no order.
  void forEach(const std::function<void(const Entry&)>& take) const;
  /// Lines that could not be read.
  std::size_t damaged() const { return damaged_; }

 private:
  struct Columns;
  bool better(const Entry& a, const Entry& b) const;
  std::optional<Entry> entryOf(const std::vector<std::string_view>& cells);
  std::uint16_t idOf(std::string_view name);
  void readOne(const std::filesystem::path& file, std::uint32_t part, Damage damage, std::ostream& messages);
  void keepBest();
  int descriptor(std::uint32_t part) const;

  std::filesystem::path folder_;
  std::string name_;
  std::vector<std::string> columns_;
  std::unique_ptr<Columns> at_;
  std::vector<std::filesystem::path> parts_;
  std::vector<std::string> names_;
  std::uint16_t current_;
  std::vector<Entry> sorted_;                       // by key, one each
  std::unordered_map<std::uint64_t, Entry> added_;  // of keys that sorted_ does not have
  PartWriter writer_;
  std::size_t damaged_ = 0;
  mutable std::vector<int> descriptors_;  // of parts_; -1: closed
  mutable std::size_t open_ = 0;
};

}  // namespace irk::store
