// What is known of one study: parts to which rows are only ever added, and the tables that are exported from them.
//
//   results/<study>/lock                        who writes here now
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
/// Of rows that other code has made.
enum class StaleRows { kKeep, kRemake };
/// Which times count: all, or those that were measured on this processor.
enum class Times { kAll, kHere };
/// kJoin: a rank of MPI writes parts of its own while rank 0 holds the lock.
enum class Use { kRead, kWrite, kJoin };

struct StoreOptions {
  FinishedRuns finished = FinishedRuns::kKeep;
  StaleRows stale = StaleRows::kKeep;
  Times times = Times::kAll;
  IfLocked if_locked = IfLocked::kRefuse;
};

/// The head entry of a runs.csv whose times are left out, as they are of several processors; its value says which.
inline constexpr std::string_view kTimesRefused = "times refused";

/// Not thread-safe.
class Store {
 public:
  /// kWrite takes the folder's lock. A runs.csv of a former version, or without parts, is taken in or kept under another
  /// name. Throws Failure, std::filesystem::filesystem_error.
  Store(std::filesystem::path folder, std::string study, Use use, const StoreOptions& options, std::ostream& messages);

  const std::filesystem::path& folder() const { return folder_; }
  const Rows& runs() const { return runs_; }
  const Rows& environments() const { return environments_; }
  const StoreOptions& options() const { return options_; }

  /// Null where the run has to be made: there is no row, it is stale and to be remade, or all are to be made again.
  const Entry* finished(std::uint64_t key) const;
  bool hasState(std::uint64_t key) const { return states_.find(key) != nullptr; }

  /// A run that was made now; the column `remade` is filled in.
  void addRun(TableRow row);
  /// The row of a run with other times; a cell of blocks is left out.
  void addTimes(TableRow row);
  void addState(const std::string& key, const std::string& state);
  /// Takes over what another store has and this one has not. Returns the number of rows of runs.
  std::size_t takeOver(const Store& other);

  /// The processor of an environment; `unknown` if that is not known.
  std::string processor(std::string_view environment) const;
  /// Of the counting row's times: measured on this processor.
  bool timedHere(const Entry& entry) const;

  /// What exported tables say of blocks; without any names they have no such column.
  void nameBlocks(BlockNames names) { blocks_ = std::move(names); }

  /// Writes runs.csv, environments.csv, and states.csv where there are states: the rows of these keys in this order.
  /// Each is written beside its target and renamed. Returns the refusal of times of several processors, or nothing.
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

/// `0123456789abcdef` as a number.
std::uint64_t keyNumber(std::string_view key);

}  // namespace irk::store
