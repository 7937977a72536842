// Where, when and by which program numbers were computed: heads of tables, and the rows of environments.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

/// The entries study, version, commit, compiler, flags, cpu, threads, date.
TableHead environmentHead(const std::string& study, int threads);

/// The columns of environments.csv: environment (its id), commit, version, host, cpu, cores, memory_gb, compiler,
/// flags, libraries, first_date.
std::vector<std::string> environmentColumns();
/// The row of this program on this machine. Its id is a hash of all cells except the date.
const TableRow& thisEnvironment();
/// The name of the processor.
const std::string& processorName();
std::string hostName();

/// The current time, UTC, in ISO 8601.
std::string dateText();

/// The folder that contains plots/: IRK_HOME, else that of an installed program (share/irk beside its bin), else the
/// sources of this build, else a folder above the program. Never the working folder, where anybody may have written
/// scripts. Throws Misuse if there is none.
std::filesystem::path homeFolder();

}  // namespace irk
