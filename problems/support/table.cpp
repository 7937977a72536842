#include "irk/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/input_file.h"
#include "core/base/text.h"
#include "irk/misuse.h"

namespace irk {
namespace {

thread_local TableReadings* readings = nullptr;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\"";
  const auto first = text.find_first_not_of(kBlank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string> cellsOf(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (auto end = line.find(separator); end != line.npos; end = line.find(separator)) {
    cells.emplace_back(trimmed(line.substr(0, end)));
    line.remove_prefix(end + 1);
  }
  cells.emplace_back(trimmed(line));
  return cells;
}

/// The lines of a table that hold cells.
class Lines {
 public:
  explicit Lines(std::string_view text) : left_(text) {
    if (left_.starts_with("\xEF\xBB\xBF")) left_.remove_prefix(3);  // spreadsheets write the mark of UTF-8
  }
  bool next(std::string_view& line) {
    while (!left_.empty()) {
      const auto end = std::min(left_.find('\n'), left_.size());
      line = left_.substr(0, end);
      left_.remove_prefix(std::min(end + 1, left_.size()));
      ++number_;
      const auto text = trimmed(line);
      if (!text.empty() && text.front() != '#') return true;
    }
    return false;
  }
  int number() const { return number_; }

 private:
  std::string_view left_;
  int number_ = 0;
};

std::size_t columnOf(const std::string& file, const std::vector<std::string>& header, const std::string& name) {
  const auto count = std::count(header.begin(), header.end(), name);
  if (count == 0) throw Misuse(file + ": " + unknownName("column", name, header));
  if (count > 1) throw Misuse(fmt::format("{}: {} columns are called '{}'", file, count, name));
  return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
}

// Multiprecision numbers are made of the same text: only decimal notation is allowed.
double numberIn(const std::string& place, const std::string& column, std::string& cell) {
  if (cell.starts_with('+')) cell.erase(0, 1);
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  const bool decimal = !cell.empty() && cell.find_first_not_of("0123456789.eE+-") == cell.npos && *end == '\0';
  if (decimal && std::isfinite(value)) return value;
  throw Misuse(fmt::format("{}: {} = '{}': a finite number with a decimal point is expected", place, column, cell));
}

std::vector<std::string> kinksOf(const TableColumns& columns) {
  std::vector<std::string> kinks;
  double before = 0;
  for (std::size_t i = 0; i + 1 < columns.t.size(); ++i) {
    const auto number = [](const std::string& text) { return std::strtod(text.c_str(), nullptr); };
    const double slope =
        (number(columns.y[i + 1]) - number(columns.y[i])) / (number(columns.t[i + 1]) - number(columns.t[i]));
    if (i > 0 && slope != before) kinks.push_back(columns.t[i]);
    before = slope;
  }
  return kinks;
}

}  // namespace

TableReadings::TableReadings(std::string folder) : folder_(std::move(folder)), outer_(std::exchange(readings, this)) {}
TableReadings::~TableReadings() { readings = outer_; }

TableColumns TableColumns::read(const std::string& file, const std::string& time, const std::string& y) {
  const std::string path = readings ? (std::filesystem::path(readings->folder_) / file).string() : file;
  const std::string text = readInputFile(path);
  TableColumns columns;
  Lines lines(text);
  std::string_view line;
  if (!lines.next(line)) throw Misuse(path + ": it is empty; a first line with the names of columns is expected");
  const auto at = line.find_first_of(",;\t");
  const char separator = at == line.npos ? ',' : line[at];
  const auto header = cellsOf(line, separator);
  const std::string& t = time.empty() ? header.front() : time;
  const std::size_t t_column = columnOf(path, header, t), y_column = columnOf(path, header, y);
  double before = 0;
  for (int line_before = 0; lines.next(line); line_before = lines.number()) {
    const std::string place = fmt::format("{}:{}", path, lines.number());
    auto cells = cellsOf(line, separator);
    if (cells.size() != header.size()) {
      throw Misuse(fmt::format("{}: {} cells; the line with the names has {}", place, cells.size(), header.size()));
    }
    const double now = numberIn(place, t, cells[t_column]);
    if (!columns.t.empty() && !(now > before)) {
      throw Misuse(fmt::format("{}: {} = {} is not later than {} in line {}", place, t, cells[t_column],
                               columns.t.back(), line_before));
    }
    before = now;
    static_cast<void>(numberIn(place, y, cells[y_column]));
    columns.t.push_back(cells[t_column]);
    columns.y.push_back(cells[y_column]);
  }
  if (columns.t.size() < 2) {
    throw Misuse(fmt::format("{}: {} row{} of numbers; at least 2 are expected", path, columns.t.size(),
                             columns.t.size() == 1 ? "" : "s"));
  }
  columns.kinks = kinksOf(columns);
  if (readings) readings->all_.push_back({path, y, columns.t.front(), columns.t.back(), columns.kinks});
  return columns;
}

std::vector<std::string> kinksRead() {
  std::vector<std::string> all;
  for (const auto& table : readings ? readings->all() : std::vector<TableRead>{}) {
    all.insert(all.end(), table.kinks.begin(), table.kinks.end());
  }
  return all;
}

}  // namespace irk
