#include "experiments/report/answers/failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/builtin_studies.h"

namespace irk::report {
namespace {

constexpr const char* kQuestion = "Where do methods fail?";
constexpr std::string_view kSuccess = "success";
constexpr std::string_view kRefused = "refused";  // combinations that are not allowed; no runs
constexpr std::size_t kFewRuns = 10;              // too few for a comparison of percentages

using Counts = std::map<std::string, std::size_t>;  // outcome -> runs

std::size_t total(const Counts& counts) {
  std::size_t sum = 0;
  for (const auto& [outcome, count] : counts) sum += count;
  return sum;
}

std::size_t successes(const Counts& counts) {
  const auto found = counts.find(std::string(kSuccess));
  return found == counts.end() ? 0 : found->second;
}

double failedPart(const Counts& counts) {
  const auto all = static_cast<double>(total(counts));
  return all > 0 ? 1 - static_cast<double>(successes(counts)) / all : 0;
}

// The causes of failure, the most frequent first.
std::vector<std::pair<std::string, std::size_t>> causesOf(const Counts& counts) {
  std::vector<std::pair<std::string, std::size_t>> causes;
  for (const auto& [outcome, count] : counts) {
    if (outcome != kSuccess) causes.emplace_back(outcome, count);
  }
  std::stable_sort(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return causes;
}

std::string causesText(const Counts& counts) {
  std::vector<std::string> parts;
  for (const auto& [cause, count] : causesOf(counts)) parts.push_back(fmt::format("{} ({})", causeTitle(cause), count));
  return listText(parts);
}

std::string percent(double part) {
  return part > 0 && part < 0.001 ? "below 0.1 %"
                                  : fmt::format("{:.{}f} %", 100 * part, part > 0 && part < 0.1 ? 1 : 0);
}

std::string methodKind(const Table& runs, const TableRow& row) {
  const auto& method = textAt(runs, row, "method");
  return findPeer(method) ? method : textAt(runs, row, "configuration");
}

struct Sample {
  std::string name;
  std::map<std::string, Counts> kinds = {};  // by kind of method
  Counts all = {};
};

void addRuns(const Table& runs, bool adaptive_only, Sample& sample) {
  for (const auto& row : runs.rows) {
    const auto& outcome = textAt(runs, row, "outcome");
    if (outcome == kRefused || (adaptive_only && hasFixedStepsAt(runs, row))) continue;
    ++sample.kinds[methodKind(runs, row)][outcome];
    ++sample.all[outcome];
  }
}

std::vector<Sample> samplesOf(const claims::ResultTables& tables) {
  Sample drawn{.name = "audit, drawn at random"}, other{.name = "other studies"};
  for (const auto& study : builtinStudies()) {
    if (study.id.starts_with("failure_")) continue;
    try {
      addRuns(tables.runs(study.id), true, study.id == "audit" ? drawn : other);
    } catch (const claims::MissingResults&) {
      continue;  // a study that has not been run
    }
  }
  std::vector<Sample> samples;
  for (auto* sample : {&drawn, &other}) {
    if (!sample->all.empty()) samples.push_back(std::move(*sample));
  }
  return samples;
}

std::string worstSentence(const Sample& sample) {
  const std::pair<const std::string, Counts>*worst = nullptr, *best = nullptr;
  for (const auto& kind : sample.kinds) {
    if (total(kind.second) < kFewRuns) continue;
    if (!worst || failedPart(kind.second) > failedPart(worst->second)) worst = &kind;
    if (!best || failedPart(kind.second) < failedPart(best->second)) best = &kind;
  }
  if (!worst || worst == best || failedPart(worst->second) == failedPart(best->second)) return {};
  return fmt::format("`{}` fails most often, in {} of its runs, mostly by {}; `{}` least often, in {}.", worst->first,
                     percent(failedPart(worst->second)), causeTitle(causesOf(worst->second).front().first), best->first,
                     percent(failedPart(best->second)));
}

void appendRows(const Sample& sample, const std::vector<std::string>& causes, Answer& answer) {
  const auto append = [&](const std::string& kind, const Counts& counts, const std::string& css_class) {
    const auto all = static_cast<double>(total(counts));
    HtmlTable::Row row{
        {escapeHtml(sample.name), escapeHtml(kind), fmt::format("{}", total(counts)), percent(failedPart(counts))},
        css_class};
    TableRow cells{sample.name, kind, fmt::format("{}", total(counts)), fmt::format("{}", successes(counts))};
    for (const auto& cause : causes) {
      const auto found = counts.find(cause);
      const std::size_t count = found == counts.end() ? 0 : found->second;
      cells.push_back(fmt::format("{}", count));
      std::string text = fmt::format("{} ({})", count, percent(static_cast<double>(count) / all));
      replacePlaceholder(text, " ", "&nbsp;");
      row.cells.push_back(count == 0 ? "–" : text);
    }
    answer.shown.rows.push_back(std::move(row));
    answer.table.rows.push_back(std::move(cells));
  };
  for (const auto& [kind, counts] : sample.kinds) append(kind, counts, "");
  append("all", sample.all, "sum");
}

}  // namespace

std::string causeTitle(std::string_view outcome) {
  static const std::map<std::string_view, const char*> titles{{"newton_failed", "Newton's method fails"},
                                                              {"step_too_small", "step too small"},
                                                              {"max_steps", "too many steps"},
                                                              {"timeout", "too slow"},
                                                              {"not_finite", "not finite"},
                                                              {"singular", "singular matrix"},
                                                              {"inconsistent_start", "inconsistent start"},
                                                              {"chattering", "chattering"},
                                                              {"stalled", "steps stay tiny"},
                                                              {"drift", "drift"},
                                                              {"inaccurate", "errors add up"},
                                                              {"refused", "not allowed"}};
  const auto found = titles.find(outcome);
  return found == titles.end() ? std::string(outcome) : found->second;
}

std::string outcomeSentence(const Table& runs) {
  Counts counts;
  for (const auto& row : runs.rows) ++counts[textAt(runs, row, "outcome")];
  const std::string text = fmt::format("{} runs, {} successful", total(counts), successes(counts));
  return successes(counts) == total(counts) ? text + "." : fmt::format("{}; the others: {}.", text, causesText(counts));
}

std::string wrongSentence(const claims::ResultTables& tables) {
  try {
    const Table& summary = tables.table("audit", "audit_summary");
    for (const auto& row : summary.rows) {
      if (textAt(summary, row, "by") != "all") continue;
      const double wrong = numberAt(summary, row, "wrong"), right = numberAt(summary, row, "right");
      return fmt::format(
          "Of the {:.0f} successes that can be judged, {:.0f} are wrong: their error is above 1000 tolerances.",
          right + wrong, wrong);
    }
  } catch (const claims::MissingResults&) {
  }
  return {};
}

Answer failureAnswer(const claims::ResultTables& tables) {
  Answer answer = unknownAnswer("failures", kQuestion, "audit");
  const auto samples = samplesOf(tables);
  if (samples.empty()) return answer;
  answer.sentences.clear();
  const Sample& first = samples.front();
  const std::size_t failed = total(first.all) - successes(first.all);
  answer.sentences.push_back(fmt::format("Of {} runs ({}), {} fail, {}{}.", total(first.all), first.name, failed,
                                         percent(failedPart(first.all)),
                                         failed > 0 ? ": " + causesText(first.all) : ""));
  for (auto sentence : {worstSentence(first), wrongSentence(tables)}) {
    if (!sentence.empty()) answer.sentences.push_back(std::move(sentence));
  }
  Counts all;
  for (const auto& sample : samples) {
    for (const auto& [outcome, count] : sample.all) all[outcome] += count;
  }
  std::vector<std::string> causes;
  for (const auto& [cause, count] : causesOf(all)) causes.push_back(cause);
  answer.table.columns = {"sample", "method", "runs", "success"};
  answer.table.columns.insert(answer.table.columns.end(), causes.begin(), causes.end());
  answer.shown = {.caption = "Failed runs by cause", .titles = {"runs of", "kind of method", "runs", "failed"}};
  for (const auto& cause : causes) answer.shown.titles.push_back(causeTitle(cause));
  for (const auto& sample : samples) appendRows(sample, causes, answer);
  answer.note =
      "`default`, `paper`, `embedded` and `variable` are configurations of this suite; the others are other libraries' "
      "solvers. "
      "Runs with fixed steps and the studies that provoke failures are not counted here.";
  answer.links = {{"#study_audit", "can success be believed?"},
                  {"#study_failure_constraints", "maps of failures: constraints"},
                  {"#study_failure_stability", "stiffness"},
                  {"#study_failure_newton", "Newton's method"}};
  return answer;
}

}  // namespace irk::report
