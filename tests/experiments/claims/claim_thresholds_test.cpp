// Claims C1, C2, C3 and C9 on synthetic tables, on both sides of every threshold.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

using namespace claims;

std::string said(const char* id, const ResultTables& tables) { return std::string(verdictText(verdict(id, tables))); }

constexpr const char *kYes = "confirmed", *kLimited = "confirmed within limits", *kNo = "contradicted",
                     *kUnknown = "not measurable";

Table columns(std::vector<std::string> names) {
  Table table;
  table.columns = std::move(names);
  return table;
}

Table costTable() { return columns({"block", "family", "stages", "target_error", "reached", "cpu_s"}); }

constexpr const char* kSmoothBlocks[] = {"crank", "arm_smooth", "elastic_pendulum"};

void addCost(Table& table, const char* block, const char* family, int stages, const char* error, double cost,
             bool reached = true) {
  table.rows.push_back(
      {block, family, std::to_string(stages), error, reached ? "1" : "0", reached ? text(cost) : "nan"});
}

// --- C1: orders up to 20 are reached, and the most efficient.

struct Costs {
  double high, middle, low;  // of orders 20 (or 18), 9 and 7
};

ResultTables highOrderTables(double order, const std::vector<Costs>& costs, const char* judged = "agrees",
                             int high_stages = 10) {
  Table orders = columns({"family", "stages", "verdict", "order"});
  orders.rows = {{"gauss", "2", "agrees", "4"},
                 {"gauss", "10", judged, text(order)},
                 {"radau_iia", "15", "agrees", "29"},  // not of Gauss
                 {"gauss", "20", "differs", "40"},
                 {"gauss", "18", "not_measurable", "36"}};
  Table table = costTable();
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const char* place = kSmoothBlocks[i];
    // Only costs at the smallest common error count; these, at a larger error, must not.
    addCost(table, place, "radau_iia", 2, "1e-2", 1e-3);
    addCost(table, place, "gauss", high_stages, "1e-2", 1e3);
    addCost(table, place, "gauss", high_stages, "1e-10", costs[i].high);
    addCost(table, place, "radau_iia", 5, "1e-10", costs[i].middle);
    addCost(table, place, "radau_iia", 4, "1e-10", costs[i].low);
    addCost(table, place, "radau_iia", 2, "1e-12", 1e-3, false);
  }
  ResultTables results;
  results.put("order", "orders", orders);
  results.put("cpu_time", "cpu_at_error", table);
  return results;
}

TEST(ClaimThresholds, HighOrders) {
  const Costs best{1, 2, 2}, near{1.09, 1, 1}, far{1.11, 2, 1}, nine{1.2, 1, 1.1};
  const auto all = [](const Costs& c) { return std::vector<Costs>{c, c, c}; };
  EXPECT_EQ(said("C1", highOrderTables(20, all(best))), kYes);
  EXPECT_EQ(said("C1", highOrderTables(19.81, all(near))), kYes);
  EXPECT_EQ(said("C1", highOrderTables(19.79, all(near))), kNo);
  EXPECT_EQ(said("C1", highOrderTables(20, all(near), "differs")), kNo);
  EXPECT_EQ(said("C1", highOrderTables(20, all(near), "not_measurable")), kNo);
  EXPECT_EQ(said("C1", highOrderTables(20, all(nine))), kLimited) << "order 9 is cheapest";
  EXPECT_EQ(said("C1", highOrderTables(19.79, all(nine))), kNo);
  EXPECT_EQ(said("C1", highOrderTables(20, all(far))), kNo) << "order 7 is cheapest";
  EXPECT_EQ(said("C1", highOrderTables(20, {best, best, far})), kYes) << "two of three";
  EXPECT_EQ(said("C1", highOrderTables(20, {best, far, far})), kNo) << "one of three";
  EXPECT_EQ(said("C1", highOrderTables(20, {best, far})), kYes) << "half";
  EXPECT_EQ(said("C1", highOrderTables(20, {best, nine, nine})), kLimited);
  EXPECT_EQ(said("C1", highOrderTables(20, all(best), "agrees", 9)), kYes) << "order 18";
  EXPECT_EQ(said("C1", highOrderTables(20, all({1, 1.2, 1.2}), "agrees", 8)), kLimited) << "order 16 is no high one";
  EXPECT_EQ(said("C1", highOrderTables(20, {})), kUnknown);
}

// --- C2: schemes of up to about 10 stages are faster; beyond that round-off dominates.

