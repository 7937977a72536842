#include "experiments/audit/answers.h"

#include <fmt/format.h>

#include <mutex>
#include <optional>
#include <vector>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"

namespace irk::audit {
namespace {

std::string versionText() { return fmt::format("{} {}", buildInfo().version, buildInfo().commit); }

// The stored rows that this version of the program has written.
Table foundAnswers(const std::filesystem::path& file, int jobs) {
  Table table{environmentHead("references of the audit", jobs), columnsOf(answerCells({}, {})), {}};
  if (!std::filesystem::exists(file)) return table;
  const Table found = readTable(file);
  if (found.columns != table.columns) return table;
  for (const auto& row : found.rows) {
    if (textAt(found, row, "version") == versionText()) table.rows.push_back(row);
  }
  return table;
}

}  // namespace

NamedCells answerCells(const Question& question, const Answer& answer) {
  return {{"scene", question.scene},
          {"settings", question.settings},
          {"t_end", numberText(question.t_end)},
          {"smooth", question.smooth ? "1" : "0"},
          {"version", versionText()},
          {"source", answer.source},
          {"accuracy", numberText(answer.accuracy)},
          {"kappa", numberText(answer.kappa)},
          {"cpu_s", numberText(answer.cpu_s)},
          {"remark", answer.remark},
          {"state", vectorText(answer.state)},
          {"other", vectorText(answer.other)}};
}

std::pair<Question, Answer> parseAnswer(const Table& table, const TableRow& row) {
  const auto text = [&](std::string_view column) { return textAt(table, row, column); };
  const auto number = [&](std::string_view column) { return numberAt(table, row, column); };
  return {{text("scene"), text("settings"), number("t_end"), text("smooth") == "1"},
          {.state = parseVector(text("state")),
           .other = parseVector(text("other")),
           .source = text("source"),
           .accuracy = number("accuracy"),
           .kappa = number("kappa"),
           .remark = text("remark"),
           .cpu_s = number("cpu_s")}};
}

Answers answersTo(const std::set<Question>& questions, const std::filesystem::path& file, int jobs, std::ostream& out) {
  const Table table = foundAnswers(file, jobs);
  Answers answers;
  for (const auto& row : table.rows) answers.insert(parseAnswer(table, row));
  std::vector<Question> open;
  for (const auto& question : questions) {
    if (!answers.contains(question)) open.push_back(question);
  }
  RowWriter writer(file, table);
  std::optional<Progress> progress(std::in_place, out, "audit: references");
  for (const auto& question : open) progress->expect(question.scene);
  std::mutex mutex;
  ParallelLoop loop;
#pragma omp parallel for schedule(dynamic, 1) num_threads(jobs)
  for (std::size_t i = 0; i < open.size(); ++i) {
    loop.turn(i, [&] {
      if (interruptFlag()) return;
      const double start = wallSeconds();
      const Answer answer = answerOf(open[i], &interruptFlag());
      if (answer.source == kInterruptedSource) return;
      const std::lock_guard lock(mutex);
      writer.append(rowOf(answerCells(open[i], answer)));
      answers[open[i]] = answer;
      progress->finished(open[i].scene, wallSeconds() - start);
    });
  }
  progress.reset();
  loop.rethrow();
  return answers;
}

}  // namespace irk::audit
