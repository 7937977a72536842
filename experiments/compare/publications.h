// Compares the small tables of two publications (irk publish).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "experiments/compare/comparison.h"

namespace irk::compare {

/// Whether the folder has a published.csv.
bool isPublication(const std::filesystem::path& folder);

struct PublicationDifferences {
  std::size_t count = 0;
  std::string text;  ///< what both are made of, then the largest differences of each table
};

/// Matches the rows of tables/*.csv by the columns that the entry `key` of a table's head names. Numbers differ if
/// their ratio exceeds `limits.errors`, or one of them is 0 or not a number; other cells if their texts do. Throws
/// Misuse if only one of the two is of quick runs, for a table without key, and what readTable throws.
PublicationDifferences comparePublications(const std::filesystem::path& first, const std::filesystem::path& second,
                                           const Limits& limits);

}  // namespace irk::compare
