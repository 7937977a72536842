// References as tables: the files of problems/reference, and comparing with them.
#pragma once

#include <string>
#include <vector>

#include "experiments/reference/compute.h"
#include "experiments/tables/table.h"

namespace irk {

/// Columns scene, settings, t, component, value, accuracy, source.
Table referenceTable(const TableHead& head, const std::vector<ReferenceValue>& values);

/// The values of such a table. Throws Misuse with `file`, row and value for what is no number, no
/// scene or no parameter, and for an accuracy that is not > 0.
std::vector<ReferenceValue> referenceValues(const std::string& file, const Table& table);

/// One line per value of `stated` that differs from the computed one by more than both accuracies
/// add up to, or that was not computed.
std::vector<std::string> disagreements(const std::vector<ReferenceValue>& stated,
                                       const std::vector<ReferenceValue>& computed);

/// The same, and a line for each computed value that is not stated.
std::vector<std::string> differences(const std::vector<ReferenceValue>& stated,
                                     const std::vector<ReferenceValue>& computed);

}  // namespace irk