ResultTables manyStageTables(const std::vector<int>& fastest, int few_failed, int many_failed) {
  Table table = costTable();
  for (std::size_t i = 0; i < fastest.size(); ++i) {
    for (int s = 2; s <= 20; ++s) {
      addCost(table, kSmoothBlocks[i], "radau_iia", s, "1e-10", 1 + std::abs(s - fastest[i]));
      addCost(table, kSmoothBlocks[i], "radau_iia", s, "1e-4", s);
    }
    addCost(table, kSmoothBlocks[i], "gauss", 2, "1e-10", 0.1);
  }
  Table runs = columns({"block", "rtol", "stages", "outcome"});
  const auto add = [&](const char* block, const char* rtol, int stages, bool failed) {
    runs.rows.push_back({block, rtol, std::to_string(stages), failed ? "newton_failed" : "success"});
  };
  for (int i = 0; i < 4; ++i) {
    add("tight_tolerances", "1e-11", 10, i < few_failed);
    add("tight_tolerances", "1e-12", 11, i < many_failed);
    add("tight_tolerances", "1e-10", 20, true);  // not tight
    add("jumps_of_friction", "1e-12", 5, true);  // another block
  }
  ResultTables results;
  results.put("cpu_time", "cpu_at_error", table);
  results.put("failure_newton", "runs", runs);
  return results;
}

TEST(ClaimThresholds, ManyStages) {
  EXPECT_EQ(said("C2", manyStageTables({10, 10, 10}, 0, 1)), kYes);
  EXPECT_EQ(said("C2", manyStageTables({7, 7, 2}, 0, 1)), kYes) << "the median";
  EXPECT_EQ(said("C2", manyStageTables({13, 20, 13}, 1, 2)), kYes);
  EXPECT_EQ(said("C2", manyStageTables({6, 6, 6}, 0, 1)), kLimited);
  EXPECT_EQ(said("C2", manyStageTables({4, 4, 4}, 0, 1)), kLimited);
  EXPECT_EQ(said("C2", manyStageTables({3, 3, 3}, 0, 1)), kNo);
  EXPECT_EQ(said("C2", manyStageTables({14, 14, 14}, 0, 1)), kNo);
  EXPECT_EQ(said("C2", manyStageTables({10, 10, 10}, 2, 2)), kLimited) << "no more failures";
  EXPECT_EQ(said("C2", manyStageTables({10, 10, 10}, 3, 2)), kLimited);
  EXPECT_EQ(said("C2", manyStageTables({}, 0, 1)), kUnknown);
}

// --- C3 and C9: step doubling, and the step at the jump of the slider-crank.

struct JumpRun {
  double step_factor, error_factor;
};

void putSteps(ResultTables& results, const std::vector<JumpRun>& jumps) {
  Table runs = columns({"block", "scene", "method", "settings", "error"});
  int number = 2;
  for (const auto& jump : jumps) {
    const std::string method = "radau_iia_" + std::to_string(number++);
    runs.rows.push_back({"crank", "slider_crank", method, "", "1e-8"});
    runs.rows.push_back({"crank_torque_off", "slider_crank", method, "torque_off_at=0.5",
                         text(1e-8 * jump.error_factor * 1e6) + "e-6"});
    Table steps = columns({"t", "h"});
    for (const double t : {0.1, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8}) steps.rows.push_back({text(t), "0.1"});
    // A small step at the jump, and a smaller one far from it that does not count.
    steps.rows.push_back({"0.5", fmt::format("{}", 0.1 / jump.step_factor)});
    steps.rows.push_back({"0.44", "1e-9"});
    steps.rows.push_back({"0.56", "1e-9"});
    results.put("steps", "slider_crank_torque_off_at_0.5." + method, steps);
  }
  results.put("steps", "runs", runs);
}

ResultTables doublingTables(double reliable_v, double reliable_z, double cost, double blind, double ratio = 4.0,
                            double beyond = 4.01) {
  ResultTables results;
  Table estimates = columns({"group", "doubling", "richardson"});
  const auto add = [&](const char* group, double part) {
    for (int i = 0; i < 100; ++i) {
      estimates.rows.push_back({group, text(i < 100 * part ? ratio : beyond), "1e9"});
    }
  };
  add("u", 1);
  add("v", reliable_v);
  add("z", reliable_z);
  results.put("estimate", "estimates", estimates);
  Table control = columns({"block", "scene", "method", "outcome", "residuals"});
  for (const double spread : {0.5, 1.0, 3.0}) {  // the median counts
    const auto scene = text(spread);
    control.rows.push_back({"plain_steps", scene, "radau_iia_3", "success", "1000"});
    control.rows.push_back({"doubled_steps", scene, "radau_iia_3", "success", text(1000 * cost * spread)});
    control.rows.push_back({"controllers_pendulums", scene, "radau_iia_3", "success", "77"});
    control.rows.push_back({"doubled_steps", scene, "radau_iia_4", "newton_failed", "1"});
  }
  results.put("control", "runs", control);
  putSteps(results, {{5, 1}, {5, blind}});
  return results;
}

