#include "experiments/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "experiments/audit/bar_tables.h"
#include "experiments/audit/coverage.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/run_command.h"
#include "experiments/tables/grouped_file.h"
#include "experiments/tables/named_cells.h"
#include "irk/collections.h"

namespace irk::audit {
namespace {

constexpr double kNotJudged = std::numeric_limits<double>::quiet_NaN();

// The final state of a run and its error bars; empty vectors: not kept.
struct Result {
  Vec<double> state, bars;
};

// Errors and error bars of u, v, x together, and of z; the error in tolerances, and the part of its cover that an error
// reaches (coverage.h).
struct StateErrors {
  double judged = kNotJudged, multipliers = kNotJudged, in_tolerances = kNotJudged, part_of_cover = kNotJudged;
  double bar = kNotJudged, bar_of_multipliers = kNotJudged;
};

// The largest bar / max(|y|, scale) of the components first <= i < last; NaN if none is known.
double largestBar(const Result& result, const Vec<double>& scale, Index first, Index last) {
  double largest = kNotJudged;
  if (result.bars.size() != result.state.size()) return largest;
  for (Index i = first; i < last; ++i) {
    const double magnitude = std::max(std::abs(result.state[i]), i < scale.size() ? scale[i] : 1.0);
    largest = std::fmax(largest, result.bars[i] / magnitude);
  }
  return largest;
}

// Whether its tolerances are in the units of the components, whatever their magnitudes.
bool isAbsolute(const RunSpec& spec) { return spec.options.tolerances.norm == NormKind::kAbsolute; }

StateErrors errorsOf(const RunSpec& spec, const std::string& family, const Result& result, const Answer& answer) {
  StateErrors errors;
  const Index size = result.state.size();
  const auto scene = makeScene<double>(spec.scene, spec.settings);
  const Sizes n = scene.sizes();
  const Index judged = 2 * n.nu + n.nx;
  const Vec<double> scale = isAbsolute(spec) ? Vec<double>::Ones(n.components()) : scene.scale;
  errors.bar = largestBar(result, scale, 0, judged);
  errors.bar_of_multipliers = largestBar(result, scale, judged, size);
  const Vec<double>& reference = answer.stateFor(family);
  if (size == 0 || reference.size() != size) return errors;
  errors.judged = scaledDifference(result.state, reference, scale, 0, judged);
  errors.multipliers = scaledDifference(result.state, reference, scale, judged, size);
  const MeasuredResult measured{result.state, result.bars, reference, scale, spec.options.tolerances, answer.accuracy};
  errors.in_tolerances = errorInTolerances(measured, judged);
  errors.part_of_cover = partOfCover(measured, judged);
  return errors;
}

// A run to the end has a state there, be it a success or not.
bool isAtTheEnd(const std::string& outcome) {
  return outcome == name(Outcome::kSuccess) || outcome == name(Outcome::kInaccurate) ||
         outcome == name(Outcome::kDrift);
}

// The largest error of u, v, x at the run's reference times; NaN for a run with one such time, its end.
double errorOnTheWay(const RunSpec& spec, const Table& runs, const TableRow& row) {
  double largest = kNotJudged;
  if (spec.reference_times == 1) return largest;
  for (const auto* column : {"error_u_over_time", "error_v_over_time", "error_x_over_time"}) {
    largest = std::fmax(largest, numberAt(runs, row, column));
  }
  return largest;
}

NamedCells auditCells(std::size_t number, const DrawnRun& drawn, const Table& runs, const TableRow& row,
                      const Result& result, const Answer& known) {
  const RunSpec& spec = drawn.spec;
  const auto text = [&](std::string_view column) { return textAt(runs, row, column); };
  StateErrors errors;
  if (isAtTheEnd(text("outcome"))) errors = errorsOf(spec, text("family"), result, known);
  const Tolerances& tolerances = spec.options.tolerances;
  const double tolerance = isAbsolute(spec) ? tolerances.atol : std::max(tolerances.rtol, tolerances.atol);
  const Judgement judgement = judge({succeededAt(runs, row), tolerance, errors.judged, known.accuracy, known.kappa});
  const auto collections = collectionsOf(spec.scene);
  return {{"run", std::to_string(number)},
          {"key", row.front()},
          {"scene", spec.scene},
          {"collection", collections.empty() ? "" : collections.front()},
          {"settings", settingsText(spec.settings)},
          {"t_end", numberText(spec.t_end)},
          {"method", spec.method},
          {"family", text("family")},
          {"stages", text("stages")},
          {"integrator", findPeer(spec.method) ? spec.method : spec.configuration},
          {"configuration", spec.configuration},
          {"formulation", std::string(idOf(spec.formulation))},
          {"treatment", drawn.treatment},
          {"discontinuity", std::string(idOf(spec.discontinuity))},
          {"tolerance", numberText(tolerance)},
          {"rtol", numberText(tolerances.rtol)},
          {"atol", numberText(tolerances.atol)},
          {"outcome", text("outcome")},
          {"detail", text("detail")},
          {"judgement", std::string(nameOf(judgement))},
          {"error", numberText(errors.judged)},
          {"error_over_tolerance", numberText(errors.judged / tolerance)},
          {"error_in_tolerances", numberText(errors.in_tolerances)},
          {"error_z", numberText(errors.multipliers)},
          {"error_way", numberText(errorOnTheWay(spec, runs, row))},
          {"error_bar", numberText(errors.bar)},
          {"error_bar_z", numberText(errors.bar_of_multipliers)},
          {"error_bar_tolerances", text("error_bar_tolerances")},
          {"part_of_cover", numberText(errors.part_of_cover)},
          {"reference", known.source},
          {"accuracy", numberText(known.accuracy)},
          {"kappa", numberText(known.kappa)},
          {"accumulated", numberText(accumulated(numberAt(runs, row, "steps_accepted"), known.kappa, tolerance))},
          {"remark", known.remark},
          {"cpu_s", text("cpu_s")},
          {"cpu_error_bar_s", text("cpu_error_bar_s")},
          {"command", seriesCommand(runs, row).text + sweptOptions(runs, row)}};
}

std::optional<TableRow> rowWith(const std::string& key, const GroupedFile& table) {
  const auto group = table.find({key});
  return group ? std::optional(table.group(*group).back()) : std::nullopt;
}

Result resultIn(const Table& states, const std::optional<TableRow>& row) {
  if (!row) return {};
  const auto vectorAt = [&](const char* column) {
    return states.hasColumn(column) ? parseVector(textAt(states, *row, column)) : Vec<double>();
  };
  return {vectorAt("state"), vectorAt("bar")};
}

}  // namespace

void writeAudit(const Draw& draw, const std::filesystem::path& runs, const std::filesystem::path& states,
                const Answers& answers, const std::filesystem::path& file) {
  const GroupedFile made(runs, {"key"}), ends(states, {"key"});
  Table table{made.names().head, {}, {}};
  for (std::size_t i = 0; i < draw.size(); ++i) {
    const DrawnRun drawn = draw[i];
    const auto key = specKey(drawn.spec);
    const auto row = rowWith(key, made);
    if (!row) continue;  // not run because of an interrupt
    const auto answer = answers.find(questionOf(drawn.spec));
    addRow(table, auditCells(i, drawn, made.names(), *row, resultIn(ends.names(), rowWith(key, ends)),
                             answer == answers.end() ? Answer{} : answer->second));
  }
  writeTable(file, table);
}

std::string auditRuns(const Study& study, const std::filesystem::path& folder, int jobs, std::ostream& progress) {
  constexpr std::size_t kWorst = 5;
  const Draw draw(study.audit.value());
  std::set<Question> questions;
  for (std::size_t i = 0; i < draw.size(); ++i) questions.insert(questionOf(draw[i].spec));
  const Answers answers = answersTo(questions, folder / "references.csv", jobs, progress);
  const auto audit = folder / "audit.csv", summary_file = folder / "audit_summary.csv",
             bar_file = folder / "audit_error_bar.csv", word_file = folder / "audit_own_word.csv";
  if (interruptFlag()) {
    // Without their references runs would count as unjudged, and there would seem to be few wrong ones.
    for (const auto& table : {audit, summary_file, bar_file, word_file}) std::filesystem::remove(table);
    return "interrupted: not all references are known, so no run is judged yet\n";
  }
  writeAudit(draw, folder / "runs.csv", folder / "states.csv", answers, audit);
  const Table summary = summaryTable(audit), bars = errorBarTable(audit), words = ownWordTable(audit);
  writeTable(summary_file, summary);
  writeTable(bar_file, bars);
  writeTable(word_file, words);
  return summaryText(audit, summary, kWorst) + errorBarText(bars) + ownWordText(words);
}

}  // namespace irk::audit
