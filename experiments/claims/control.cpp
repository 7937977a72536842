// Claims about error estimates, step control and discontinuities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "experiments/analyses/cost_at_error.h"
#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"
#include "experiments/runs/fields.h"
#include "experiments/solution/trajectory.h"

namespace irk::claims {
namespace {

double leastCost(const Table& costs, const Cells& cells, double least_stages, double most_stages) {
  const Table rows = where(costs, cells);
  return claims::leastCost(rows, [&](const TableRow& row) {
    const double s = numberAt(rows, row, "stages");
    return s >= least_stages && s <= most_stages && textAt(rows, row, "reached") == "1";
  });
}

// How much five and more stages save against two, at the smallest error that two stages reach.
std::optional<double> gainOfOrder(const Table& all, std::string_view block) {
  const Table costs = inBlocks(all, "cpu_time", {block});
  std::optional<double> gain;
  double least_error = kInfinity;
  for (const auto& error : distinct(costs, "target_error")) {
    const Cells cells{{"family", "radau_iia"}, {"target_error", error}};
    const double few = leastCost(costs, cells, 2, 2), many = leastCost(costs, cells, 5, 100);
    if (std::isinf(few) || std::isinf(many) || std::stod(error) >= least_error) continue;
    least_error = std::stod(error);
    gain = few / many;
  }
  return gain;
}

// Residuals per accepted length of time of doubled steps 2 h over those of plain steps h.
std::vector<double> doublingCosts(const Table& runs) {
  const auto keyOf = [&](const TableRow& row) {
    return TableRow{textAt(runs, row, "scene"), textAt(runs, row, "method")};
  };
  std::map<TableRow, double> plain;
  for (const auto& row : inBlocks(runs, "control", {"plain_steps"}).rows) {
    if (succeededAt(runs, row)) plain[keyOf(row)] = numberAt(runs, row, "residuals");
  }
  std::vector<double> ratios;
  for (const auto& row : inBlocks(runs, "control", {"doubled_steps"}).rows) {
    const auto same = plain.find(keyOf(row));
    if (!succeededAt(runs, row) || same == plain.end()) continue;
    ratios.push_back(numberAt(runs, row, "residuals") / same->second);
  }
  return ratios;
}

// Blocks of the study peers.
const Blocks kSmooth = {"stiff", "pendulum", "pendulum_index1", "crank", "crank_index1"};
const Blocks kWithJumps = {"contact", "yielding", "stick_slip", "crank_torque_off", "crank_torque_off_index1"};
const Blocks kLocated = {"contact_located", "yielding_located", "stick_slip_located"};

// The least cost of the BDF codes over that of Radau IIA, per scene and error that both reach.
std::vector<double> multistepOverRadau(const Table& costs, const Blocks& blocks) {
  struct Least {
    double bdf = kInfinity, radau = kInfinity;
  };
  std::map<TableRow, Least> cases;  // by scene, settings and error
  const Table rows = where(inBlocks(costs, "peers", blocks), {{"reached", "1"}});
  for (const auto& row : rows.rows) {
    Least& least =
        cases[{textAt(rows, row, "scene"), textAt(rows, row, "settings"), textAt(rows, row, "target_error")}];
    const auto& method = textAt(rows, row, "method");
    const double seconds = numberAt(rows, row, "cpu_s");
    if (method.find("bdf") != method.npos) {
      least.bdf = std::min(least.bdf, seconds);
    } else if (method.starts_with("radau")) {
      least.radau = std::min(least.radau, seconds);
    }
  }
  std::vector<double> ratios;
  for (const auto& [where, least] : cases) {
    if (!std::isinf(least.bdf) && !std::isinf(least.radau)) ratios.push_back(least.bdf / least.radau);
  }
  return ratios;
}

// What a method does where the torque of the crank is switched off.
struct Jump {
  std::string method;
  double step_factor;   // median step over the smallest one around the jump
  double error_factor;  // error over that of the run without a jump
};

double errorOf(const Table& runs, const std::string& method) {
  return median(numbersOf(where(runs, {{"method", method}}), "error"));
}

// The solution of a run over time.
const Table& stepsOf(const ResultTables& tables, const Table& runs, const TableRow& run) {
  RunSpec spec;
  for (const char* field : {"scene", "settings", "method"}) findField(field).set(spec, textAt(runs, run, field));
  return tables.table("steps", trajectoryPath({}, spec).stem().string());
}

std::vector<Jump> jumpsOf(const ResultTables& tables) {
  const Table& all = tables.runs("steps");
  const Table smooth = inBlocks(all, "steps", {"crank"}), switched = inBlocks(all, "steps", {"crank_torque_off"});
  std::vector<Jump> jumps;
  for (const auto& method : distinct(switched, "method")) {
    const Table& steps = stepsOf(tables, switched, where(switched, {{"method", method}}).rows.front());
    const Table near = where(steps, [&](const TableRow& row) {
      const double t = numberAt(steps, row, "t");
      return t > 0.45 && t < 0.55;
    });
    const auto at_jump = numbersOf(near, "h");
    if (at_jump.empty()) continue;
    jumps.push_back({method, median(numbersOf(steps, "h")) / *std::min_element(at_jump.begin(), at_jump.end()),
                     errorOf(switched, method) / errorOf(smooth, method)});
  }
  return jumps;
}

}  // namespace

Finding stepDoubling(const ResultTables& tables) {
  constexpr double kSafety = 4, kReliable = 0.95, kFair = 0.85, kCheap = 1.35, kDear = 1.65, kBlind = 10;
  const Table& estimates = tables.table("estimate", "estimates");
  std::string groups;
  double worst_differential = 1, multipliers = 1;
  for (const auto* group : {"u", "v", "x", "z"}) {
    const auto ratios = numbersOf(where(estimates, {{"group", group}}), "doubling");
    if (ratios.empty()) continue;
    const double reliable = part(ratios, [](double x) { return x <= kSafety; });
    groups += fmt::format("{}{} {}", groups.empty() ? "" : ", ", group, percent(reliable));
    auto& least = group[0] == 'z' ? multipliers : worst_differential;
    least = std::min(least, reliable);
  }
  if (groups.empty()) return notMeasurable("no step with an estimate above round-off");
  const auto costs = doublingCosts(tables.runs("control"));
  const double cost = median(costs);
  const bool cost_right = cost >= kCheap && cost <= kDear;
  double blind = std::numeric_limits<double>::quiet_NaN();
  std::string blindest;
  for (const auto& jump : jumpsOf(tables)) {
    if (std::isnan(jump.error_factor) || jump.error_factor <= blind) continue;
    blind = jump.error_factor;
    blindest = jump.method;
  }
  if (std::isnan(blind)) return notMeasurable("no run came past the jump");
  Finding finding{
      Verdict::kContradicted, fmt::format("costs {:.3g} times as much; reliable: {}", cost, groups),
      fmt::format("A step is judged reliably if its true error is at most s_min = {:g} times the "
                  "estimate; wanted in {} of the steps, per group of components (within limits: {}, "
                  "multipliers aside), and across a jump (at most {:g} times the error of the smooth "
                  "run at the same tolerance): {} has {:.2g} times. Cost in residuals against the "
                  "same steps without estimate, median of {} cases (50 % more: {} to {}).",
                  kSafety, percent(kReliable), percent(kFair), kBlind, blindest, blind, costs.size(), kCheap, kDear)};
  if (worst_differential >= kFair && cost_right) finding.verdict = Verdict::kWithinLimits;
  if (std::min(worst_differential, multipliers) >= kReliable && blind <= kBlind && cost_right) {
    finding.verdict = Verdict::kConfirmed;
  }
  return finding;
}

Finding multistepRestart(const ResultTables& tables) {
  constexpr double kMuch = 1.5, kSome = 1.1;
  const Table& costs = tables.table("peers", "cpu_at_error");
  const auto smooth = multistepOverRadau(costs, kSmooth);
  const auto jumps = multistepOverRadau(costs, kWithJumps);
  const auto located = multistepOverRadau(costs, kLocated);
  if (smooth.empty() || jumps.empty()) {
    return notMeasurable("no error is reached by BDF and by Radau IIA on both kinds of scenes");
  }
  const double ratio = median(jumps) / median(smooth);
  return {graded(-ratio, -kMuch, -kSome),
          fmt::format("BDF over Radau IIA: {:.2g} times where smooth, {:.2g} times with jumps", median(smooth),
                      median(jumps)),
          fmt::format("CPU time at equal errors, best code of each kind, medians of {} and {} pairs "
                      "of scene and error; Radau IIA's error estimate is told of the switches. {}"
                      "Confirmed: the factor grows at least {} times at jumps; within limits: {} "
                      "times.",
                      smooth.size(), jumps.size(),
                      located.empty() ? "" : fmt::format("{:.2g} times where both locate them. ", median(located)),
                      kMuch, kSome)};
}

Finding smallStepsAtJumps(const ResultTables& tables) {
  constexpr double kPays = 1.5, kSmall = 3, kLoss = 10;
  const Table& costs = tables.table("cpu_time", "cpu_at_error");
  std::vector<double> smooth, discontinuous;
  const auto append = [&](std::vector<double>& gains, std::string_view block) {
    if (const auto gain = gainOfOrder(costs, block)) gains.push_back(*gain);
  };
  for (const auto* block : {"crank", "arm_smooth"}) append(smooth, block);
  for (const auto* block : {"crank_torque_off", "arm_kinked"}) append(discontinuous, block);
  if (smooth.empty() || discontinuous.empty()) {
    return notMeasurable("two stages and five or more do not reach a common error");
  }
  const auto jumps = jumpsOf(tables);
  if (jumps.empty()) return notMeasurable("no run of the crank came past the jump");
  std::string details;
  bool necessary = true;  // who does not make its steps small pays with its accuracy
  for (const auto& jump : jumps) {
    necessary = necessary && (jump.step_factor >= kSmall || jump.error_factor >= kLoss);
    details += fmt::format("{}{}: {:.2g} times smaller steps, {:.2g} times the error", details.empty() ? "" : "; ",
                           jump.method, jump.step_factor, jump.error_factor);
  }
  const double gain = median(smooth), less = median(discontinuous);
  Finding finding{Verdict::kContradicted,
                  fmt::format("{:.2g} times faster where smooth, {:.2g} times with jumps", gain, less),
                  fmt::format("Radau IIA with at least 5 stages against 2, CPU time at the smallest common "
                              "error, medians; it pays from {} on. At the jump of the slider-crank, against the "
                              "median step and the smooth run: {}. Small: {:g} times; else the error must grow "
                              "{:g} times.",
                              kPays, details, kSmall, kLoss)};
  if (gain >= kPays && necessary) {
    finding.verdict = gain > less ? Verdict::kConfirmed : Verdict::kWithinLimits;
  }
  return finding;
}

Finding relativeTolerances(const ResultTables& tables) {
  constexpr double kLittle = 1.2, kSome = 1.5;
  const Table& runs = tables.runs("control");
  const auto ratios = compareCosts(runs, "norm", "mixed", "absolute", "cpu_s").all;
  const double ratio = median(ratios);
  if (std::isnan(ratio)) return notMeasurable("no error is reached with both norms");
  return {graded(ratio, kLittle, kSome), fmt::format("absolute costs {:.3g} times as much", ratio),
          fmt::format("CPU time with an absolute over that with a mixed tolerance at equal errors, "
                      "oscillating scenes, median of {} pairs. Relative tolerances help little if "
                      "that is at most {}.",
                      ratios.size(), kLittle)};
}

}  // namespace irk::claims
