#include "experiments/compare/publications.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "experiments/compare/times.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"

namespace irk::compare {
namespace {

namespace fs = std::filesystem;

fs::path recordOf(const fs::path& folder) { return folder / "published.csv"; }

std::set<std::string> tableNames(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "tables", none)) {
    if (entry.path().extension() == ".csv") names.insert(entry.path().filename());
  }
  return names;
}

std::optional<double> wholeNumber(const std::string& cell) {
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size()) return {};
  return number;
}

// By how much two cells differ: 1 for equal ones, infinity for different texts.
double changeOf(const std::string& a, const std::string& b) {
  if (a == b) return 1;
  const auto x = wholeNumber(a), y = wholeNumber(b);
  return x && y ? factorOf(std::abs(*x), std::abs(*y)) : std::numeric_limits<double>::infinity();
}

struct Changed {
  double size;
  std::string text;
};

// One table of both publications.
class TableComparison {
 public:
  TableComparison(const fs::path& first, const fs::path& second, const Limits& limits)
      : first_(readTable(first)), second_(readTable(second)), limits_(limits) {
    const std::string key = headEntry(first_.head, "key");
    if (key.empty()) throw Misuse(fmt::format("{}: no line '# key:', which irk publish writes", first.string()));
    std::istringstream in(key);
    for (std::string column; in >> column;) keys_.push_back(column);
  }

  std::vector<Changed> differences() {
    auto first = rowsOf(first_), second = rowsOf(second_);
    for (const auto& [id, row] : first) {
      const auto other = second.find(id);
      if (other == second.end()) {
        add(id, "only in the first");
      } else {
        compare(id, *row, *other->second);
      }
    }
    for (const auto& [id, row] : second) {
      if (!first.contains(id)) add(id, "only in the second");
    }
    std::ranges::stable_sort(found_, std::greater(), &Changed::size);
    return std::move(found_);
  }

 private:
  using Id = std::vector<std::string>;

  // Rows with equal keys are numbered.
  std::map<Id, const TableRow*> rowsOf(const Table& table) const {
    std::vector<std::size_t> columns;
    for (const auto& key : keys_) columns.push_back(table.column(key));
    std::map<Id, std::size_t> counts;
    std::map<Id, const TableRow*> rows;
    for (const auto& row : table.rows) {
      Id id;
      for (const auto column : columns) id.push_back(row[column]);
      const std::size_t number = ++counts[id];
      if (number > 1) id.push_back(fmt::format("#{}", number));
      rows[id] = &row;
    }
    return rows;
  }

  void add(const Id& id, const std::string& what, double size = std::numeric_limits<double>::infinity()) {
    found_.push_back({size, fmt::format("{}: {}", fmt::join(id, " "), what)});
  }

  // All changed cells of a row are one difference, of the size of the largest change.
  void compare(const Id& id, const TableRow& a, const TableRow& b) {
    std::string what;
    double most = 1;
    for (std::size_t i = 0; i < first_.columns.size(); ++i) {
      const std::string& name = first_.columns[i];
      if (!second_.hasColumn(name)) continue;
      const std::string& other = b[second_.column(name)];
      const double change = changeOf(a[i], other);
      if (change <= limits_.errors) continue;
      what += fmt::format("{}{} {} -> {}", what.empty() ? "" : ", ", name, a[i], other);
      most = std::max(most, change);
    }
    if (!what.empty()) add(id, what, most);
  }

  Table first_, second_;
  const Limits& limits_;
  std::vector<std::string> keys_;
  std::vector<Changed> found_;
};

std::string originOf(const TableHead& head) {
  return fmt::format("version {}, code {}, commit {}, {}", headEntry(head, "version"), headEntry(head, "code"),
                     headEntry(head, "commit"), headEntry(head, "date"));
}

}  // namespace

bool isPublication(const fs::path& folder) {
  std::error_code none;
  return fs::is_regular_file(recordOf(folder), none);
}

PublicationDifferences comparePublications(const fs::path& first, const fs::path& second, const Limits& limits) {
  const Table records[] = {readTable(recordOf(first)), readTable(recordOf(second))};
  if (headEntry(records[0].head, "quick") != headEntry(records[1].head, "quick")) {
    throw Misuse(fmt::format("{} and {}: only one of them is of quick runs", first.string(), second.string()));
  }
  PublicationDifferences all;
  all.text = fmt::format("first: {}\nsecond: {}\n", originOf(records[0].head), originOf(records[1].head));
  const auto here = tableNames(first), there = tableNames(second);
  std::set<std::string> names = here;
  names.insert(there.begin(), there.end());
  for (const auto& name : names) {
    if (!here.contains(name) || !there.contains(name)) {
      ++all.count;
      all.text += fmt::format("{}: only in the {}\n", name, here.contains(name) ? "first" : "second");
      continue;
    }
    const auto found = TableComparison(first / "tables" / name, second / "tables" / name, limits).differences();
    all.count += found.size();
    all.text += fmt::format("{}: different rows: {}{}\n", name, found.size(),
                            found.size() > kWorst ? fmt::format(", the worst {}", kWorst) : "");
    for (std::size_t i = 0; i < std::min(found.size(), kWorst); ++i) all.text += "  " + found[i].text + "\n";
  }
  return all;
}

}  // namespace irk::compare
