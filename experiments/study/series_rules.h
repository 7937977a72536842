// When the later runs of a series need not be made.
#pragma once

#include "experiments/runs/run_table.h"

namespace irk {

/// `max_steps` or `timeout`: a run that is harder would end in the same way.
bool ranTooLong(std::string_view outcome);

/// How far a run came until its time was over depends on the machine: that is left out of tables.
RunRecord withoutMachine(RunRecord record);

/// The record of a run that was not made because an easier one took too long.
RunRecord notMade(const RunSpec& spec, const TableRow& easier, const Table& table);

}  // namespace irk
