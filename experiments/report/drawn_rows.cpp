#include "experiments/report/drawn_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/tables/table.h"

namespace irk {
namespace {

constexpr double kFinestPart = 0.005;  // of a decade; about a quarter of a pixel
constexpr double kCoarser = 1.25;

using CellViews = std::vector<std::string_view>;
using Columns = std::map<std::string, std::size_t, std::less<>>;

// The words of a list in gnuplot's way: 'a b' or '"a c" b'.
std::vector<std::string> wordsOf(const std::string& list) {
  std::vector<std::string> words;
  static const std::regex word("\"([^\"]*)\"|'([^']*)'|(\\S+)");
  for (std::sregex_iterator i(list.begin(), list.end(), word), end; i != end; ++i) {
    words.push_back((*i)[1].str() + (*i)[2].str() + (*i)[3].str());
  }
  return words;
}

bool isAbsent(std::string_view cell) { return cell.empty() || cell == "nan"; }

/// The selection of rows that plots/style.gp defines. It may keep too many rows, since gnuplot selects again.
class Selection {
 public:
  Selection(const std::map<std::string, std::string>& options, const std::string& script, const Columns& at) : at_(at) {
    for (const auto& [name, value] : options) {
      if (name == "only") {
        for (const auto& word : wordsOf(value)) {
          const auto equals = std::min(word.find('='), word.size());
          equal_.emplace_back(word.substr(0, equals), word.substr(std::min(equals + 1, word.size())));
        }
      } else if (name == "cases") {
        cases_ = wordsOf(value);
      } else if (name == "block") {
        block_ = value;
      } else if (!value.empty() &&
                 (name == "scene" || script.find(fmt::format("(\"{0}\", {0})", name)) != script.npos)) {
        equal_.emplace_back(name, value);
      }
    }
  }

  bool takes(const CellViews& cells) const {
    if (!block_.empty() && !isIn(cells, block_)) return false;
    for (const auto& [column, value] : equal_) {
      if (!is(cells, column, value)) return false;
    }
    return cases_.empty() ||
           std::any_of(cases_.begin(), cases_.end(), [&](const auto& one) { return isCase(cells, one); });
  }

 private:
  std::optional<std::string> cell(const CellViews& cells, std::string_view column) const {
    const auto at = at_.find(column);
    return at == at_.end() ? std::nullopt : std::optional(plainCell(cells[at->second]));
  }
  // Rows without the column are left to gnuplot.
  bool is(const CellViews& cells, std::string_view column, std::string_view value) const {
    const auto text = cell(cells, column);
    return !text || (value.empty() ? isAbsent(*text) : *text == value);
  }
  bool isIn(const CellViews& cells, std::string_view block) const {
    const auto text = cell(cells, kBlockColumn);
    return !text || hasBlock(*text, block);
  }
  // block=NAME, block=NAME:SCENE, SCENE or SCENE:SETTINGS
  bool isCase(const CellViews& cells, std::string_view one) const {
    constexpr std::string_view kBlock = "block=";
    const auto colon = one.find(':');
    const auto first = one.substr(0, colon), second = colon == one.npos ? std::string_view() : one.substr(colon + 1);
    if (!first.starts_with(kBlock)) return is(cells, "scene", first) && is(cells, "settings", second);
    return isIn(cells, first.substr(kBlock.size())) && (second.empty() || is(cells, "scene", second));
  }

  const Columns& at_;
  std::string block_;
  std::vector<std::string> cases_;
  std::vector<std::pair<std::string, std::string>> equal_;
};

/// Collects rows, one per visible mark, as text with the columns that are needed.
class Thinned {
 public:
  /// `same`: columns that tell curves from each other; `near`: those of the marks. Without `near` all rows are kept.
  Thinned(std::vector<std::size_t> kept, std::vector<std::size_t> same, std::vector<std::size_t> near, Columns at)
      : kept_(std::move(kept)), same_(std::move(same)), near_(std::move(near)), at_(std::move(at)) {}

