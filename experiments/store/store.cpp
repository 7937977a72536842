#include "experiments/store/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "experiments/runs/run_table.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table_rows.h"
#include "experiments/tables/timing_class.h"
#include "irk/misuse.h"
#include "irk/outcome.h"

namespace irk::store {
namespace {

constexpr const char* kTables[] = {"runs", "states", "environments", "calibrations", "timing_cores"};

std::vector<std::string> stateColumns() { return {"key", "state", "bar", "code", "date"}; }

// The number of a new request to make runs again: one above all former ones.
std::uint32_t nextRequest(const Rows& runs) {
  std::uint32_t last = 0;
  runs.forEach([&last](const Entry& entry) { last = std::max(last, entry.request); });
  return last + 1;
}

// An interrupt before the end of the first run leaves a table without rows and without parts.
void requireParts(const std::filesystem::path& folder) {
  const auto table = folder / "runs.csv";
  if (!partsInOrder(folder / "parts", kTables[0]).empty() || !std::filesystem::exists(table)) return;
  if (!TableFile(table).next()) return;
  throw Misuse(fmt::format(
      "{}: a table without its parts, {}: it was copied here, or they were removed. Its rows cannot be continued: copy "
      "the whole folder, or remove the table to make its runs again",
      table.string(), (folder / "parts" / "runs.*.csv").string()));
}

}  // namespace

Store::Store(std::filesystem::path folder, std::string study, Use use, const StoreOptions& options,
             std::ostream& messages)
    : folder_(std::move(folder)),
      study_(std::move(study)),
      options_(options),
      runs_(folder_, kTables[0], runColumns(), buildInfo().code),
      states_(folder_, kTables[1], stateColumns(), buildInfo().code),
      environments_(folder_, kTables[2], environmentColumns(), ""),
      calibrations_(folder_, kTables[3], calibrationColumns(), ""),
      timing_cores_(folder_, kTables[4], coresColumns(), "") {
  if (use == Use::kWrite) lock_.emplace(folder_, options.if_locked, messages);
  requireParts(folder_);
  const auto damage = use == Use::kWrite ? Rows::Damage::kSetAside : Rows::Damage::kReport;
  for (auto* rows : {&runs_, &states_, &environments_, &calibrations_, &timing_cores_}) rows->read(damage, messages);
  if (options_.finished == FinishedRuns::kRunAgain) request_ = nextRequest(runs_);
}

std::optional<Entry> Store::finished(std::uint64_t key) const {
  const auto entry = runs_.find(key);
  if (!entry) return {};
  if (options_.stale == StaleRows::kRemake && !runs_.isCurrent(*entry)) return {};
  const bool made_before = entry->request < request_ || !runs_.isCurrent(*entry);
  if (options_.finished == FinishedRuns::kRunAgain && made_before) return {};
  return entry;
}

void Store::addEnvironment() {
  const auto& environment = thisEnvironment();
  if (!environments_.find(keyNumber(environment.front()))) environments_.append(environment);
}

void Store::addTimes(TableRow row) {
  addEnvironment();
  row.resize(runs_.columns().size());
  runs_.append(row);
}

void Store::addCalibration(double seconds) {
  addEnvironment();
  calibrations_.append(calibrationRow(seconds));
}

void Store::addCores(const CoresTrial& trial) {
  addEnvironment();
  timing_cores_.append(coresRow(trial));
}

void Store::addRun(TableRow row) {
  addEnvironment();
  const std::uint64_t key = keyNumber(row.front());
  const auto before = runs_.find(key);
  const std::uint32_t request = std::max(request_, before ? before->request : 0);
  if (request > 0) row.back() = std::to_string(request);
  runs_.append(row);
}

void Store::addState(const std::string& key, const std::string& state, const std::string& bar) {
  states_.append({key, state, bar, std::string(buildInfo().code), dateText()});
}

std::size_t Store::takeOver(const Store& other) {
  const auto takeMissing = [](Rows& rows, const Rows& from) {
    from.forEach([&](const Entry& entry) {
      if (!rows.find(entry.key)) rows.append(from.row(entry));
    });
  };
  takeMissing(environments_, other.environments_);
  takeMissing(calibrations_, other.calibrations_);
  takeMissing(timing_cores_, other.timing_cores_);
  const auto rank = [](const Rows& rows, const Entry& entry) {
    const bool ended = rows.name(entry.outcome) != name(Outcome::kTimeout);
    return std::tuple(rows.merit(entry), ended, entry.repetitions);
  };
  std::size_t taken = 0;
  other.runs_.forEach([&](const Entry& entry) {
    const auto here = runs_.find(entry.key);
    const bool takes = !here || rank(other.runs_, entry) > rank(runs_, *here);
    const auto state = other.states_.find(entry.key);
    if (state && (takes || !hasState(entry.key))) states_.append(other.states_.row(*state));
    if (!takes) return;
    runs_.append(other.runs_.row(entry));
    ++taken;
  });
  return taken;
}

void Store::forEachRun(const RunKeys& keys, const TakeRun& take) const {
  keys.forEach([&](std::uint64_t key, const std::string& blocks) {
    if (const auto entry = runs_.find(key)) take(*entry, blocks);
  });
}

bool Store::timedHere(const Entry& entry) const {
  if (runs_.name(entry.cpu_environment) == thisEnvironment().front()) return true;
  const auto environment = environments_.find(keyNumber(runs_.name(entry.cpu_environment)));
  if (!environment) return false;
  const Table names{{}, runs_.columns(), {}};
  const auto library = libraryOfMethod(textAt(names, runs_.row(entry), "method"));
  const auto columns = environmentColumns();
  return timingClass(columns, environments_.row(*environment), library) ==
         timingClass(columns, thisEnvironment(), library);
}

}  // namespace irk::store
