// The stored rows of one study: part files, to which rows are only ever appended, and the tables exported from them.
//
//   results/<study>/lock                        held by the current writer
//                   parts/runs.<number>.<host>.<process>.csv
//                                               rows of one process; likewise states, environments, calibrations and
//                                               timing_cores
//                   parts/….damaged             lines that could not be read
//                   runs.csv, states.csv, environments.csv, calibrations.csv, timing_cores.csv   for people and
//                                               gnuplot: the study's runs in its order
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>

#include "experiments/store/calibration.h"
#include "experiments/store/lock.h"
#include "experiments/store/rows.h"
#include "experiments/store/run_keys.h"
#include "experiments/tables/table.h"

namespace irk::store {

enum class FinishedRuns { kKeep, kRunAgain };
/// How to treat rows that other code has made.
enum class StaleRows { kKeep, kRemake };
/// Which times are valid: all, or only those that were measured on this processor.
enum class Times { kAll, kHere };
/// kJoin: an MPI rank that writes parts of its own while rank 0 holds the lock.
enum class Use { kRead, kWrite, kJoin };

struct StoreOptions {
  FinishedRuns finished = FinishedRuns::kKeep;
  StaleRows stale = StaleRows::kKeep;
  Times times = Times::kAll;
  IfLocked if_locked = IfLocked::kRefuse;
};

/// The head entry of a runs.csv whose times are left out because they are of several timing classes. Its value names
/// them.
inline constexpr std::string_view kTimesRefused = "times refused";

/// Reads and writes the rows of one study. Not thread-safe.
class Store {
 public:
  /// kWrite takes the folder's lock. Throws Misuse if the folder has a runs.csv with rows but no parts, Failure,
  /// std::filesystem::filesystem_error.
  Store(std::filesystem::path folder, std::string study, Use use, const StoreOptions& options, std::ostream& messages);

  const std::filesystem::path& folder() const { return folder_; }
  const Rows& runs() const { return runs_; }
  const Rows& environments() const { return environments_; }
  const Rows& calibrations() const { return calibrations_; }
  const StoreOptions& options() const { return options_; }

  /// The entry of a finished run. Nothing if the run has to be made: it has no row, its row is stale and to be remade,
  /// or --fresh was given.
  std::optional<Entry> finished(std::uint64_t key) const;
  bool hasState(std::uint64_t key) const { return states_.find(key).has_value(); }

  /// Stores a run that was made now; fills in the column `remade`: the number of the last request for the run.
  void addRun(TableRow row);
  /// Stores a row with new times; drops its cell of blocks.
  void addTimes(TableRow row);
  /// Stores a calibration that was measured here and now, in seconds.
  void addCalibration(double seconds);
  /// Stores a trial of cores that was made here and now.
  void addCores(const CoresTrial& trial);
  /// `bar`: the error bars of the state, which may be empty.
  void addState(const std::string& key, const std::string& state, const std::string& bar);
  /// Copies the rows of `other` that this store does not have, and runs with their states that are better: by the first
  /// three criteria of Rows, then one that has not run out of time, then by more repetitions of times. Returns the
  /// number of copied runs.
  std::size_t takeOver(const Store& other);

  /// Whether the times of the row are of this program's timing class (tables/timing_class.h).
  bool timedHere(const Entry& entry) const;

  /// Calls `take` for each of these runs that has a row, in their order, with the names of its blocks.
  using TakeRun = std::function<void(const Entry& entry, const std::string& blocks)>;
  void forEachRun(const RunKeys& keys, const TakeRun& take) const;

  /// Writes runs.csv, environments.csv and, if there are any, states.csv, calibrations.csv and timing_cores.csv: the
  /// rows of these keys in this order, with a column of blocks if the keys have them. Each file is written beside its
  /// target and renamed. Returns the reason if times of several timing classes are refused, or an empty text.
  std::string exportTables(const RunKeys& keys) const;

 private:
  void addEnvironment();
  struct Origins;
  Origins originsOf(const RunKeys& keys) const;
  TableHead head(const Origins& origins, const std::string& refusal) const;
  void exportRuns(const RunKeys& keys, const TableHead& head, bool times_refused) const;
  void exportStates(const RunKeys& keys) const;
  void exportAll(const Rows& rows) const;

  std::filesystem::path folder_;
  std::string study_;
  StoreOptions options_;
  std::uint32_t request_ = 0;  // the number of this request to make runs again; 0: there is none
  std::optional<Lock> lock_;
  Rows runs_, states_, environments_, calibrations_, timing_cores_;
};

}  // namespace irk::store
