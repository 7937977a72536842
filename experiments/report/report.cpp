#include "experiments/report/report.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <sstream>
#include <vector>

#include "core/base/parallel_loop.h"
#include "core/base/text.h"
#include "experiments/analyses/results.h"
#include "experiments/base/child_process.h"
#include "experiments/base/failure.h"
#include "experiments/report/drawn_rows.h"
#include "experiments/report/figure_path.h"
#include "experiments/report/page.h"
#include "experiments/tables/new_file.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// Forwards gnuplot's messages, except those about curves without points: a panel may lack rows.
void forwardMessages(const std::string& messages, std::ostream& err) {
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.find("no valid points") == line.npos) err << line << '\n';
  }
}

std::string commandOf(const std::string& study) { return study == kTableauResults ? "tableau table" : "run " + study; }

// Requires that `study` has figures and results; with an empty `study`, that any study has results.
void requireResults(const std::string& study, const std::vector<Figure>& figures, const ReportOptions& options) {
  const auto studies = studiesOf(figures);
  if (!study.empty() && std::find(studies.begin(), studies.end(), study) == studies.end()) {
    throw Misuse(unknownName("study with figures", study, studies));
  }
  requireResultsFolder(options.results);
  requirePlainPath("--results", options.results.string());
  const bool found = std::any_of(figures.begin(), figures.end(), [&](const Figure& figure) {
    return (study.empty() || figure.study == study) && hasResults(figure, options);
  });
  if (found) return;
  if (study.empty()) {
    throw Failure(fmt::format("no tables of any study in '{}': irk run STUDY makes them", options.results.string()));
  }
  throw Failure(fmt::format("no results of study '{}' in '{}': irk {} makes them", study, options.results.string(),
                            commandOf(study)));
}

/// The files of a figure while gnuplot draws it: they get their names when they are whole, so that reports that are
/// made at the same time neither mix nor miss files.
class NewFigure {
 public:
  explicit NewFigure(std::filesystem::path figure)
      : figure_(std::move(figure)), beside_(newBeside(figure_.string() + ".svg")) {}
  ~NewFigure() {
    clear();
    std::error_code none;
    std::filesystem::remove(beside_, none);
  }
  NewFigure(const NewFigure&) = delete;
  NewFigure& operator=(const NewFigure&) = delete;

  /// The name of the new files without .svg and .png.
  const std::filesystem::path& out() const { return beside_; }
  /// Removes what has been drawn.
  void clear() const {
    std::error_code none;
    for (const auto* ending : kEndings) std::filesystem::remove(beside_.string() + ending, none);
  }
  /// Gives the new files their names. A file of an earlier drawing must not be taken for one of this drawing.
  void close() const {
    std::error_code missing;
    for (const auto* ending : kEndings) {
      std::filesystem::rename(beside_.string() + ending, figure_.string() + ending, missing);
      if (missing) std::filesystem::remove(figure_.string() + ending);
    }
  }

 private:
  static constexpr const char* kEndings[] = {".svg", ".png"};
  std::filesystem::path figure_, beside_;
};

// Returns whether the figure is drawn. An own figure without any row is a mistake; a built-in one belongs to a study
// that is not complete.
bool drawOne(const Figure& figure, const ReportOptions& options, std::ostream& err) {
  const NewFigure files(figureFolder(options) / figure.name);
  const auto drawn = drawnRows(figure, options);
  const auto data = drawn ? drawn->folder() : options.results / figure.study;
  const bool made = drawFigure(figure.script, gnuplotCommands(figure, options, data, files.out()), options.home, err);
  if (!made) files.clear();
  files.close();
  if (!made) return false;
  if (!figure.is_own || isDrawn(figure, options)) return true;
  fmt::print(err, "figure {} is not drawn: it selects no rows\n", figure.name);
  return false;
}

// Draws the figures side by side, each with a gnuplot of its own; their messages come in the order of the figures.
// Returns the number of failures.
int drawAll(const std::vector<Figure>& figures, const ReportOptions& options, std::ostream& err) {
  std::vector<std::string> messages(figures.size());
  ParallelLoop loop;
  int failures = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : failures)
  for (std::size_t i = 0; i < figures.size(); ++i) {
    loop.turn(i, [&] {
      std::ostringstream text;
      if (!drawOne(figures[i], options, text)) ++failures;
      messages[i] = text.str();
    });
  }
  for (const auto& text : messages) err << text;
  loop.rethrow();
  return failures;
}

}  // namespace

void requireResultsFolder(const std::filesystem::path& results) {
  std::error_code none;
  if (std::filesystem::is_directory(results, none)) return;
  throw Misuse(fmt::format("--results '{}': a folder of results is expected", results.string()));
}

bool drawFigure(const std::string& script, const std::string& commands, const std::filesystem::path& home,
                std::ostream& err) try {
  const auto path = (home / "plots" / script).string();
  const auto ended = runChild({"gnuplot", "-e", commands, path});
  forwardMessages(ended.messages, err);
  if (ended.status != 0) {
    fmt::print(err, "gnuplot ended with status {}: gnuplot -e \"{}\" {}\n", ended.status, commands, path);
  }
  return ended.status == 0;
} catch (const Failure& failure) {
  fmt::print(err, "{}; it is in the package gnuplot-nox\n", failure.what());
  return false;
}

int drawFigures(const std::string& study, const ReportOptions& options, std::ostream& err) {
  const auto figures = allFigures(options);
  const auto broken = brokenFigures(options);
  if (const auto its = broken.find(study); its != broken.end()) throw Misuse(its->second);
  requireResults(study, figures, options);
  std::filesystem::create_directories(figureFolder(options));
  int failures = 0;
  for (const auto& [of, reason] : broken) {
    if (!study.empty()) continue;
    ++failures;
    fmt::print(err, "figures of {} are not drawn: {}\n", of, reason);
  }
  for (const auto& of : studiesOf(figures)) {
    const auto refusal = refusedTimes(options.results / of / "runs.csv");
    if (refusal.empty() || (!study.empty() && of != study)) continue;
    ++failures;
    fmt::print(err, "figures of {} have no times: {}\n", of, refusal);
  }
  std::vector<Figure> wanted;
  std::copy_if(figures.begin(), figures.end(), std::back_inserter(wanted), [&](const Figure& figure) {
    return (study.empty() || figure.study == study) && hasResults(figure, options);
  });
  return failures + drawAll(wanted, options, err);
}

int drawFigures(const std::vector<Figure>& figures, const ReportOptions& options, std::ostream& err) {
  requirePlainPath("--results", options.results.string());
  std::filesystem::create_directories(figureFolder(options));
  return drawAll(figures, options, err);
}

std::filesystem::path writeReport(const ReportOptions& options) {
  auto path = options.results / "report" / "index.html";
  std::filesystem::create_directories(path.parent_path());
  const auto answers = pageAnswers(options);
  for (const auto& answer : answers) {
    if (!answer.table.columns.empty())
      writeTable(path.parent_path() / fmt::format("answers_{}.csv", answer.id), answer.table);
  }
  const std::string page = pageHtml(options, answers);
  NewFile file(path);
  file.out() << page;
  file.close();
  return path;
}

}  // namespace irk
