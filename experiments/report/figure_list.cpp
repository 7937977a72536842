#include "experiments/report/figure_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "experiments/base/split.h"
#include "experiments/report/figure_path.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/scripts.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// For use inside double quotes of the shell.
std::string shellQuoted(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '$' || c == '`' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted;
}

}  // namespace

bool areQuick(const ReportOptions& options) { return options.results.filename() == "quick"; }

std::vector<Figure> readFigures(const std::filesystem::path& file) {
  constexpr std::size_t kFields = 6;
  std::ifstream in(file);
  if (!in) throw Misuse(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  std::vector<Figure> figures;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto parts = split(line, '|');
    if (parts.size() != kFields) {
      throw Misuse(fmt::format("{}:{}: {} fields, expected study|script|name|title|caption|assignments", file.string(),
                               number, parts.size()));
    }
    figures.push_back({parts[0], parts[1], parts[2], parts[3], parts[4], parts[5], false});
  }
  return figures;
}

namespace {

// Throws Misuse for damage.
std::vector<Figure> figuresKeptOf(const std::string& study, const ReportOptions& options) {
  requirePlainPath("study", study);
  const FigureTables kept = keptFigures(options.results, study);
  std::vector<Figure> figures;
  for (const auto& figure : kept.figures) {
    checkFigure(figure, options.home, {});
    figures.push_back({study, figure.script + ".gp", study + "_" + figure.name,
                       figure.title.empty() ? kept.title : figure.title, figure.caption, assignmentsOf(figure.options),
                       true});
  }
  return figures;
}

}  // namespace

std::vector<Figure> allFigures(const ReportOptions& options) {
  auto figures = readFigures(options.home / "plots" / "figures.txt");
  for (const auto& study : ownStudies(options.results)) {
    try {
      const auto own = figuresKeptOf(study, options);
      figures.insert(figures.end(), own.begin(), own.end());
    } catch (const Misuse&) {
      // brokenFigures tells it; the figures of all others are drawn
    }
  }
  return figures;
}

std::map<std::string, std::string> brokenFigures(const ReportOptions& options) {
  std::map<std::string, std::string> broken;
  for (const auto& study : ownStudies(options.results)) {
    try {
      (void)figuresKeptOf(study, options);
    } catch (const Misuse& misuse) {
      broken[study] = misuse.what();
    }
  }
  return broken;
}

std::vector<std::string> studiesOf(const std::vector<Figure>& figures) {
  std::vector<std::string> studies;
  for (const auto& figure : figures) {
    if (std::find(studies.begin(), studies.end(), figure.study) == studies.end()) {
      studies.push_back(figure.study);
    }
  }
  return studies;
}

std::filesystem::path figureFolder(const ReportOptions& options) { return options.results / "report" / "figures"; }

bool hasResults(const Figure& figure, const ReportOptions& options) {
  return std::filesystem::is_directory(options.results / figure.study);
}

bool isDrawn(const Figure& figure, const ReportOptions& options) {
  return std::filesystem::exists(figureFolder(options) / (figure.name + ".svg"));
}

std::string gnuplotCommands(const Figure& figure, const ReportOptions& options) {
  return gnuplotCommands(figure, options, options.results / figure.study, figureFolder(options) / figure.name);
}

std::string gnuplotCommands(const Figure& figure, const ReportOptions& options, const std::filesystem::path& data,
                            const std::filesystem::path& out) {
  // Tools that scripts start would take a path that begins with a dash for an option.
  const std::string before = data.string().starts_with('-') ? "./" : "";
  return fmt::format("{}data='{}{}'; out='{}'; {}", areQuick(options) ? "quick=1; " : "", before, data.string(),
                     out.string(), figure.assignments);
}

std::string shellCommand(const Figure& figure, const ReportOptions& options) {
  return fmt::format("gnuplot -e \"{}\" plots/{}", shellQuoted(gnuplotCommands(figure, options)), figure.script);
}

}  // namespace irk
