#include "experiments/store/facts.h"

#include "experiments/runs/run_table.h"
#include "experiments/tables/timing_class.h"

namespace irk::store {

RunFacts factsOf(const Rows& runs, const Entry& entry, bool planned) {
  RunFacts facts{runs.name(entry.outcome)};
  if (!planned) return facts;
  const Table names{{}, runs.columns(), {}};
  const TableRow row = runs.row(entry);
  const auto error = [&](const char* name) { return numberAt(names, row, name); };
  facts.errors = {error("error_u"), error("error_v"), error("error_x"), error("error_z")};
  return facts;
}

TimingClasses::TimingClasses(const Rows& runs, const Rows& environments)
    : runs_(runs), environments_(environments), method_(Table{{}, runs.columns(), {}}.column("method")) {}

const RowClass& TimingClasses::of(const Entry& entry) {
  const bool is_one = environments_.size() <= 1;
  const std::string library(is_one ? "" : libraryOfMethod(runs_.row(entry)[method_]));
  const auto [at, added] =
      known_.try_emplace({entry.cpu_environment, library}, RowClass{"unknown", library, "unknown"});
  if (!added) return at->second;
  const auto environment = environments_.find(keyNumber(runs_.name(entry.cpu_environment)));
  if (!environment) return at->second;
  const auto classWith = [&](const std::string& with) {
    return timingClass(environments_.columns(), environments_.row(*environment), with);
  };
  at->second.machine = classWith("");
  at->second.name = classWith(library);
  return at->second;
}

}  // namespace irk::store
