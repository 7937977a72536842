// What the columns of tables mean: the text of `irk list columns` and of experiments/guide/tables.md.
#pragma once

#include <ostream>
#include <span>
#include <string_view>

namespace irk {

struct ColumnText {
  std::string_view name;
  std::string_view unit;     ///< empty: a text, a count or a ratio
  std::string_view meaning;  ///< one sentence
};

/// The columns of runs.csv that are no settings of a run; settings have their meaning in runs/fields.h.
std::span<const ColumnText> runColumnTexts();

/// Columns that several tables have in common, written once.
enum class SharedColumns {
  kNone,
  kSeries,  ///< the table begins with seriesColumns (runs/run_table.h)
};

struct TableText {
  std::string_view file;  ///< `orders.csv`
  std::string_view row;   ///< what one row is
  SharedColumns begins_with;
  std::span<const ColumnText> columns;  ///< behind the shared ones, in the order of the file
};

/// The tables besides runs.csv: beside the runs or computed from them, and those of the audit, of methods and of the
/// page.
std::span<const TableText> tableTexts();
std::span<const TableText> summaryTableTexts();

/// Prints all tables with their columns as Markdown.
void printColumns(std::ostream& out);

}  // namespace irk
