#include "experiments/reference/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/decimal.h"
#include "experiments/base/numbers.h"
#include "experiments/reference/agreement.h"
#include "experiments/runs/fields.h"

namespace irk {
namespace {

const std::vector<std::string> kColumns = {"scene", "settings", "t", "component", "value", "accuracy", "source"};

BigFloat parseDecimal(const std::string& place, const std::string& text) {
  parseNumber(place, text, kAnyNumber);  // refuses text that is no number, with its message
  return BigFloat(text);
}

// Runs have double times, so a time must be a double.
void requireTime(const std::string& place, const std::string& text) {
  const BigFloat t = parseDecimal(place, text);
  if (t != decimalNumber<BigFloat>(static_cast<double>(t))) {
    throw Misuse(fmt::format("{} = {} has more digits than a double tells apart", place, text));
  }
}

// The settings as `settingsText` writes them, without defaults.
std::string canonicalSettings(const std::string& scene, const std::string& text) {
  RunSpec spec;
  findField("scene").set(spec, scene);
  findField("settings").set(spec, text);
  return settingsText(resolved(spec).settings);
}

const ReferenceValue* find(const std::vector<ReferenceValue>& values, const ReferenceValue& like) {
  const auto at = std::find_if(values.begin(), values.end(), [&](const auto& value) { return samePlace(value, like); });
  return at == values.end() ? nullptr : &*at;
}

}  // namespace

Table referenceTable(const TableHead& head, const std::vector<ReferenceValue>& values) {
  Table table{head, kColumns, {}};
  for (const auto& value : values) {
    table.rows.push_back({value.scene, value.settings, value.t, value.component,
                          decimalText(value.value, value.accuracy), fmt::format("{:g}", value.accuracy), value.source});
  }
  return table;
}

std::vector<ReferenceValue> referenceValues(const std::string& file, const Table& table) {
  std::vector<ReferenceValue> values;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto cell = [&](std::string_view column) { return table.rows[i][table.column(column)]; };
    const auto place = [&](const char* column) { return fmt::format("{}, row {}: {}", file, i + 1, column); };
    ReferenceValue value{cell("scene"), "", cell("t"), cell("component"), 0, 0, cell("source")};
    value.settings = canonicalSettings(value.scene, cell("settings"));
    requireTime(place("t"), value.t);
    value.value = parseDecimal(place("value"), cell("value"));
    value.accuracy = parseNumber(place("accuracy"), cell("accuracy"), kPositive);
    values.push_back(std::move(value));
  }
  return values;
}

std::vector<std::string> disagreements(const std::vector<ReferenceValue>& stated,
                                       const std::vector<ReferenceValue>& computed) {
  std::vector<std::string> lines;
  for (const auto& value : stated) {
    const auto* other = find(computed, value);
    if (!other) {
      lines.push_back(fmt::format("{}: not computed", value.place()));
      continue;
    }
    const auto error = static_cast<double>(BigFloat(abs(value.value - other->value)));
    if (error <= value.accuracy + other->accuracy) continue;
    lines.push_back(fmt::format("{}: {} to {:g} ({}), computed {} to {:g}", value.place(),
                                decimalText(value.value, value.accuracy), value.accuracy, value.source,
                                decimalText(other->value, other->accuracy), other->accuracy));
  }
  return lines;
}

std::vector<std::string> differences(const std::vector<ReferenceValue>& stated,
                                     const std::vector<ReferenceValue>& computed) {
  auto lines = disagreements(stated, computed);
  for (const auto& value : computed) {
    if (!find(stated, value)) lines.push_back(fmt::format("{}: missing", value.place()));
  }
  return lines;
}

}  // namespace irk
