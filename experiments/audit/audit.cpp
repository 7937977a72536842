#include "experiments/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/keyed_file.h"

namespace irk::audit {
namespace {

constexpr double kNotJudged = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> kColumns{"run",
                                        "key",
                                        "scene",
                                        "settings",
                                        "method",
                                        "family",
                                        "stages",
                                        "configuration",
                                        "formulation",
                                        "treatment",
                                        "discontinuity",
                                        "tolerance",
                                        "outcome",
                                        "detail",
                                        "judgement",
                                        "error",
                                        "error_over_tolerance",
                                        "error_z",
                                        "reference",
                                        "accuracy",
                                        "kappa",
                                        "accumulated",
                                        "remark",
                                        "cpu_s",
                                        "command"};

// Errors of u, v, x together, and of z.
struct StateErrors {
  double judged = kNotJudged, multipliers = kNotJudged;
};

StateErrors errorsOf(const RunSpec& spec, const std::string& family, const Vec<double>& state, const Answer& answer) {
  const Vec<double>& reference = answer.stateFor(family);
  if (reference.size() == 0 || reference.size() != state.size()) return {};
  const auto scene = makeScene<double>(spec.scene, spec.settings);
  const Sizes n = scene.sizes();
  const Index judged = 2 * n.nu + n.nx;
  return {scaledDifference(state, reference, scene.scale, 0, judged),
          scaledDifference(state, reference, scene.scale, judged, reference.size())};
}

TableRow auditRow(std::size_t number, const DrawnRun& drawn, const Table& runs, const TableRow& row,
                  const Vec<double>* state, const Answer* answer) {
  const RunSpec& spec = drawn.spec;
  const auto text = [&](std::string_view column) { return textAt(runs, row, column); };
  const Answer none;
  const Answer& known = answer ? *answer : none;
  const bool success = succeededAt(runs, row);
  StateErrors errors;
  if (success && state) errors = errorsOf(spec, text("family"), *state, known);
  const double tolerance = spec.options.tolerances.atol;
  const Judgement judgement = judge({success, tolerance, errors.judged, known.accuracy, known.kappa});
  return {std::to_string(number),
          row.front(),
          spec.scene,
          settingsText(spec.settings),
          spec.method,
          text("family"),
          text("stages"),
          spec.configuration,
          std::string(idOf(spec.formulation)),
          drawn.treatment,
          std::string(idOf(spec.discontinuity)),
          numberText(tolerance),
          text("outcome"),
          text("detail"),
          std::string(nameOf(judgement)),
          numberText(errors.judged),
          numberText(errors.judged / tolerance),
          numberText(errors.multipliers),
          known.source,
          numberText(known.accuracy),
          numberText(known.kappa),
          numberText(accumulated(numberAt(runs, row, "steps_accepted"), known.kappa, tolerance)),
          known.remark,
          text("cpu_s"),
          commandOf(drawn)};
}

}  // namespace

void writeAudit(const Draw& draw, const std::filesystem::path& runs, const std::filesystem::path& states,
                const Answers& answers, const std::filesystem::path& file) {
  KeyedFile made(runs), ends(states);
  const auto state_column = ends.names().column("state");
  TableWriter table(file, made.names().head, kColumns);
  for (std::size_t i = 0; i < draw.size(); ++i) {
    const DrawnRun drawn = draw[i];
    const auto key = specKey(drawn.spec);
    const auto row = made.find(key);
    if (!row) continue;  // not run because of an interrupt
    const auto end = ends.find(key);
    const auto state = end ? std::optional(parseVector((*end)[state_column])) : std::nullopt;
    const auto answer = answers.find(questionOf(drawn.spec));
    table.add(auditRow(i, drawn, made.names(), *row, state ? &*state : nullptr,
                       answer == answers.end() ? nullptr : &answer->second));
  }
  table.close();
}

std::string auditRuns(const Study& study, const std::filesystem::path& folder, int jobs, std::ostream& progress) {
  constexpr std::size_t kWorst = 5;
  const Draw draw(study.audit.value());
  std::set<Question> questions;
  for (std::size_t i = 0; i < draw.size(); ++i) questions.insert(questionOf(draw[i].spec));
  const Answers answers = answersTo(questions, folder / "references.csv", jobs, progress);
  const auto audit = folder / "audit.csv", summary_file = folder / "audit_summary.csv";
  if (interruptFlag()) {
    // Without their references runs would count as unjudged, and there would seem to be few wrong ones.
    for (const auto& table : {audit, summary_file}) std::filesystem::remove(table);
    return "interrupted: not all references are known, so no run is judged yet\n";
  }
  writeAudit(draw, folder / "runs.csv", folder / "states.csv", answers, audit);
  const Table summary = summaryTable(audit);
  writeTable(summary_file, summary);
  return summaryText(audit, summary, kWorst);
}

}  // namespace irk::audit
