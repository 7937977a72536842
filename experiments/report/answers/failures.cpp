#include "experiments/report/answers/failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/audit/row_judgement.h"
#include "experiments/runs/run_table.h"

namespace irk::report {
namespace {

constexpr const char* kFailureQuestion = "Where do methods fail?";
constexpr const char* kFailureStudy = "work_precision";  // the same problems and tolerances for every solver
constexpr std::string_view kSuccess = "success";
constexpr std::string_view kRefused = "refused";  // combinations that are not allowed; no runs

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

std::string causesText(const Counts& counts) {
  std::vector<std::pair<std::string, std::size_t>> causes;
  for (const auto& [outcome, count] : counts) {
    if (outcome != kSuccess) causes.emplace_back(outcome, count);
  }
  std::stable_sort(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> parts;
  for (const auto& [cause, count] : causes) parts.push_back(fmt::format("{} ({})", causeTitle(cause), count));
  return listText(parts);
}

std::string percent(double part) {
  return part > 0 && part < 0.001 ? "below 0.1 %"
                                  : fmt::format("{:.{}f} %", 100 * part, part > 0 && part < 0.1 ? 1 : 0);
}

/// How the runs of one solver, or on one scene, end.
struct Ends {
  std::size_t runs = 0, failed = 0, wrong = 0;
  Counts outcomes = {};
  double bad() const { return runs > 0 ? static_cast<double>(failed + wrong) / static_cast<double>(runs) : 0; }
};
using EndsOf = std::map<std::string, Ends>;

void add(const Table& runs, const TableRow& row, Ends& ends) {
  ++ends.runs;
  if (!succeededAt(runs, row)) {
    ++ends.failed;
    ++ends.outcomes[textAt(runs, row, "outcome")];
  } else if (audit::judgeRow(runs, row) == audit::Judgement::kWrong) {
    ++ends.wrong;
  }
}

EndsOf endsBy(std::string_view column, const Table& runs) {
  EndsOf ends;
  for (const auto& row : runs.rows) {
    if (textAt(runs, row, "outcome") != kRefused) add(runs, row, ends[textAt(runs, row, column)]);
  }
  return ends;
}

// The most unreliable ones first.
std::vector<std::pair<std::string, Ends>> sorted(const EndsOf& ends) {
  std::vector<std::pair<std::string, Ends>> list(ends.begin(), ends.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.second.bad() > b.second.bad(); });
  return list;
}

std::string endsText(const Ends& ends) {
  const auto part = [&](std::size_t count) {
    return percent(static_cast<double>(count) / static_cast<double>(ends.runs));
  };
  return fmt::format("{} of its runs fail and {} are wrong", part(ends.failed), part(ends.wrong));
}

// `most`: "most" or "least"; several solvers may be equally reliable.
std::string reliabilityText(std::string_view most, const Ends& ends,
                            const std::vector<std::pair<std::string, Ends>>& solvers) {
  std::vector<std::string> equal;
  for (const auto& [solver, others] : solvers) {
    if (others.bad() == ends.bad()) equal.push_back(fmt::format("`{}`", solver));
  }
  if (equal.size() == 1) return fmt::format("The {} reliable is {}: {}.", most, equal.front(), endsText(ends));
  return fmt::format("The {} reliable are {}: {} of the runs of each fail or are wrong.", most, listText(equal),
                     percent(ends.bad()));
}

std::vector<std::string> sentencesOf(const EndsOf& by_solver, const EndsOf& by_scene) {
  Ends all;
  for (const auto& [solver, ends] : by_solver) {
    all.runs += ends.runs;
    all.failed += ends.failed;
    all.wrong += ends.wrong;
  }
  std::vector<std::string> sentences{
      fmt::format("{} solvers at the same problems and tolerances: of {} runs, {} say that they fail, and {} call a "
                  "wrong result a success.",
                  by_solver.size(), all.runs, all.failed, all.wrong)};
  const auto solvers = sorted(by_solver);
  if (solvers.size() > 1 && solvers.front().second.bad() > solvers.back().second.bad()) {
    sentences.push_back(reliabilityText("most", solvers.back().second, solvers) + " " +
                        reliabilityText("least", solvers.front().second, solvers));
  }
  constexpr std::size_t kHardest = 3;
  std::vector<std::string> hardest;
  for (const auto& [scene, ends] : sorted(by_scene)) {
    if (hardest.size() == kHardest || ends.failed + ends.wrong == 0) break;
    hardest.push_back(fmt::format("{} ({})", scene, percent(ends.bad())));
  }
  if (!hardest.empty()) {
    sentences.push_back(fmt::format(
        "The problems with the largest share of failed or wrong runs, over all solvers: {}.", listText(hardest)));
  }
  return sentences;
}

void appendRow(const std::string& solver, const Ends& ends, Answer& answer) {
  const auto cellOf = [&](std::size_t count) {
    if (count == 0) return std::string("–");
    std::string text =
        fmt::format("{} ({})", count, percent(static_cast<double>(count) / static_cast<double>(ends.runs)));
    replacePlaceholder(text, " ", "&nbsp;");
    return text;
  };
  answer.shown.rows.push_back({{escapeHtml(solver), fmt::format("{}", ends.runs), cellOf(ends.failed),
                                cellOf(ends.wrong), ends.failed > 0 ? escapeHtml(causesText(ends.outcomes)) : "–"}});
  TableRow cells{solver, fmt::format("{}", ends.runs), fmt::format("{}", ends.failed), fmt::format("{}", ends.wrong)};
  for (std::size_t i = cells.size(); i < answer.table.columns.size(); ++i) {
    const auto found = ends.outcomes.find(answer.table.columns[i]);
    cells.push_back(fmt::format("{}", found == ends.outcomes.end() ? 0 : found->second));
  }
  answer.table.rows.push_back(std::move(cells));
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
                                                              {"no_event", "no such event"},
                                                              {"inaccurate", "error bar too large"},
                                                              {"exception", "own code throws"},
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
          "Of the {:.0f} successes of the audit that can be judged, {:.0f} are wrong: their error is above 1000 "
          "tolerances.",
          right + wrong, wrong);
    }
  } catch (const claims::MissingResults&) {
  }
  return {};
}

