#include "experiments/report/answers/solvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/audit/row_judgement.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/configurations.h"
#include "experiments/runs/run_table.h"

namespace irk::report {
namespace {

constexpr const char* kCostStudy = "work_precision";
constexpr const char* kSolverQuestion = "Which solver should I use?";
constexpr double kAskedErrors[] = {1e-4, 1e-8, 1e-11};
constexpr double kAsGood = 1.15;  // times of the same runs differ by that much from one day to the next

// A block of the study is named after its collection and its part of the solvers: ivp_variable. A run can be in several
// blocks.
std::vector<std::string> kindsOf(const Table& table, const TableRow& row) {
  std::vector<std::string> kinds;
  std::istringstream blocks(textAt(table, row, kBlockColumn));
  for (std::string block; blocks >> block;) kinds.push_back(block.substr(0, block.find('_')));
  return kinds;
}

bool isOfKind(const Table& table, const TableRow& row, const std::string& kind) {
  const auto kinds = kindsOf(table, row);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

std::string kindTitle(const std::string& kind) {
  if (kind == "ivp") return "the IVP test set";
  if (kind == "multibody") return "mechanisms";
  if (kind == "switching") return "systems with switches";
  if (kind == "probes") return "small problems with one difficulty each";
  return kind;
}

std::vector<std::string> kindsOf(const Table& table) {
  std::vector<std::string> kinds;
  for (const auto& row : table.rows) {
    for (const auto& kind : kindsOf(table, row)) {
      if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
    }
  }
  return kinds;
}

// Those of kAskedErrors that the study compares, and that some solver was asked for.
std::vector<double> errorsOf(const Table& costs) {
  std::vector<double> errors;
  for (const double asked : kAskedErrors) {
    const bool compared = std::any_of(costs.rows.begin(), costs.rows.end(), [&](const TableRow& row) {
      return isComparable(costs, row) && std::abs(numberAt(costs, row, "target_error") / asked - 1) < 1e-9;
    });
    if (compared) errors.push_back(asked);
  }
  return errors;
}

struct Outcomes {
  int runs = 0, failed = 0, wrong = 0;
};

Outcomes outcomesOf(const Table& runs, const std::string& kind, const std::string& solver) {
  Outcomes count;
  for (const auto& row : runs.rows) {
    if (textAt(runs, row, "integrator") != solver || !isOfKind(runs, row, kind)) continue;
    if (textAt(runs, row, "outcome") == "refused") continue;
    ++count.runs;
    if (!succeededAt(runs, row)) {
      ++count.failed;
    } else if (audit::judgeRow(runs, row) == audit::Judgement::kWrong) {
      ++count.wrong;
    }
  }
  return count;
}

// The answer for one kind of problem and one error.
struct Choice {
  std::string kind;
  double error = 0;
  int problems = 0;
  Ranked best = {}, library = {};    ///< without a name: there is none
  std::vector<Ranked> as_good = {};  ///< others that solve as many or one less, and are not slower than kAsGood
  double over_library = std::numeric_limits<double>::quiet_NaN();
  Outcomes outcomes = {};
};

// Solvers of the suite are named configuration:method, or after a configuration with variable order. What a user gave a
// study to compare with (irk run --peers) is in its tables only, not in the catalogue of peers.
bool isPeer(const std::string& solver) {
  const auto all = configurations();
  return solver.find(':') == solver.npos &&
         std::none_of(all.begin(), all.end(), [&](const Configuration& one) { return one.id == solver; });
}

// `a`, `b` and `c`: the solvers of other libraries in the table.
std::string peersOf(const Table& costs) {
  std::set<std::string> found;
  for (const auto& row : costs.rows) {
    const auto& solver = textAt(costs, row, "integrator");
    if (isPeer(solver)) found.insert("`" + solver + "`");
  }
  return fmt::format("{}", fmt::join(found, ", "));
}

Choice choiceOf(const Table& costs, const Table& runs, const std::string& kind, double error) {
  Choice choice{.kind = kind, .error = error};
  const SolverCosts found = costsOf(costs, "integrator", [&](const TableRow& row) {
    return isOfKind(costs, row, kind) && std::abs(numberAt(costs, row, "target_error") / error - 1) < 1e-9;
  });
  choice.problems = solvable(found);
  const auto ranked = ranking(found);
  if (ranked.empty()) return choice;
  choice.best = ranked.front();
  choice.outcomes = outcomesOf(runs, kind, choice.best.solver);
  for (auto other = ranked.begin() + 1; other != ranked.end(); ++other) {
    const bool is_fast = ratio(found, other->solver, choice.best.solver) <= kAsGood;
    if (is_fast && other->solved >= choice.best.solved - 1) choice.as_good.push_back(*other);
  }
  const auto library = std::find_if(ranked.begin(), ranked.end(), [](const Ranked& r) { return isPeer(r.solver); });
  if (!isPeer(choice.best.solver) && library != ranked.end()) {
    choice.library = *library;
    choice.over_library = ratio(found, library->solver, choice.best.solver);
  }
  return choice;
}

std::string solvedText(const Ranked& solver, int problems) {
  if (solver.solver.empty()) return "–";
  return fmt::format("{}&nbsp;{}/{}", escapeHtml(solver.solver), solver.solved, problems);
}

// `a` or `b` for mechanisms (23 times as fast as `x`, the best of the other libraries, which solves 13 of 17)
std::string clauseOf(const Choice& c) {
  if (c.best.solver.empty()) return fmt::format("no solver for {}", kindTitle(c.kind));
  std::string names = fmt::format("`{}`", c.best.solver);
  for (const auto& other : c.as_good) {
    names += fmt::format("{} `{}`", &other == &c.as_good.back() ? " or" : ",", other.solver);
  }
  std::string text = fmt::format("{} for {}", names, kindTitle(c.kind));
  if (c.library.solver.empty()) return text;
  return fmt::format("{} ({})", text, comparison(c.over_library, c.best, c.library, c.problems));
}

// The sentence for all choices at the same error.
std::string sentenceOf(const std::vector<Choice>& choices, const std::string& peers) {
  constexpr double kMiddle = 1e-8;
  double error = choices.front().error;
  for (const auto& choice : choices) {
    if (choice.error >= kMiddle && !choice.best.solver.empty()) error = std::min(error, choice.error);
  }
  std::vector<std::string> parts;
  for (const auto& choice : choices) {
    if (choice.error == error) parts.push_back(clauseOf(choice));
  }
  const std::string compared =
      peers.empty() ? "No solver of another library took part"
                    : "In brackets: against the best of the other libraries' solvers that took part, " + peers;
  return fmt::format("For an error of {}: {}. {}.", errorText(error), fmt::join(parts, "; "), compared);
}

void appendRow(const Choice& c, Answer& answer) {
  std::vector<std::string> names, shown_names;
  for (const auto& other : c.as_good) {
    names.push_back(other.solver);
    shown_names.push_back(solvedText(other, c.problems));
  }
  answer.table.rows.push_back({c.kind, numberText(c.error), std::to_string(c.problems), c.best.solver,
                               std::to_string(c.best.solved), fmt::format("{}", fmt::join(names, " ")),
                               c.library.solver, std::to_string(c.library.solved), numberText(c.over_library),
                               std::to_string(c.outcomes.runs), std::to_string(c.outcomes.failed),
                               std::to_string(c.outcomes.wrong)});
  HtmlTable::Row row{{escapeHtml(kindTitle(c.kind)), errorText(c.error)}};
  if (c.best.solver.empty()) {
    row.cells.insert(row.cells.end(), {"none reaches it", "–", "–", "–", "–", "–"});
  } else {
    const auto& [runs, failed, wrong] = c.outcomes;
    row.cells.insert(row.cells.end(), {"<b>" + solvedText(c.best, c.problems) + "</b>",
                                       names.empty() ? "–" : fmt::format("{}", fmt::join(shown_names, ", ")),
                                       solvedText(c.library, c.problems), factorText(c.over_library),
                                       fmt::format("{} of {}", failed, runs), fmt::format("{} of {}", wrong, runs)});
  }
  answer.shown.rows.push_back(std::move(row));
}

}  // namespace

SolverCosts costsOf(const Table& costs, std::string_view solver, const std::function<bool(const TableRow&)>& choose) {
  SolverCosts found;
  for (const auto& row : costs.rows) {
    if (choose(row)) addCost(costs, row, solver, found);
  }
  return found;
}

Answer solverAnswer(const claims::ResultTables& tables) {
  Answer answer = unknownAnswer("solver", kSolverQuestion, kCostStudy);
  try {
    const Table& costs = tables.table(kCostStudy, "cpu_at_error");
    const Table& runs = tables.runs(kCostStudy);
    std::vector<Choice> choices;
    for (const auto& kind : kindsOf(costs)) {
      for (const double error : errorsOf(costs)) choices.push_back(choiceOf(costs, runs, kind, error));
    }
    if (choices.empty()) return answer;
    answer.sentences = {sentenceOf(choices, peersOf(costs))};
    answer.table = {costs.head,
                    {"kind", "target_error", "problems", "solver", "solved", "as_good", "library", "library_solved",
                     "over_library", "runs", "failed", "wrong"},
                    {}};
    answer.shown = {.caption = "The fastest solver by kind of problem and error",
                    .titles = {"problem", "error", "fastest, solves", "as good, solves", "best other library, solves",
                               "its time over the fastest", "failed runs", "wrong runs"}};
    for (const auto& choice : choices) appendRow(choice, answer);
    answer.note =
        "4/4: reaches the error in 4 of 4 problems; the others fail or end with a larger error. Problems that no "
        "solver brings to this error are left out. Fastest: the solver that reaches the error in most problems, among "
        "equals "
        "the one with the least CPU time. As good: at most 1.15 times its time, and at most one problem less; smaller "
        "differences are noise of the clock. Times are compared by the geometric mean over the problems that both "
        "solve, and not at all where these are fewer than half. A solver counts where one of its tolerances is at most "
        "the error; with larger ones only it was not asked for it. Failed and wrong runs are those of the fastest "
        "solver at all tolerances; wrong: success with an error above 1000 tolerances. `variable` is Radau IIA of "
        "variable order, "
        "`irk solve SCENE --configuration variable`; `embedded:radau_iia_5` is `--configuration embedded --method "
        "radau_iia_5`, and so for others; what has no colon is an integrator of another library.";
    answer.links = {{"#profile", "performance profiles"}, {"#study_work_precision", "all diagrams"}};
  } catch (const claims::MissingResults& missing) {
    answer.sentences.push_back(missing.what());
  }
  return answer;
}

}  // namespace irk::report
