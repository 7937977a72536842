#include "experiments/series_rules.h"

#include <fmt/format.h>

#include <cmath>

namespace irk {
namespace {

constexpr std::array<std::string_view, 4> kGroups = {"error_u", "error_v", "error_x", "error_z"};
constexpr int kIdleRuns = 3;

}  // namespace

RoundOffRule::RoundOffRule(ScalarKind scalar)
    : epsilon_(scalar == ScalarKind::kDouble ? std::numeric_limits<double>::epsilon() : 1e-50) {
  small_ = 100 * std::sqrt(epsilon_);
  least_.fill(std::numeric_limits<double>::infinity());
}

bool RoundOffRule::reached(const Table& table, const TableRow& row) {
  if (!succeededAt(table, row)) return false;
  bool all = true;
  for (std::size_t i = 0; i < kGroups.size(); ++i) {
    const double error = numberAt(table, row, kGroups[i]);
    if (std::isnan(error)) continue;
    const bool idle = error <= epsilon_ || (error >= least_[i] && error < small_);
    idle_[i] = idle ? idle_[i] + 1 : 0;
    least_[i] = std::min(least_[i], error);
    all = all && idle_[i] >= kIdleRuns;
  }
  return all;
}

bool ranTooLong(std::string_view outcome) {
  return outcome == name(Outcome::kMaxSteps) || outcome == name(Outcome::kTimeout);
}

RunRecord withoutMachine(RunRecord record) {
  if (record.outcome != name(Outcome::kTimeout)) return record;
  record.counters = {};
  record.detail = fmt::format("longer than {} s", record.spec.time_limit);
  return record;
}

RunRecord notMade(const RunSpec& spec, const TableRow& easier, const Table& table) {
  RunRecord record;
  record.spec = spec;
  record.family = textAt(table, easier, "family");
  record.stages = static_cast<Index>(numberAt(table, easier, "stages"));
  record.outcome = textAt(table, easier, "outcome");
  record.detail =
      fmt::format("not run: rtol = {} took too long already", textAt(table, easier, "rtol"));
  return record;
}

}  // namespace irk
