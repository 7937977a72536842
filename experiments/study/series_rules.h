// Rules by which later runs of a series are skipped.
#pragma once

#include "experiments/runs/run_table.h"

namespace irk {

/// True for `max_steps` and `timeout`. After two such runs in a row harder ones are not made.
bool ranTooLong(std::string_view outcome);

/// Removes counters and details of a run that timed out, because they depend on the speed of the machine.
RunRecord withoutMachine(RunRecord record);

/// The record of a run that is skipped because easier ones took too long, `easier` the last of them.
RunRecord notMade(const RunSpec& spec, const TableRow& easier, const Table& table);

}  // namespace irk
