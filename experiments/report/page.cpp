#include "experiments/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/input_file.h"
#include "experiments/analyses/orders/order_fit.h"
#include "experiments/analyses/results.h"
#include "experiments/base/html.h"
#include "experiments/claims/claims.h"
#include "experiments/claims/claims_html.h"
#include "experiments/report/answers/failures.h"
#include "experiments/report/answers/order_answer.h"
#include "experiments/report/answers/paper.h"
#include "experiments/report/answers/solvers.h"
#include "experiments/report/answers/study_answers.h"
#include "experiments/report/figure_html.h"
#include "experiments/report/html_tables.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/ratios_html.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_file.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr const char* kPreliminary = " (quick run: preliminary)";

// The name of a study's section.
struct StudyTexts {
  std::string title, question;
};

StudyTexts textsOf(const std::string& id, const ReportOptions& options) {
  if (id == kTableauResults) {
    return {"Tableaus: stability, order stars, conditioning", "Which properties do the families have?"};
  }
  for (const auto& study : builtinStudies()) {
    if (study.id != id) continue;
    const StudyFile file = parseStudyFile(study.toml, id + ".toml", StudyVariant::kFull);
    const auto text = [&](std::string_view key) {
      const auto found = file.study.find(key);
      return found == file.study.end() || found->second.items.empty() ? std::string() : found->second.items.front();
    };
    return {text("title"), text("question")};
  }
  return {ownTitle(options.results, id), {}};
}

// How the clock rate changed while the times of `runs` were measured; empty if there are no doubts.
std::string driftHtml(const std::filesystem::path& runs) {
  const std::string drift = timesDrift(runs);
  if (drift.empty()) return {};
  constexpr std::string_view kUpTo = "up to ";
  double most = 0;  // of several hosts
  for (auto at = drift.find(kUpTo); at != drift.npos; at = drift.find(kUpTo, at + 1)) {
    most = std::max(most, std::strtod(drift.c_str() + at + kUpTo.size(), nullptr));
  }
  const std::string rate =
      most > 0 ? fmt::format(
                     "the clock rate of this machine changed by a factor of up to {:.2f} during the study; "
                     "ratios of times below that mean little where they stand alone",
                     most)
               : "they are doubtful";
  return fmt::format("<p class=\"note drift\"><b>Times:</b> {} ({}). Counts are exact.</p>\n", rate, escapeHtml(drift));
}

// On how many cores at once the times of `runs` were measured; empty if that is not known.
std::string coresHtml(const std::filesystem::path& runs) {
  const std::string cores = timingCores(runs);
  if (cores.empty()) return {};
  return fmt::format("<p class=\"note\">Cores on which times were measured at once: {}.</p>\n", escapeHtml(cores));
}

// The page with the results of one program.
class Page {
 public:
  explicit Page(const ReportOptions& options)
      : options_(options), tables_(options.results), quick_(areQuick(options)), figures_(allFigures(options)) {}

  /// `rest` is the page without the answers; links to parts that it does not have are left out.
  std::string answers(const std::vector<report::Answer>& answers, std::string_view rest) const;
  std::string claims() const { return claims::claimsHtml(tables_, figureFolder(options_)); }
  std::string contents() const;
  std::string studies() const;
  std::string tableaus() const;
  std::string environment() const;

 private:
  std::vector<std::string> studyIds() const;
  std::filesystem::path folder(const std::string& study) const { return options_.results / study; }
  std::string table(HtmlTable table) const;
  std::string tableLinks(const std::string& study) const;
  std::string ordersOf(const std::string& study) const;
  std::string ratiosOf(const std::string& study) const;
  std::string figuresOf(const std::string& study) const;
  std::string section(const std::string& study) const;

  const ReportOptions& options_;
  claims::ResultTables tables_;
  bool quick_;
  std::vector<Figure> figures_;
};

