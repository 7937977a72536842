// Where the tables of runs are, and what is printed about two of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/compare/compare.h"

namespace irk::compare {

/// The runs.csv of a study's folder, under the empty name; of a tree of results all that are below it, by their folders
/// relative to it. Throws Misuse for a path that is no folder or has none.
std::map<std::string, std::filesystem::path> runsIn(const std::filesystem::path& folder);

/// A runs.csv, with the processors of the environments.csv beside it where there is one.
Runs readRuns(const std::filesystem::path& file);

/// One line of numbers, the differences by kind, of each kind the worst ten, and what was not compared and why.
std::string textOf(const std::string& study, const Comparison& comparison);

}  // namespace irk::compare
