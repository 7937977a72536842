// `irk list scenes`.
#pragma once

#include <ostream>
#include <string>

namespace irk {

/// Prints the scenes of a collection (empty: all) with kind, unknowns, collections, source and parameters, as text or
/// as a JSON array. Throws Misuse for an unknown collection.
void printScenes(const std::string& collection, bool json, std::ostream& out);

}  // namespace irk
