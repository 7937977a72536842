// Finds the tables of runs, and prints a comparison of two.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/compare/comparison.h"

namespace irk::compare {

/// For a study's folder its runs.csv, with an empty name; for a tree of results every runs.csv in it, by the folder
/// relative to the tree. Throws Misuse for a path that is not a folder or contains none.
std::map<std::string, std::filesystem::path> runsIn(const std::filesystem::path& folder);

/// A runs.csv with the processors from the environments.csv beside it, if any.
Runs runsOf(const std::filesystem::path& file);

/// One line of numbers; then the differences by kind, the ten largest of each; then what was not compared and why.
std::string textOf(const std::string& study, const Comparison& comparison);

}  // namespace irk::compare
