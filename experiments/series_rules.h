// When the later runs of a series need not be made.
#pragma once

#include <array>
#include <limits>

#include "experiments/run_table.h"

namespace irk {

/// Steps are refined until every component has reached round-off: three runs in a row in which no
/// error has become smaller. Only where errors are small: before the asymptotic range they may
/// grow.
class RoundOffRule {
 public:
  explicit RoundOffRule(ScalarKind scalar);
  /// Takes the next run of the series; true: the rest is not needed.
  bool reached(const Table& table, const TableRow& row);

 private:
  double small_, epsilon_;
  std::array<double, 4> least_;
  std::array<int, 4> idle_{};
};

/// `max_steps` or `timeout`: a run that is harder would end in the same way.
bool ranTooLong(std::string_view outcome);

/// How far a run came until its time was over depends on the machine: that is left out of tables.
RunRecord withoutMachine(RunRecord record);

/// The record of a run that was not made because an easier one took too long.
RunRecord notMade(const RunSpec& spec, const TableRow& easier, const Table& table);

}  // namespace irk