// Studies with results: first those with figures, in the order of figures.txt.
std::vector<std::string> Page::studyIds() const {
  auto ids = studiesOf(figures_);
  for (const auto& study : builtinStudies()) {
    if (std::find(ids.begin(), ids.end(), study.id) == ids.end()) ids.emplace_back(study.id);
  }
  std::erase_if(
      ids, [&](const std::string& id) { return id == kTableauResults || !std::filesystem::is_directory(folder(id)); });
  return ids;
}

std::string Page::table(HtmlTable table) const {
  if (quick_) table.caption += kPreliminary;
  return htmlOf(table);
}

std::string Page::answers(const std::vector<report::Answer>& answers, std::string_view rest) const {
  std::string html;
  for (auto answer : answers) {
    std::erase_if(answer.links, [&](const auto& link) {
      return rest.find(fmt::format("id=\"{}\"", link.first.substr(1))) == rest.npos;
    });
    for (auto* shown : {&answer.shown, &answer.more}) {
      if (quick_) shown->caption += kPreliminary;
    }
    if (!answer.table.columns.empty())
      answer.links.emplace_back(fmt::format("answers_{}.csv", answer.id), "table as CSV");
    html += answerHtml(answer, quick_);
  }
  return html;
}

std::string Page::contents() const {
  std::string html;
  for (const auto& study : studyIds()) {
    const auto texts = textsOf(study, options_);
    html += fmt::format("<li>{}</li>\n",
                        linkHtml("#study_" + study, texts.question.empty() ? texts.title : texts.question));
  }
  return html.empty() ? "<p>No study has been run yet: irk paper runs all.</p>\n"
                      : "<ul class=\"contents\">\n" + html + "</ul>\n";
}

// Links to the study's tables; solutions of single runs, <scene>.<method>.csv, are left to their figures.
std::string Page::tableLinks(const std::string& study) const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder(study))) {
    const auto& path = entry.path();
    if (path.extension() == ".csv" && path.stem().string().find('.') == std::string::npos)
      names.push_back(path.filename());
  }
  std::sort(names.begin(), names.end());
  std::string links;
  for (const auto& name : names) links += " " + linkHtml(fmt::format("../{}/{}", study, name), name);
  return links.empty() ? "" : fmt::format("<p class=\"tables\">Tables:{}</p>\n", links);
}

std::string Page::ordersOf(const std::string& study) const {
  const auto file = folder(study) / "orders.csv";
  if (!std::filesystem::exists(file)) return {};
  const Table orders = readTable(file);
  return fmt::format(
      "<details id=\"{}_table\"><summary>All {} orders with theory, window and verdict</summary>\n<p>An order is a "
      "least-squares slope over a window above round-off and below the pre-asymptotic range: of {}. Where no such "
      "window "
      "gives a slope that is certain enough, it is not measurable, and the table says why.</p>\n{}</details>\n",
      study, orders.rows.size(), windowText(), table(ordersHtml(orders)));
}

std::string Page::ratiosOf(const std::string& study) const {
  const auto file = folder(study) / "ratios.csv";
  if (!std::filesystem::exists(file)) return {};
  const Table ratios = readTable(file);
  return table(ratiosHtml(ratios));
}

std::string Page::figuresOf(const std::string& study) const {
  std::string html;
  for (const auto& one : figures_) {
    if (one.study == study && isDrawn(one, options_)) html += figureHtml(one, options_);
  }
  return html.empty() ? "" : "<div class=\"figures\">\n" + html + "</div>\n";
}

std::string Page::section(const std::string& study) const {
  const auto [title, question] = textsOf(study, options_);
  std::string html = fmt::format("<section id=\"study_{}\">\n<h3>{}</h3>\n", study, escapeHtml(title));
  if (!question.empty()) html += fmt::format("<p class=\"question\">{}</p>\n", escapeHtml(question));
  try {
    for (const auto& sentence : report::studyAnswers(study, tables_)) {
      html += fmt::format("<p>{}{}</p>\n", quick_ ? "<em>Preliminary.</em> " : "", report::codeHtml(sentence));
    }
  } catch (const Misuse& old) {  // a table of another version
    html += fmt::format("<p>{}</p>\n", escapeHtml(old.what()));
  }
  const auto runs = folder(study) / "runs.csv";
  return html + coresHtml(runs) + driftHtml(runs) + tableLinks(study) + ordersOf(study) + ratiosOf(study) +
         figuresOf(study) + "</section>\n";
}

