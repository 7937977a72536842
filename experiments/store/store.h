// The stored rows of one study: part files, to which rows are only ever appended, and the tables exported from them.
//
//   results/<study>/lock                        held by the current writer
//                   parts/runs.<writer>.csv     rows of one process; likewise states and environments
//                   parts/runs.<writer>.damaged lines that could not be read
//                   runs.csv, states.csv, environments.csv   for people and gnuplot: the study's runs in its order
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "experiments/store/lock.h"
#include "experiments/store/rows.h"
#include "experiments/study/blocks.h"
#include "experiments/tables/table.h"

namespace irk::store {

enum class FinishedRuns { kKeep, kRunAgain };
/// How to treat rows that other code has made.
enum class StaleRows { kKeep, kRemake };
/// The times that are valid: all, or those that were measured on this processor.
enum class Times { kAll, kHere };
/// kJoin: an MPI rank that writes parts of its own while rank 0 holds the lock.
enum class Use { kRead, kWrite, kJoin };

struct StoreOptions {
  FinishedRuns finished = FinishedRuns::kKeep;
  StaleRows stale = StaleRows::kKeep;
  Times times = Times::kAll;
  IfLocked if_locked = IfLocked::kRefuse;
};

/// The head entry of a runs.csv whose times are left out because they come from several processors. Its value names
/// them.
inline constexpr std::string_view kTimesRefused = "times refused";

/// Reads and writes the rows of one study. Not thread-safe.
class Store {
 public:
  /// kWrite takes the folder's lock. A runs.csv of a former version, or without parts, is adopted or kept under
  /// another name. Throws Failure, std::filesystem::filesystem_error.
  Store(std::filesystem::path folder, std::string study, Use use, const StoreOptions& options, std::ostream& messages);

  const std::filesystem::path& folder() const { return folder_; }
  const Rows& runs() const { return runs_; }
  const Rows& environments() const { return environments_; }
  const StoreOptions& options() const { return options_; }

  /// Returns nullptr if the run has to be made: it has no row, its row is stale and to be remade, or --fresh was
  /// given.
  const Entry* finished(std::uint64_t key) const;
  bool hasState(std::uint64_t key) const { return states_.find(key) != nullptr; }

  /// Stores a run that was made now; fills in the column `remade`.
  void addRun(TableRow row);
  /// Stores a row with new times; drops its cell of blocks.
  void addTimes(TableRow row);
  void addState(const std::string& key, const std::string& state);
  /// Copies the rows of `other` that this store does not have. Returns the number of copied runs.
  std::size_t takeOver(const Store& other);

  /// The processor of an environment; `unknown` if there is none.
  std::string processor(std::string_view environment) const;
  /// Whether the times of the valid row were measured on this processor.
  bool timedHere(const Entry& entry) const;

  /// Sets the block names for exported tables; without names these have no block column.
  void nameBlocks(BlockNames names) { blocks_ = std::move(names); }

  /// Writes runs.csv, environments.csv and, if there are states, states.csv: the rows of these keys in this order.
  /// Each file is written beside its target and renamed. Returns the reason if times of several processors are
  /// refused, or an empty text.
  std::string exportTables(std::span<const std::uint64_t> keys);

 private:
  void addEnvironment();
  void adoptFormerTable(std::ostream& messages);
  TableHead head(std::span<const std::uint64_t> keys, const std::string& refusal) const;
  std::string refusalOfTimes(std::span<const std::uint64_t> keys) const;
  void exportRuns(std::span<const std::uint64_t> keys, const std::string& refusal) const;
  void exportStates(std::span<const std::uint64_t> keys) const;
  void exportEnvironments() const;

  std::filesystem::path folder_;
  std::string study_;
  StoreOptions options_;
  std::string started_;
  std::optional<Lock> lock_;
  Rows runs_, states_, environments_;
  BlockNames blocks_;
};

/// The number that the hexadecimal text `0123456789abcdef` stands for.
std::uint64_t keyNumber(std::string_view key);

}  // namespace irk::store
