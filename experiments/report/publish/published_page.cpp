#include "experiments/report/publish/published_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "experiments/claims/claims.h"
#include "experiments/claims/claims_text.h"
#include "experiments/report/publish/published_tables.h"
#include "experiments/tables/build_info.h"

namespace irk::report {
namespace {

constexpr const char* kScenes = "scenes";  // not an answer: a section of its own

constexpr PublishedFigure kPublishedFigures[] = {
    {"solver", "profile"},
    {"solver", "work_precision_mechanisms"},
    {"solver", "work_precision_discontinuous"},
    {"solver", "variable_order"},
    {"orders", "order_ode"},
    {"orders", "order_mechanical_index2"},
    {"orders", "order_reduction"},
    {"failures", "robustness"},
    {"failures", "audit"},
    {"failures", "audit_errors"},
    {"failures", "failure_stick_slip"},
    {"paper", "stages_slider_crank"},
    {"paper", "discontinuity_time"},
    {"paper", "contraction"},
    {kScenes, "scene_gallery"},
};

// The HTML of a cell of the report's page, without the elements that only its style needs. A bar would end the cell.
std::string markdownCell(const std::string& html) {
  std::string cell;
  for (std::size_t i = 0; i < html.size(); ++i) {
    const std::string_view rest = std::string_view(html).substr(i);
    if (rest.starts_with("<span") || rest.starts_with("</span")) {
      i = html.find('>', i);
    } else if (html[i] == '|') {
      cell += "\\|";
    } else {
      cell += html[i] == '\n' ? ' ' : html[i];
    }
  }
  return cell;
}

std::string markdownTable(const HtmlTable& table) {
  if (table.rows.empty()) return {};
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const auto& cell : cells) text += " " + markdownCell(cell) + " |";
    return text + "\n";
  };
  std::string text = "**" + table.caption + "**\n\n" + line(table.titles) + "|";
  for (std::size_t i = 0; i < table.titles.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : table.rows) text += line(row.cells);
  return text + "\n";
}

std::string figureText(const Figure& figure, bool quick) {
  return fmt::format("![{0}](figures/{1}.svg)\n\n*{0}.*{2} {3}\n\n", figure.title, figure.name,
                     quick ? " (Quick run: preliminary.)" : "", figure.caption);
}

std::string figuresOf(std::string_view section, const std::vector<Figure>& figures, bool quick) {
  std::string text;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (kPublishedFigures[i].answer == section) text += figureText(figures[i], quick);
  }
  return text;
}

// The folded rows of an answer are in its table.
std::string answerText(const Answer& answer, const std::vector<Figure>& figures, bool quick) {
  std::string text = fmt::format("## {}\n\n", answer.question);
  for (const auto& sentence : answer.sentences) text += sentence + "\n\n";
  text += markdownTable(answer.shown);
  if (!answer.note.empty()) text += answer.note + "\n\n";
  return text + figuresOf(answer.id, figures, quick);
}

std::string claimsText(const ReportOptions& options) {
  HtmlTable table{.caption = "Every claim of the paper",
                  .titles = {"", "claim", "in the paper's setting", "in the best setting", "measured"}};
  for (const auto& findings : claims::judgeClaims(claims::protocol(), claims::ResultTables(options.results))) {
    std::vector<std::string> numbers;
    for (std::size_t i = 0; i < findings.parts.size(); ++i) {
      const auto& part = findings.claim->parts[i];
      const auto number = [&](claims::Setting setting) {
        const auto& judged = findings.parts[i][static_cast<std::size_t>(setting)].judged;
        const bool lacks = judged.cases > 0 && judged.verdict == claims::Verdict::kNotMeasurable;
        return claims::explainedNumber(part, judged) + (lacks ? " (" + judged.reason + ")" : "");
      };
      const std::string condition = claims::conditionText(part);
      numbers.push_back(escapeHtml(fmt::format("{}: {} / {}{}", part.name, number(claims::Setting::kPaper),
                                               number(claims::Setting::kBest),
                                               condition.empty() ? "" : "; confirmed if " + condition)));
    }
    table.rows.push_back({{fmt::format("<a id=\"{0}\"></a>{0}", findings.claim->id), escapeHtml(findings.claim->title),
                           std::string(verdictText(findings.verdict(claims::Setting::kPaper))),
                           std::string(verdictText(findings.verdict(claims::Setting::kBest))),
                           fmt::format("{}", fmt::join(numbers, "<br>"))}});
  }
  return markdownTable(table) +
         "The numbers are those of the two settings. A percentage is the share of the cases that fulfil the condition, "
         "not the quantity itself; brackets hold 90 % intervals, an en dash means no number. `tables/claims.csv` has "
         "each part with its cases and the reason where there is no verdict.\n\n";
}