std::string Page::studies() const {
  std::string html;
  for (const auto& study : studyIds()) html += section(study);
  return html;
}

std::string Page::tableaus() const {
  const std::string id(kTableauResults);
  const auto file = folder(id) / "tableaus.csv";
  if (!std::filesystem::exists(file)) return "<p>None yet: irk tableau table.</p>\n";
  return tableLinks(id) +
         fmt::format("<details><summary>All families, 1 to 20 stages</summary>\n{}</details>\n",
                     htmlOf(tableausHtml(readTable(file)))) +
         figuresOf(id);
}

std::string Page::environment() const {
  Environments environments;
  for (const auto& study : studyIds()) {
    const auto runs = folder(study) / "runs.csv", file = folder(study) / "environments.csv";
    if (!std::filesystem::exists(runs) || !std::filesystem::exists(file)) continue;
    environments.add(study, readTable(file), usedEnvironments(runs));
  }
  const std::string html = htmlOf(environments.table());
  return html.empty() ? "<p>No runs yet.</p>\n" : html;
}

}  // namespace

std::vector<report::Answer> pageAnswers(const ReportOptions& options) {
  const claims::ResultTables tables(options.results);
  std::vector<report::Answer> answers;
  const auto add = [&](const char* id, const char* study, auto make) {
    try {
      answers.push_back(make(tables));
    } catch (const Misuse& old) {  // a table of another version
      answers.push_back(report::unknownAnswer(id, id, study));
      answers.back().sentences.emplace_back(old.what());
    }
  };
  add("solver", "work_precision", report::solverAnswer);
  add("orders", "order", report::orderAnswer);
  add("failures", "audit", report::failureAnswer);
  add("paper", "audit", [](const claims::ResultTables& t) { return report::paperAnswer(t); });
  for (auto& answer : answers) {
    auto& head = answer.table.head;
    if (head.empty()) head = {{"study", "all"}, {"date", dateText()}};
    const bool said = std::any_of(head.begin(), head.end(), [](const auto& entry) { return entry.first == "quick"; });
    if (areQuick(options) && !said) head.emplace_back("quick", "small versions of the studies; preliminary");
  }
  return answers;
}

std::string pageHtml(const ReportOptions& options, const std::vector<report::Answer>& answers) {
  const auto plots = options.home / "plots" / "page";
  std::string html = readInputFile(plots / "report.html");
  const Page page(options);
  const bool explorer = std::filesystem::exists(options.results / "report" / "explore.html");
  // Texts of results come last, so that nothing is replaced in them.
  replacePlaceholder(html, "@COMMON@", readInputFile(plots / "common.css"));
  replacePlaceholder(html, "@STYLE@", readInputFile(plots / "report.css"));
  replacePlaceholder(html, "@SCRIPT@", readInputFile(plots / "report.js"));
  replacePlaceholder(html, "@DATE@", dateText());
  replacePlaceholder(html, "@EXPLORER@", explorer ? "<a href=\"explore.html\">Explorer</a>" : "");
  replacePlaceholder(html, "@BANNER@",
                     areQuick(options)
                         ? "  <p class=\"banner\"><b>A quick run:</b> small versions of all studies, which show "
                           "that everything works. They give no verdicts on claims; all numbers are preliminary.</p>\n"
                         : "");
  replacePlaceholder(html, "@CONTENTS@", page.contents());
  replacePlaceholder(html, "@ENVIRONMENT@", page.environment());
  replacePlaceholder(html, "@TABLEAUS@", page.tableaus());
  replacePlaceholder(html, "@CLAIMS@", page.claims());
  replacePlaceholder(html, "@STUDIES@", page.studies());
  replacePlaceholder(html, "@ANSWERS@", page.answers(answers, html));
  return html;
}

}  // namespace irk
