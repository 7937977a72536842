// Final states of a study's runs, beside their rows: states.csv.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/runs/run.h"
#include "experiments/tables/table.h"

namespace irk {

/// u, v, x, z of a scene, one after the other.
Vec<double> componentsOf(const RunRecord& record);

/// Numbers as text, separated by blanks, and back.
std::string vectorText(const Vec<double>& y);
Vec<double> parseVector(const std::string& text);

/// The states in an exported states.csv, by key.
std::map<std::string, Vec<double>> readStates(const std::filesystem::path& file);

}  // namespace irk