  void add(const CellViews& cells) {
    Row row;
    for (const auto at : kept_) row.text.append(cells[at]).append(at == kept_.back() ? "\n" : ",");
    for (const auto at : same_) row.curve = fnv1a(fmt::format("{:x},{}", row.curve, cells[at]));
    if (isWrong(cells)) ++row.curve;
    for (const auto at : near_) {
      const double number = std::abs(cellNumber(cells[at]));
      row.place.push_back(number > 0 && std::isfinite(number) ? std::log10(number) : 1e4);
    }
    keep(std::move(row));
    while (!near_.empty() && rows_.size() > DrawnRows::kMostRows) coarsen();
  }
  std::size_t size() const { return rows_.size(); }
  void write(std::ostream& out) const {
    for (const auto& row : rows_) out << row.text;
  }

 private:
  struct Row {
    std::string text;
    std::uint64_t curve = 0;
    std::vector<double> place;  // decades
  };

  // Wrong successes have a mark of their own: isWrong in plots/style.gp.
  bool isWrong(const CellViews& cells) const {
    const auto number = [&](std::string_view column) {
      const auto at = at_.find(column);
      return at == at_.end() ? std::nan("") : cellNumber(cells[at->second]);
    };
    const double bar = 1000 * std::fmax(number("rtol"), number("atol")) + 1e-9;
    return number("error_u") > bar || number("error_v") > bar || number("error_x") > bar;
  }
  void keep(Row row) {
    std::uint64_t hash = row.curve;
    for (const double place : row.place) hash = fnv1a(fmt::format("{:x} {}", hash, std::floor(place / part_)));
    if (part_ == 0 || known_.insert(hash).second) rows_.push_back(std::move(row));
  }
  void coarsen() {
    part_ = part_ == 0 ? kFinestPart : part_ * kCoarser;
    known_.clear();
    for (auto& row : std::exchange(rows_, {})) keep(std::move(row));
  }

  std::vector<std::size_t> kept_, same_, near_;
  Columns at_;
  double part_ = 0;  // of a decade; 0: all rows are kept
  std::vector<Row> rows_;
  std::unordered_set<std::uint64_t> known_;
};

// The columns of the script's line `# Thins by`, with options replaced by their values.
std::vector<std::string> thinsBy(const std::string& script, const std::map<std::string, std::string>& options) {
  std::smatch line;
  if (!std::regex_search(script, line, std::regex("# Thins by ([^\n]*)"))) return {};
  std::vector<std::string> columns;
  for (const auto& name : wordsOf(line[1])) {
    std::smatch usual;
    const auto given = options.find(name);
    std::string value = name;
    if (given != options.end()) {
      value = given->second;
    } else if (std::regex_search(script, usual,
                                 std::regex("exists\\(\"" + name + "\"\\)\\) " + name + " = '([^']*)'"))) {
      value = usual[1];
    }
    for (auto& word : wordsOf(value)) columns.push_back(std::move(word));
  }
  return columns;
}

std::set<std::string> identifiersIn(const std::string& text) {
  static const std::regex word("[A-Za-z_]\\w*");
  return {std::sregex_token_iterator(text.begin(), text.end(), word), std::sregex_token_iterator()};
}

// Columns that tell one curve or panel from another.
constexpr std::string_view kCurves[] = {"method", "family", "stages", "outcome", "control"};

Thinned thinnedFor(const std::string& script, const std::string& style,
                   const std::map<std::string, std::string>& options, const std::vector<std::string>& header,
                   const Columns& at) {
  auto named = identifiersIn(script + style), curves = std::set<std::string>(std::begin(kCurves), std::end(kCurves));
  for (const auto& [name, value] : options) {
    named.merge(identifiersIn(value));
    const bool is_selection = name == "only" || name == "quantity" || name == "costs";
    if (!is_selection) curves.merge(identifiersIn(value));
  }
  const auto cases = options.find("cases");
  if (cases != options.end() && wordsOf(cases->second).size() > 1) curves.insert({"block", "scene", "settings"});
  const auto marks = thinsBy(script, options);
  std::vector<std::size_t> kept, same, near;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& column = header[i];
    const std::string at_end = column.ends_with("_over_time") ? column.substr(0, column.size() - 10) : column;
    const auto isMark = [&](const std::string& name) {
      return std::find(marks.begin(), marks.end(), name) != marks.end();
    };
    // A file may be drawn by its errors over time instead of those at the end.
    if (!named.contains(column) && !named.contains(at_end)) continue;
    kept.push_back(i);
    if (isMark(column) || isMark(at_end)) {
      near.push_back(i);
    } else if (curves.contains(column)) {
      same.push_back(i);
    }
  }
  return {std::move(kept), std::move(same), std::move(near), at};
}

void linkOthers(const std::filesystem::path& from, const std::filesystem::path& to) {
  for (const auto& entry : std::filesystem::directory_iterator(from)) {
    const auto name = entry.path().filename();
    if (name != "runs.csv") std::filesystem::create_symlink(std::filesystem::absolute(entry.path()), to / name);
  }
}

}  // namespace

