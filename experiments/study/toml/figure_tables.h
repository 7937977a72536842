// The figures that a study file asks for, one table [[figure]] each:
//
//   [[figure]]
//   script = "work_by"                     a script of plots/
//   name = "newton"                        letters, digits and _; by default that of the script
//   title = "..."   caption = "..."        the text below the figure
//   variant = "newton"                     every other key is an option of the script
//   only = ["method=gauss_3", "h=0.1"]     a list is passed as words
//
// results/<study>/figures.toml keeps them in the same form, for `irk plot` and `irk report`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// One option of a script.
struct FigureOption {
  std::string name;
  std::vector<std::string> items;  ///< one text of words, or a list of single words, or one number
  enum class Kind { kText, kList, kNumber } kind = Kind::kText;
  std::string place = {};  ///< `file:line`
};

struct FigureTable {
  std::string script, name, title, caption;
  std::vector<FigureOption> options = {};
  std::string place = {};
};

struct FigureTables {
  std::string title;  ///< of the study
  std::vector<FigureTable> figures;
};

/// The title and the figures of a study file; other keys are not read. Throws Misuse with file and line for a table
/// without script, two figures of one name, and text that gnuplot would interpret: quotes, backslashes, control
/// characters.
FigureTables parseFigureTables(std::string_view toml, const std::string& file);

/// TOML text that parseFigureTables reads back.
std::string figureTablesText(const FigureTables& tables);

/// `name='value'; name=3`: assignments for gnuplot.
std::string assignmentsOf(const std::vector<FigureOption>& options);

}  // namespace irk
