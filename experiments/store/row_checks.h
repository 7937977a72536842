// What a stored row must be, whoever has written it: its cells are of their columns' kinds, and its key is that of its
// settings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irk::store {

/// Seconds since 1970 of `2026-01-31T12:00:00Z`; 0 for other text.
std::uint32_t secondsOf(std::string_view date);

/// The number of a request to make runs again, from a cell of the column `remade`: `3`. Former versions stored its date
/// there: then the seconds since 1970, so that the next number is above all dates. 0 for an empty cell and other text.
std::uint32_t requestOf(std::string_view remade);

/// Checks the cells of a row against their columns: numbers, counts, dates, hashes and outcomes.
class CellKinds {
 public:
  explicit CellKinds(const std::vector<std::string>& columns);

  /// `error: '0.0x2' is no number`; empty if all cells are legal. `cells` as they are written; those behind the
  /// columns, and columns of free text, are not checked.
  std::string problemOf(const std::vector<std::string_view>& cells) const;

  enum class Kind { kText, kHash, kNumber, kNumbers, kCount, kDate, kRequest, kOutcome };

 private:
  std::vector<std::string> columns_;
  std::vector<Kind> kinds_;
};

/// Computes the keys of rows of runs.csv from their own columns. Rows of one series that follow each other cost little.
class RowKeys {
 public:
  explicit RowKeys(const std::vector<std::string>& columns);

  /// The key that specKey gives for the row's settings; nullopt if they are not those of a run that this program can
  /// make: an unknown scene, an illegal value.
  std::optional<std::uint64_t> keyOf(const std::vector<std::string_view>& cells);

 private:
  bool isOfSeries(const std::vector<std::string_view>& cells) const;
  void readSeries(const std::vector<std::string_view>& cells);

  std::vector<std::size_t> at_;       // the column of each field of a spec
  std::vector<std::string> fixed_;    // the last row's cells; empty for fields that change within a series
  std::vector<std::string> between_;  // the text of a key before, between and behind the fields that change
  bool known_ = false;
};

}  // namespace irk::store
