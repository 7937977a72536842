#include "experiments/store/facts.h"

#include "experiments/runs/run_table.h"

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

}  // namespace irk::store
