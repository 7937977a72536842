#include "experiments/report/publish/publish.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>

#include "experiments/base/failure.h"
#include "experiments/report/page.h"
#include "experiments/report/publish/published_page.h"
#include "experiments/report/publish/published_runs.h"
#include "experiments/report/publish/published_tables.h"
#include "experiments/report/report.h"
#include "irk/misuse.h"

namespace irk::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "published.csv";

// Only a former publication may be replaced.
void requireOwnFolder(const fs::path& into) {
  std::error_code none;
  if (!fs::exists(into, none)) return;
  if (!fs::is_directory(into, none)) throw Misuse(fmt::format("{}: a folder is expected", into.string()));
  if (fs::is_empty(into) || fs::exists(into / kRecord)) return;
  throw Misuse(
      fmt::format("{}: a new folder, or that of a former publication (with {}), is expected", into.string(), kRecord));
}

std::vector<Figure> chosenFigures(const ReportOptions& options) {
  const auto all = readFigures(options.home / "plots" / "figures.txt");
  std::vector<Figure> chosen;
  for (const auto& figure : publishedFigures()) {
    const auto at = std::ranges::find(all, figure.name, &Figure::name);
    if (at == all.end()) throw Failure(fmt::format("plots/figures.txt has no figure '{}'", figure.name));
    chosen.push_back(*at);
  }
  return chosen;
}

// Returns the number of figures that are missing, plus one if they are too large.
int copyFigures(const std::vector<Figure>& figures, const ReportOptions& options, const fs::path& to,
                std::ostream& err) {
  int doubts = drawFigures(figures, options, err);
  std::uintmax_t bytes = 0, most = 0;
  std::string largest;
  for (const auto& figure : figures) {
    const auto file = figureFolder(options) / (figure.name + ".svg");
    if (!fs::exists(file)) continue;
    fs::copy_file(file, to / file.filename());
    const auto size = fs::file_size(file);
    bytes += size;
    if (size > most) largest = figure.name;
    most = std::max(most, size);
  }
  if (bytes <= kMostFigureBytes) return doubts;
  fmt::print(err, "the figures have {} bytes, allowed are {}; the largest is {} with {}\n", bytes, kMostFigureBytes,
             largest, most);
  return doubts + 1;
}

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  if (!(out << text).flush()) throw Failure(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace

int publish(const ReportOptions& options, const std::vector<std::string>& studies, const fs::path& into,
            std::ostream& err) {
  requireOwnFolder(into);
  const auto runs = publishedRuns(options, studies);
  const auto answers = pageAnswers(options);
  const auto tables = readPublishedTables(options, answers);
  const auto figures = chosenFigures(options);
  for (const auto* part : {"figures", "tables"}) {
    fs::remove_all(into / part);
    fs::create_directories(into / part);
  }
  const int doubts = copyFigures(figures, options, into / "figures", err);
  for (std::size_t i = 0; i < tables.size(); ++i)
    writeTable(into / "tables" / fmt::format("{}.csv", publishedTables()[i].name), tables[i]);
  writeText(into / "README.md", publishedPage(options, answers, figures, runs));
  writeTable(into / kRecord, runs.table);
  return doubts;
}

}  // namespace irk::report
