// The schema of `irk solve --json`, and the part of JSON Schema that it uses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace irk {

/// What is wrong with an object that `irk solve --json` prints; empty if it follows solve.schema.json.
std::vector<std::string> againstSolveSchema(const nlohmann::json& value);
/// The same for an output: one object, or one per line.
std::vector<std::string> againstSolveSchema(const std::string& output);

}  // namespace irk
