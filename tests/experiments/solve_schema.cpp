#include "tests/experiments/solve_schema.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/experiments/program.h"

namespace irk {
namespace {

using SchemaJson = nlohmann::json;

SchemaJson solveSchema() {
  std::ifstream file(IRK_SOURCE_DIR "/experiments/commands/solve.schema.json");
  return SchemaJson::parse(file);
}

bool isOfType(const SchemaJson& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return type == "null" && value.is_null();
}

std::vector<std::string> typesOf(const SchemaJson& schema) {
  const SchemaJson& type = schema.at("type");
  return type.is_array() ? type.get<std::vector<std::string>>() : std::vector<std::string>{type.get<std::string>()};
}

// The part of JSON Schema that the file uses; another keyword is an error. Appends what is wrong.
void validate(const SchemaJson& value, const SchemaJson& schema, const std::string& place,
              std::vector<std::string>& wrong) {
  const SchemaJson known{"$schema",    "title", "description", "type", "required", "additionalProperties",
                         "properties", "items", "const"};
  for (const auto& [keyword, content] : schema.items()) {
    if (std::find(known.begin(), known.end(), keyword) == known.end()) wrong.push_back("keyword " + keyword);
  }
  if (schema.contains("const") && value != schema["const"]) wrong.push_back(place + ": another constant");
  if (schema.contains("type")) {
    const auto types = typesOf(schema);
    if (std::none_of(types.begin(), types.end(), [&](const auto& type) { return isOfType(value, type); })) {
      wrong.push_back(place + ": of another type, " + value.dump());
      return;
    }
  }
  for (const auto& key : schema.value("required", SchemaJson::array())) {
    if (!value.contains(key.get<std::string>())) wrong.push_back(place + ": no " + key.get<std::string>());
  }
  if (value.is_array() && schema.contains("items")) {
    for (const auto& item : value) validate(item, schema["items"], place + "[]", wrong);
  }
  if (!value.is_object()) return;
  const SchemaJson properties = schema.value("properties", SchemaJson::object());
  const SchemaJson others = schema.value("additionalProperties", SchemaJson(true));
  for (const auto& [key, content] : value.items()) {
    if (properties.contains(key)) {
      validate(content, properties[key], place + '.' + key, wrong);
    } else if (others.is_object()) {
      validate(content, others, place + '.' + key, wrong);
    } else if (others == false) {
      wrong.push_back(place + ": unknown key " + key);
    }
  }
}

}  // namespace

std::vector<std::string> againstSolveSchema(const SchemaJson& value) {
  std::vector<std::string> wrong;
  validate(value, solveSchema(), "", wrong);
  return wrong;
}

std::vector<std::string> againstSolveSchema(const std::string& output) {
  if (SchemaJson::accept(output)) return againstSolveSchema(SchemaJson::parse(output));
  std::vector<std::string> wrong;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto more = SchemaJson::accept(line) ? againstSolveSchema(SchemaJson::parse(line))
                                               : std::vector<std::string>{"no JSON: " + line};
    wrong.insert(wrong.end(), more.begin(), more.end());
  }
  return wrong;
}

SchemaJson solvedJson(std::vector<std::string> arguments, int status) {
  arguments.insert(arguments.begin(), "solve");
  arguments.emplace_back("--json");
  const Ended run = program(arguments);
  EXPECT_EQ(run.status, status) << run.err;
  return SchemaJson::parse(run.out);
}

}  // namespace irk
