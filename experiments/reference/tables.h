// Tables of references: the files of problems/reference, and comparisons with them.
#pragma once

#include <string>
#include <vector>

#include "experiments/reference/compute.h"
#include "experiments/tables/table.h"

namespace irk {

/// Columns scene, settings, t, component, value, accuracy, source.
Table referenceTable(const TableHead& head, const std::vector<ReferenceValue>& values);

/// Reads the values of such a table. Throws Misuse with `file`, row and value for invalid numbers, scenes and
/// parameters, and for an accuracy that is not > 0.
std::vector<ReferenceValue> referenceValues(const std::string& file, const Table& table);

/// One line per value of `stated` that differs from the computed one by more than the sum of both accuracies, or that
/// was not computed.
std::vector<std::string> disagreements(const std::vector<ReferenceValue>& stated,
                                       const std::vector<ReferenceValue>& computed);

/// As `disagreements`, and one line for each computed value that is not in `stated`.
std::vector<std::string> differences(const std::vector<ReferenceValue>& stated,
                                     const std::vector<ReferenceValue>& computed);

}  // namespace irk
