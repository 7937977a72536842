#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <string>

#include "experiments/commands/columns/column_texts.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"

namespace irk {
namespace {

// The settings of a run that have a unit.
struct FieldUnit {
  std::string_view field, unit;
};
constexpr FieldUnit kFieldUnits[] = {{"h", "the scene's time unit"},
                                     {"h_min", "the scene's time unit"},
                                     {"h_max", "the scene's time unit"},
                                     {"t_end", "the scene's time unit"},
                                     {"time_limit", "s"}};

std::string_view unitOf(std::string_view field) {
  for (const auto& [name, unit] : kFieldUnits) {
    if (name == field) return unit;
  }
  return "";
}

// `|` ends a cell of Markdown.
std::string markdownCell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

void printColumnLine(std::string_view name, std::string_view unit, std::string_view meaning, std::ostream& out) {
  fmt::print(out, "| `{}` | {} | {} |\n", name, markdownCell(unit), markdownCell(meaning));
}

void printTableHead(std::string_view file, std::string_view row, std::ostream& out) {
  fmt::print(out, "## {}\n\nOne row: {}.\n\n", file, row);
}

constexpr const char* kColumnsHead = "| column | unit | meaning |\n|---|---|---|\n";

void printRunColumns(std::ostream& out) {
  printTableHead("runs.csv", "a run with its settings, its outcome, errors, counters and times", out);
  out << kColumnsHead;
  auto columns = runColumns();
  columns.emplace_back(kBlockColumn);
  const auto texts = runColumnTexts();
  for (const auto& column : columns) {
    const auto text = std::find_if(texts.begin(), texts.end(), [&](const auto& t) { return t.name == column; });
    if (text != texts.end()) {
      printColumnLine(column, text->unit, text->meaning, out);
    } else {
      printColumnLine(column, unitOf(column), findField(column).meaning, out);
    }
  }
}

void printTable(const TableText& table, std::ostream& out) {
  out << '\n';
  printTableHead(table.file, table.row, out);
  if (table.begins_with == SharedColumns::kSeries) {
    out << "It begins with the columns of a series: all settings of a run but `h`, `rtol` and `atol`, as in "
           "runs.csv.\n\n";
  }
  out << kColumnsHead;
  for (const auto& [name, unit, meaning] : table.columns) printColumnLine(name, unit, meaning, out);
}

}  // namespace

void printColumns(std::ostream& out) {
  printRunColumns(out);
  for (const auto& table : tableTexts()) printTable(table, out);
  for (const auto& table : summaryTableTexts()) printTable(table, out);
}

}  // namespace irk