Answer failureAnswer(const claims::ResultTables& tables) {
  Answer answer = unknownAnswer("failures", kFailureQuestion, kFailureStudy);
  answer.links = {{"#robustness", "by tolerance"},
                  {"#study_audit", "can success be believed?"},
                  {"#study_failure_constraints", "maps of failures: constraints"},
                  {"#study_failure_stability", "stiffness"},
                  {"#study_failure_newton", "Newton's method"}};
  try {
    const Table& runs = tables.runs(kFailureStudy);
    const EndsOf by_solver = endsBy("integrator", runs);
    answer.sentences = sentencesOf(by_solver, endsBy("scene", runs));
    Counts causes;
    for (const auto& [solver, ends] : by_solver) {
      for (const auto& [outcome, count] : ends.outcomes) causes[outcome] += count;
    }
    answer.table = {runs.head, {"solver", "runs", "failed", "wrong"}, {}};
    for (const auto& [outcome, count] : causes) answer.table.columns.push_back(outcome);
    answer.shown = {.caption = "How runs end, at the same problems and tolerances",
                    .titles = {"solver", "runs", "failed", "wrong successes", "failed because of"}};
    for (const auto& [solver, ends] : sorted(by_solver)) appendRow(solver, ends, answer);
    answer.note =
        "Failed: the run says so itself. Wrong: a success with an error above 1000 tolerances. A solver is asked only "
        "for problems that it can treat. Steps stay tiny: so small that the end is out of reach. Error bar too large: "
        "a second integration differs by more than 1000 tolerances. Drift: of a constraint. "
        "Studies that provoke failures are not counted here.";
  } catch (const claims::MissingResults&) {
  }
  if (auto sentence = wrongSentence(tables); !sentence.empty()) answer.sentences.push_back(std::move(sentence));
  return answer;
}

}  // namespace irk::report
