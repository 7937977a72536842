// Where and when numbers were made: the head of tables, and the rows of environments.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

/// study, version, commit, compiler, flags, cpu, threads, date.
TableHead environmentHead(const std::string& study, int threads);

/// Of environments.csv: environment (its id), commit, version, host, cpu, cores, memory_gb, compiler, flags, libraries,
/// first_date.
std::vector<std::string> environmentColumns();
/// Those of this program on this machine. The id is a hash of all but the date.
const TableRow& thisEnvironment();
/// Name of the processor.
const std::string& processorName();
std::string hostName();

/// Now, UTC, ISO 8601.
std::string dateText();

/// The folder with plots/: IRK_HOME, else the sources this was built from, else a folder above the program; never
/// the working folder, whose scripts anybody may have written. Throws Misuse if there is none.
std::filesystem::path homeFolder();

}  // namespace irk
