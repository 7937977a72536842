#include "experiments/study/series_rules.h"

#include <fmt/format.h>

namespace irk {

bool ranTooLong(std::string_view outcome) {
  return outcome == name(Outcome::kMaxSteps) || outcome == name(Outcome::kTimeout);
}

RunRecord withoutMachine(RunRecord record) {
  if (record.outcome != name(Outcome::kTimeout)) return record;
  record.counters = {};
  record.detail = fmt::format("longer than {} s", record.spec.time_limit);
  return record;
}

RunRecord notMade(const RunSpec& spec, const TableRow& easier, const Table& table) {
  RunRecord record;
  record.spec = spec;
  record.family = textAt(table, easier, "family");
  record.stages = static_cast<Index>(numberAt(table, easier, "stages"));
  record.outcome = textAt(table, easier, "outcome");
  record.detail = fmt::format("not run: rtol = {} took too long already", textAt(table, easier, "rtol"));
  return record;
}

}  // namespace irk