// All values of a column, each once.
std::string valuesOf(const Table& table, std::string_view column) {
  std::set<std::string> values;
  for (const auto& row : table.rows) values.insert(row[table.column(column)]);
  return fmt::format("{}", fmt::join(values, "; "));
}

std::string originText(const PublishedRuns& runs) {
  const Table& table = runs.table;
  std::size_t count = 0;
  std::string first, last;
  for (const auto& row : table.rows) {
    count += std::strtoull(row[table.column("runs")].c_str(), nullptr, 10);
    const std::string& dates = row[table.column("date")];
    const std::string begin = dates.substr(0, dates.find(' ')), end = dates.substr(dates.rfind(' ') + 1);
    first = first.empty() ? begin : std::min(first, begin);
    last = std::max(last, end);
  }
  HtmlTable origin{.caption = "Where the numbers come from", .titles = {"", ""}};
  const auto add = [&](const char* what, const std::string& value) {
    origin.rows.push_back({{what, escapeHtml(value)}});
  };
  add("runs", fmt::format("{} in {} studies", count, table.rows.size()));
  add("made", fmt::format("{} to {}", first, last));
  add("version, commit of the runs", fmt::format("{}, {}", valuesOf(table, "version"), valuesOf(table, "commit")));
  add("code of the numbers", std::string(buildInfo().code));
  for (const auto& [what, column] : {std::pair{"processor", "cpu"},
                                     {"compiler", "compiler"},
                                     {"options of the compiler", "flags"},
                                     {"libraries", "libraries"}}) {
    add(what, valuesOf(table, column));
  }
  std::string text = markdownTable(origin);
  if (runs.doubts.empty()) return text;
  text +=
      "The processor's speed varied while times were measured. A fixed computation is timed about once a second:\n\n";
  for (const auto& doubt : runs.doubts) text += fmt::format("- {}\n", doubt);
  return text + "\n";
}

std::string tablesText() {
  std::string text =
      "## Tables\n\n`irk list columns` and [the guide](../../experiments/guide/tables.md) say what each column "
      "means.\n\n"
      "| table | one row |\n|---|---|\n";
  for (const auto& table : publishedTables())
    text += fmt::format("| [{0}.csv](tables/{0}.csv) | {1} |\n", table.name, table.row);
  return text + "| [published.csv](published.csv) | a study: its runs, program, machine and dates |\n\n";
}

}  // namespace

std::span<const PublishedFigure> publishedFigures() { return kPublishedFigures; }

std::string publishedPage(const ReportOptions& options, const std::vector<Answer>& answers,
                          const std::vector<Figure>& figures, const PublishedRuns& runs) {
  const bool quick = areQuick(options);
  std::string text = fmt::format("# Results of irkbench {}\n\n", buildInfo().version);
  if (quick) {
    text +=
        "**A quick run**: small versions of all studies. They give no verdicts on claims, and all numbers are "
        "preliminary.\n\n";
  }
  text += fmt::format(
      "Made by `irk publish` from the tables of `irk paper{0}` and `irk run audit{0}`; nothing is written by hand. CPU "
      "times are those of one machine.\n\n",
      quick ? " --quick" : "");
  if (!runs.doubts.empty()) {
    text +=
        "**CPU times of some studies are doubtful**: the processor's speed varied while they were measured "
        "([Origin](#origin)). Ratios near 1 mean little.\n\n";
  }
  for (const auto& answer : answers) text += answerText(answer, figures, quick);
  text += claimsText(options);
  text += "## The scenes\n\n[problems](../../problems/README.md) says what each of them is.\n\n" +
          figuresOf(kScenes, figures, quick);
  return text + tablesText() + "## Origin\n\n" + originText(runs) +
         "`irk compare FOLDER FOLDER` says what differs between two publications.\n";
}

}  // namespace irk::report
