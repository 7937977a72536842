#include "experiments/report/report.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <ostream>
#include <string_view>

#include "core/base/input_file.h"
#include "core/base/text.h"
#include "experiments/analyses/orders/order_fit.h"
#include "experiments/analyses/results.h"
#include "experiments/base/failure.h"
#include "experiments/base/html.h"
#include "experiments/claims/claims_html.h"
#include "experiments/report/figure_path.h"
#include "experiments/report/html_tables.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/scripts.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// A folder of results that does not belong to a study, see experiments/analyses/tableau_table.h.
constexpr std::string_view kTableaus = "tableaus";

std::filesystem::path figureFolder(const ReportOptions& options) { return options.results / "report" / "figures"; }

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Forwards gnuplot's messages, except those about curves without points: a panel may lack rows.
void forwardMessages(std::FILE* file, std::ostream& err) {
  std::rewind(file);
  for (char line[4096]; std::fgets(line, sizeof line, file);) {
    const std::string_view text(line);
    if (text != "\n" && text.find("no valid points") == text.npos) err << text;
  }
}

// Returns the exit status of `gnuplot -e commands script`, or -1 with errno if it cannot be started.
int runGnuplot(const std::string& commands, const std::string& script, std::ostream& err) {
  std::string words[] = {"gnuplot", "-e", commands, script};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages(std::tmpfile(), std::fclose);
  if (!messages) return -1;
  posix_spawn_file_actions_t redirect;
  posix_spawn_file_actions_init(&redirect);
  posix_spawn_file_actions_adddup2(&redirect, fileno(messages.get()), STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &redirect, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&redirect);
  if (error != 0) {
    errno = error;
    return -1;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  forwardMessages(messages.get(), err);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string gnuplotCommands(const Figure& figure, const ReportOptions& options) {
  return fmt::format("data='{}'; out='{}'; {}", (options.results / figure.study).string(),
                     (figureFolder(options) / figure.name).string(), figure.assignments);
}

// For use inside double quotes of the shell.
std::string shellQuoted(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '$' || c == '`' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted;
}

std::string commandOf(const std::string& study) { return study == kTableaus ? "tableau table" : "run " + study; }

bool hasResults(const Figure& figure, const ReportOptions& options) {
  return std::filesystem::is_directory(options.results / figure.study);
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

std::string studyTitle(const std::string& id, const ReportOptions& options) {
  if (id == kTableaus) return "Tableaus: stability, order stars, conditioning";
  const auto own = ownStudies(options.results);
  if (std::find(own.begin(), own.end(), id) != own.end()) return keptFigures(options.results, id).title;
  return loadStudy(id, StudyVariant::kQuick).title;
}

// Those of plots/figures.txt, then those of own studies: their names begin with the study's.
std::vector<Figure> allFigures(const ReportOptions& options) {
  auto figures = readFigures(options.home / "plots" / "figures.txt");
  for (const auto& study : ownStudies(options.results)) {
    requirePlainPath("study", study);
    const FigureTables kept = keptFigures(options.results, study);
    for (const auto& figure : kept.figures) {
      checkFigure(figure, options.home, {});
      figures.push_back({study, figure.script + ".gp", study + "_" + figure.name,
                         figure.title.empty() ? kept.title : figure.title, figure.caption,
                         assignmentsOf(figure.options), true});
    }
  }
  return figures;
}

bool isDrawn(const Figure& figure, const ReportOptions& options) {
  return std::filesystem::exists(figureFolder(options) / (figure.name + ".svg"));
}

// Returns whether the figure is drawn. An own figure without any row is a mistake; a built-in one belongs to a study
// that is not complete.
bool drawOne(const Figure& figure, const ReportOptions& options, std::ostream& err) {
  // What is left of an earlier drawing must not pass for this one.
  for (const auto* ending : {".svg", ".png"}) std::filesystem::remove(figureFolder(options) / (figure.name + ending));
  if (!drawFigure(figure.script, gnuplotCommands(figure, options), options.home, err)) return false;
  if (!figure.is_own || isDrawn(figure, options)) return true;
  fmt::print(err, "figure {} is not drawn: it selects no rows\n", figure.name);
  return false;
}

std::string figureHtml(const Figure& figure, const ReportOptions& options) {
  const auto command =
      fmt::format("gnuplot -e \"{}\" plots/{}", shellQuoted(gnuplotCommands(figure, options)), figure.script);
  return fmt::format(
      "<figure id=\"{0}\"><a href=\"figures/{0}.svg\"><img src=\"figures/{0}.svg\" alt=\"{1}\" "
      "loading=\"lazy\"></a>\n<figcaption><b>{1}.</b> {2} <a href=\"figures/{0}.png\">PNG</a>"
      "<code>{3}</code></figcaption></figure>\n",
      figure.name, escapeHtml(figure.title), escapeHtml(figure.caption), escapeHtml(command));
}

// The figures, each study's under its title; a study without figures gets no heading.
std::string figuresHtml(const std::vector<Figure>& figures, const ReportOptions& options) {
  std::string html;
  for (const auto& study : studiesOf(figures)) {
    std::string own;
    for (const auto& figure : figures) {
      if (figure.study == study && isDrawn(figure, options)) own += figureHtml(figure, options);
    }
    if (own.empty()) continue;
    html += fmt::format("<h3 id=\"study_{}\">{}</h3>\n{}", study, escapeHtml(studyTitle(study, options)), own);
  }
  return html;
}

}  // namespace

void requireResultsFolder(const std::filesystem::path& results) {
  std::error_code none;
  if (std::filesystem::is_directory(results, none)) return;
  throw Misuse(fmt::format("--results '{}': a folder of results is expected", results.string()));
}

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

bool drawFigure(const std::string& script, const std::string& commands, const std::filesystem::path& home,
                std::ostream& err) {
  const auto path = (home / "plots" / script).string();
  const int status = runGnuplot(commands, path, err);
  if (status < 0) {
    fmt::print(err, "cannot start gnuplot ({}): install the package gnuplot-nox\n", std::strerror(errno));
  } else if (status > 0) {
    fmt::print(err, "gnuplot ended with status {}: gnuplot -e \"{}\" {}\n", status, commands, path);
  }
  return status == 0;
}

int drawFigures(const std::string& study, const ReportOptions& options, std::ostream& err) {
  const auto figures = allFigures(options);
  requireResults(study, figures, options);
  std::filesystem::create_directories(figureFolder(options));
  int failures = 0;
  for (const auto& of : studiesOf(figures)) {
    const auto refusal = refusedTimes(options.results / of / "runs.csv");
    if (refusal.empty() || (!study.empty() && of != study)) continue;
    ++failures;
    fmt::print(err, "figures of {} have no times: {}\n", of, refusal);
  }
  for (const auto& figure : figures) {
    if ((!study.empty() && figure.study != study) || !hasResults(figure, options)) continue;
    if (!drawOne(figure, options, err)) ++failures;
  }
  return failures;
}

std::filesystem::path writeReport(const ReportOptions& options) {
  const auto figures = allFigures(options);
  std::string page = readInputFile(options.home / "plots" / "report.html");
  std::string orders, environment;
  for (const auto& study : studiesOf(figures)) {
    const auto folder = options.results / study;
    if (std::filesystem::exists(folder / "orders.csv")) {
      orders += ordersHtml(study, readTable(folder / "orders.csv"));
    }
    if (std::filesystem::exists(folder / "runs.csv")) {
      environment += environmentHtml(study, readTable(folder / "runs.csv"));
    }
  }
  const claims::ResultTables tables(options.results);
  replacePlaceholder(page, "@BANNER@",
                     tables.areQuick() ? "<p class=\"banner\"><b>A quick run:</b> small versions of all studies, "
                                         "which show that everything works. They give no verdicts on claims, and their "
                                         "orders and costs are coarse.</p>\n"
                                       : "");
  replacePlaceholder(page, "@CLAIMS@", claims::claimsHtml(tables, figureFolder(options)));
  replacePlaceholder(page, "@FIGURES@", figuresHtml(figures, options));
  replacePlaceholder(page, "@ORDER_WINDOW@", windowText());
  replacePlaceholder(page, "@TABLES@", orders);
  const auto tableaus = options.results / "tableaus" / "tableaus.csv";
  replacePlaceholder(
      page, "@TABLEAUS@",
      std::filesystem::exists(tableaus) ? tableausHtml(readTable(tableaus)) : "<p>None yet: irk tableau table.</p>");
  replacePlaceholder(page, "@ENVIRONMENT@", environment);
  replacePlaceholder(page, "@DATE@", dateText());
  auto path = options.results / "report" / "index.html";
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  if (!(out << page).flush()) {
    throw Failure(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  }
  return path;
}

}  // namespace irk