std::map<std::string, std::string> optionsOf(const std::string& assignments) {
  std::map<std::string, std::string> options;
  static const std::regex assignment("(\\w+)\\s*=\\s*(?:'([^']*)'|\"([^\"]*)\"|([^;'\"]+))\\s*(?:;|$)");
  for (std::sregex_iterator i(assignments.begin(), assignments.end(), assignment), end; i != end; ++i) {
    options[(*i)[1]] = (*i)[2].str() + (*i)[3].str() + (*i)[4].str();
  }
  return options;
}

DrawnRows::DrawnRows(const Figure& figure, const std::filesystem::path& home, const std::filesystem::path& results) {
  linkOthers(results, folder());
  std::string script = readInputFile(home / "plots" / figure.script);
  const std::string style = readInputFile(home / "plots" / "style.gp");
  const auto options = optionsOf(figure.assignments);
  // With this option work_by.gp draws the figure.
  const auto variant = options.find("variant");
  if (variant != options.end()) script += readInputFile(home / "plots" / "work_by.gp");
  std::ifstream in(results / "runs.csv", std::ios::binary);
  std::ofstream out(folder() / "runs.csv", std::ios::binary);
  std::string line;
  while (std::getline(in, line) && line.starts_with('#')) out << line << '\n';
  CellViews cells;
  if (!splitLine(line, cells)) throw Failure(fmt::format("{}: no line with column names", results.string()));
  const TableRow header = plainRow(cells);
  Columns at;
  for (std::size_t i = 0; i < header.size(); ++i) at[header[i]] = i;
  const Selection selection(options, script + style, at);
  Thinned rows = thinnedFor(script, style, options, header, at);
  rows.add(cells);
  while (std::getline(in, line)) {
    if (splitLine(line, cells) && cells.size() == header.size() && selection.takes(cells)) rows.add(cells);
  }
  rows.write(out);
  rows_ = rows.size() - 1;
  if (!out.flush()) throw Failure(fmt::format("cannot write into {}: is the disk full?", folder().string()));
}

std::unique_ptr<DrawnRows> drawnRows(const Figure& figure, const ReportOptions& options) {
  const auto folder = options.results / figure.study;
  std::error_code none;
  const auto size = std::filesystem::file_size(folder / "runs.csv", none);
  if (none || size < DrawnRows::kLargeFile) return nullptr;
  const std::string script = readInputFile(options.home / "plots" / figure.script);
  if (script.find("/runs.csv'") == script.npos) return nullptr;
  return std::make_unique<DrawnRows>(figure, options.home, folder);
}

}  // namespace irk
