// The final states of a study's runs: states.csv.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/runs/run.h"
#include "experiments/tables/table.h"

namespace irk {

/// The components u, v, x, z of a scene, one after the other.
Vec<double> componentsOf(const RunRecord& record);

/// Numbers as text, separated by blanks; `readStates` reads it back.
std::string vectorText(const Vec<double>& y);
Vec<double> parseVector(const std::string& text);

/// The states of an exported states.csv by the keys of their runs.
std::map<std::string, Vec<double>> readStates(const std::filesystem::path& file);

}  // namespace irk