TEST(ClaimThresholds, StepDoubling) {
  EXPECT_EQ(said("C3", doublingTables(1, 1, 1.5, 1)), kYes);
  EXPECT_EQ(said("C3", doublingTables(0.95, 0.95, 1.36, 9.9)), kYes);
  EXPECT_EQ(said("C3", doublingTables(1, 1, 1.64, 1)), kYes);
  EXPECT_EQ(said("C3", doublingTables(1, 1, 1.34, 1)), kNo);
  EXPECT_EQ(said("C3", doublingTables(1, 1, 1.66, 1)), kNo);
  EXPECT_EQ(said("C3", doublingTables(1, 1, 1.5, 10.1)), kLimited) << "blind at the jump";
  EXPECT_EQ(said("C3", doublingTables(0.94, 1, 1.5, 1)), kLimited);
  EXPECT_EQ(said("C3", doublingTables(0.85, 1, 1.5, 1)), kLimited);
  EXPECT_EQ(said("C3", doublingTables(0.84, 1, 1.5, 1)), kNo);
  EXPECT_EQ(said("C3", doublingTables(1, 0.94, 1.5, 1)), kLimited);
  EXPECT_EQ(said("C3", doublingTables(1, 0.1, 1.5, 1)), kLimited) << "multipliers aside";
  EXPECT_EQ(said("C3", doublingTables(0.5, 1, 1.5, 1, 3.9, 3.99)), kYes) << "both below s_min";
  ResultTables nothing = doublingTables(1, 1, 1.5, 1);
  nothing.put("estimate", "estimates", columns({"group", "doubling"}));
  EXPECT_EQ(said("C3", nothing), kUnknown);
  ResultTables no_jump = doublingTables(1, 1, 1.5, 1);
  no_jump.put("steps", "runs", columns({"block", "scene", "method", "settings", "error"}));
  EXPECT_EQ(said("C3", no_jump), kUnknown);
}

// `gain`: the cost with two stages divided by the cost with five and more.
ResultTables jumpTables(double smooth, double discontinuous, const std::vector<JumpRun>& jumps) {
  Table table = costTable();
  const auto add = [&](const char* place, double gain) {
    addCost(table, place, "radau_iia", 2, "1e-4", gain);
    addCost(table, place, "radau_iia", 4, "1e-4", 1e-3);  // neither two nor five
    addCost(table, place, "radau_iia", 5, "1e-4", 3);
    addCost(table, place, "radau_iia", 7, "1e-4", 1);
    addCost(table, place, "radau_iia", 2, "1e-2", 1000);  // a larger error
    addCost(table, place, "radau_iia", 5, "1e-2", 1);
    addCost(table, place, "radau_iia", 2, "1e-6", 1, false);
    addCost(table, place, "radau_iia", 5, "1e-6", 1e-3);
    addCost(table, place, "gauss", 5, "1e-4", 1e-3);
  };
  add("crank", smooth);
  add("arm_smooth", smooth);
  add("crank_torque_off", discontinuous);
  add("arm_kinked", discontinuous);
  ResultTables results;
  results.put("cpu_time", "cpu_at_error", table);
  putSteps(results, jumps);
  return results;
}

TEST(ClaimThresholds, SmallStepsAtJumps) {
  const JumpRun small{3.1, 1}, wrong{1, 11}, neither{2.9, 9};
  EXPECT_EQ(said("C9", jumpTables(2, 1, {small})), kYes);
  EXPECT_EQ(said("C9", jumpTables(1.51, 1, {small, wrong})), kYes);
  EXPECT_EQ(said("C9", jumpTables(1.49, 1, {small})), kNo) << "does not pay";
  EXPECT_EQ(said("C9", jumpTables(2, 1, {small, neither})), kNo) << "not small, and not wrong";
  EXPECT_EQ(said("C9", jumpTables(2, 1, {neither})), kNo);
  EXPECT_EQ(said("C9", jumpTables(2, 3, {small})), kLimited) << "pays more at jumps";
  EXPECT_EQ(said("C9", jumpTables(2, 2, {small})), kLimited);
  EXPECT_EQ(said("C9", jumpTables(2, 1, {})), kUnknown);
  ResultTables nothing = jumpTables(2, 1, {small});
  nothing.put("cpu_time", "cpu_at_error", costTable());
  EXPECT_EQ(said("C9", nothing), kUnknown);
}

}  // namespace
}  // namespace irk
