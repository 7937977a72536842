// Claims about the parts of a run: residuals, Jacobians, factorizations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

// The parts of a run must cover its time, else their shares are wrong.
constexpr double kMinCovered = 0.9, kMaxCovered = 1.1;

Table coveredPhases(const ResultTables& tables, Setting setting) {
  const Table phases = inSetting(tables.table("phases", "phases"), "phases", setting);
  return where(phases, [&](const TableRow& row) {
    const double covered = numberAt(phases, row, "covered");
    return covered >= kMinCovered && covered <= kMaxCovered;
  });
}

Measurement shareOfEvaluations(const ResultTables& tables, Setting setting) {
  constexpr double kFewest = 3, kMost = 200;
  const Table phases = coveredPhases(tables, setting);
  Measurement measured;
  std::map<std::string, double> crossing;  // the smallest n at which the factorization costs more
  for (const auto& row : phases.rows) {
    const double n = numberAt(phases, row, "n");
    if (n < kFewest || n > kMost) continue;
    const auto share = [&](std::string_view part) { return numberAt(phases, row, fmt::format("share_{}", part)); };
    const double evaluation = share("residual") + share("jacobian");
    const double part = evaluation / (evaluation + share("factorization") + share("solve"));
    const auto& scene = textAt(phases, row, "scene");
    measured.cases.push_back({scene, part});
    const auto at = crossing.try_emplace(scene, kInfinity).first;
    if (part <= 0.5) at->second = std::min(at->second, n);
  }
  for (const auto& [scene, n] : crossing) {
    measured.remark +=
        fmt::format("{}{} {}", measured.remark.empty() ? "Evaluation no longer dominates from n on: " : ", ", scene,
                    n == kInfinity ? "never" : fmt::format("{:g}", n));
  }
  return measured;
}

Measurement massFactorizations(const ResultTables& tables, Setting) {
  const Table runs = where(tables.runs("k_form"), {{"formulation", "index2"}, {"outcome", "success"}});
  Measurement measured;
  std::map<std::string, double> most;
  for (const auto& run : runs.rows) {
    const auto& scene = textAt(runs, run, "scene");
    const double count = numberAt(runs, run, "mass_factorizations");
    measured.cases.push_back({scene, count});
    if (count > 0) most[scene] = std::max(most[scene], count);
  }
  for (const auto& [scene, count] : most) {
    measured.remark += fmt::format(
        "{}{} {:g}", measured.remark.empty() ? "Restarts and checks of steps, at most: " : ", ", scene, count);
  }
  return measured;
}

// The first-order form detects by itself where M is constant.
Measurement firstOrderForm(const ResultTables& tables, Setting setting) {
  const Table runs = timedClaimRuns(tables, "mass_form", setting);
  const auto series = seriesOf(runs);
  const auto of = [&](const Race& race, std::string_view formulation) {
    return race.least([&](const TableRow& run) { return textAt(runs, run, "formulation") == formulation; });
  };
  Measurement measured;
  int per_step_is_best = 0;
  for (const auto& race : races(runs, series, "error", {"method"})) {
    const double per_point = of(race, "first_order"), per_step = of(race, "first_order_per_step");
    const double ratio = of(race, "index2") / std::min(per_point, per_step);
    if (!std::isfinite(ratio) || ratio == 0) continue;  // one of both does not reach the error
    measured.cases.push_back({race.scene, ratio});
    per_step_is_best += per_step < per_point ? 1 : 0;
  }
  measured.remark = fmt::format(
      "In {} of {} cases the first-order form costs less with one factorization of M per step than "
      "with one per evaluation.",
      per_step_is_best, measured.cases.size());
  return measured;
}

Measurement costOfFactorization(const ResultTables& tables, Setting setting) {
  const Table phases = coveredPhases(tables, setting);
  Measurement measured;
  for (const auto& row : phases.rows) {
    // share_step = attempted steps * step_s / (covered * run_s)
    const double sum = numberAt(phases, row, "covered") * numberAt(phases, row, "run_s");
    const double steps = numberAt(phases, row, "share_step") * sum / numberAt(phases, row, "step_s");
    measured.cases.push_back({textAt(phases, row, "scene"), numberAt(phases, row, "factorization_s") * steps / sum});
  }
  return measured;
}

}  // namespace

Evaluations partsEvaluations() {
  return {
      {"C4", shareOfEvaluations},
      {"C11a", massFactorizations},
      {"C11b", firstOrderForm},
      {"C15b", costOfFactorization},
  };
}

}  // namespace irk::claims
