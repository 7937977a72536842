#include <gtest/gtest.h>

#include "experiments/analyses/newmark.h"
#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

TEST(Claims, DroppedMassDerivatives) {
  const auto tables = [](double factor) {
    ResultTables results;
    Table runs = costColumns({"block", "method", "newton", "jacobian"});
    const auto add = [&](const char* block, const char* terms, double scale) {
      addSeries(runs, {{"block", block}, {"method", "radau_iia_3"}, {"newton", "simplified"}, {"jacobian", terms}},
                scale);
    };
    add("terms_elastic_rod", "full", 1);
    add("terms_elastic_rod", "no_mass", factor);
    add("terms_constant_mass", "full", 1);
    add("terms_constant_mass", "no_mass", 1);
    results.put("jacobian", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C5", tables(0.9)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C5", tables(1.05)), Verdict::kWithinLimits);  // little, but not faster
  EXPECT_EQ(verdict("C5", tables(3)), Verdict::kContradicted);
  EXPECT_TRUE(containsAll(judge(claim("C5"), tables(3)).number, {"3 times the iterations"}));
}

TEST(Claims, RuleOfTheModifiedNewtonMethod) {
  const auto tables = [](double papers) {
    ResultTables results;
    Table runs =
        costColumns({"scene", "settings", "method", "contractivity_limit", "contractivity_after", "max_iterations"});
    const auto add = [&](const char* limit, double scale) {
      addSeries(runs,
                {{"scene", "slider_crank"},
                 {"settings", ""},
                 {"method", "radau_iia_3"},
                 {"contractivity_limit", limit},
                 {"contractivity_after", "3"},
                 {"max_iterations", "25"}},
                scale);
    };
    add("0.69999999999999996", papers);
    add("0.5", 1);
    results.put("newton_rule", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C12", tables(1)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C12", tables(1.2)), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C12", tables(2)), Verdict::kContradicted);
}

TEST(Claims, Families) {
  const auto tables = [](double radau) {
    Table costs;
    costs.columns = {"scene", "family", "stages", "target_error", "cpu_s", "reached"};
    for (const auto* error : {"1e-4", "1e-6"}) {
      costs.rows.push_back({"pendulum", "radau_iia", "3", error, text(radau), "1"});
      costs.rows.push_back({"pendulum", "radau_iia", "2", error, "9", "1"});
      costs.rows.push_back({"pendulum", "gauss", "3", error, "1", "1"});
      costs.rows.push_back({"pendulum", "lobatto_iiia", "3", error, "nan", "0"});
    }
    ResultTables results;
    results.put("families", "cpu_at_error", costs);
    return results;
  };
  EXPECT_EQ(verdict("C13", tables(0.5)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C13", tables(1.05)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C13", tables(2)), Verdict::kContradicted);
}

TEST(Claims, Drift) {
  const auto tables = [](const char* drift) {
    ResultTables results;
    Table runs = costColumns({"scene", "method", "family", "stages", "formulation", "rtol", "drift"});
    for (const auto* formulation : {"index2", "ggl"}) {
      addSeries(runs,
                {{"scene", "pendulum"},
                 {"method", "radau_iia_3"},
                 {"family", "radau_iia"},
                 {"stages", "3"},
                 {"formulation", formulation},
                 {"rtol", "1e-6"},
                 {"drift", drift}},
                1);
    }
    results.put("drift", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C7", tables("1e-9")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C7", tables("1e-3")), Verdict::kContradicted);
}

TEST(Claims, SharesOfTheFactorization) {
  const auto tables = [](const char* evaluation, const char* factorization) {
    Table phases;
    phases.columns = {"solver", "n", "share_residual", "share_jacobian", "share_factorization"};
    phases.rows = {{"coupled_dense", "20", evaluation, "0.1", factorization},
                   {"coupled_dense", "500", "0.1", "0.1", "0.7"},  // beyond the claim
                   {"schur", "20", "0.1", "0.1", "0.7"}};
    ResultTables results;
    results.put("phases", "phases", phases);
    return results;
  };
  EXPECT_EQ(verdict("C4", tables("0.6", "0.2")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C4", tables("0.1", "0.7")), Verdict::kContradicted);
}

TEST(Claims, RelativeTolerancesAndTheKForm) {
  const auto tables = [](const char* study, const char* column, const char* base, const char* other, double factor) {
    ResultTables results;
    Table runs = costColumns({"scene", "method", column, "steps_accepted", "detail"});
    addSeries(runs, {{"scene", "kepler"}, {"method", "radau_iia_3"}, {column, base}, {"detail", ""}}, 1);
    addSeries(runs, {{"scene", "kepler"}, {"method", "radau_iia_3"}, {column, other}, {"detail", ""}}, factor);
    results.put(study, "runs", runs);
    return results;
  };
  const auto norm = [&](double f) { return tables("control", "norm", "mixed", "absolute", f); };
  EXPECT_EQ(verdict("C14", norm(1)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C14", norm(1.4)), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C14", norm(3)), Verdict::kContradicted);
  const auto form = [&](double f) { return tables("k_form", "formulation", "first_order", "index2", f); };
  EXPECT_EQ(verdict("C11", form(0.5)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C11", form(2)), Verdict::kContradicted);
}

TEST(Claims, TinySteps) {
  const auto tables = [](const char* error3, const char* error2, const char* outcome_unscaled) {
    Table runs;
    runs.columns = {"block",   "formulation", "scaling",           "h",
                    "outcome", "error_z",     "newton_iterations", "steps_accepted"};
    const auto add = [&](const char* formulation, const char* scaling, const char* outcome, const char* error) {
      runs.rows.push_back({"known_multiplier", formulation, scaling, "1e-8", outcome, error, "20", "10"});
      runs.rows.push_back({"known_multiplier", formulation, scaling, "1e-3", "success", "1e-9", "20", "10"});
    };
    add("index3", "on", "success", error3);
    add("index3", "off", outcome_unscaled, "nan");
    add("index2", "on", "success", error2);
    ResultTables results;
    results.put("small_steps", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C6", tables("0.1", "1e-12", "newton_failed")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C6", tables("0.1", "1e-12", "success")), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C6", tables("0.1", "0.1", "newton_failed")), Verdict::kContradicted);
  EXPECT_EQ(verdict("C6", tables("1e-12", "1e-12", "success")), Verdict::kContradicted);
}

TEST(Claims, MultistepMethodsAtJumps) {
  const auto tables = [](double with_jumps) {
    Table costs;
    costs.columns = {"block", "scene", "settings", "method", "target_error", "reached", "cpu_s"};
    const auto add = [&](const char* block, const char* method, double cost) {
      costs.rows.push_back({block, block, "", method, "1e-4", "1", text(cost)});
    };
    add("stiff", "cvode_bdf", 2);
    add("stiff", "radau_iia_5", 1);
    add("stiff", "arkode_dirk", 0.01);  // of neither kind
    add("contact", "cvode_bdf", 2 * with_jumps);
    add("contact", "radau_iia_5", 1);
    ResultTables results;
    results.put("peers", "cpu_at_error", costs);
    return results;
  };
  EXPECT_EQ(verdict("C8", tables(3)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C8", tables(1.2)), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C8", tables(0.9)), Verdict::kContradicted);
}

TEST(Claims, ReuseOfJacobiansAndFactorizations) {
  const auto tables = [](double time, const char* decoupled) {
    ResultTables results;
    Table runs = costColumns({"block", "method", "keep_jacobian_below"});
    const auto add = [&](const char* below, double scale) {
      addSeries(runs, {{"block", "reuse"}, {"method", "radau_iia_3"}, {"keep_jacobian_below", below}}, scale);
    };
    add("0", 1);
    add("0.10000000000000001", time);
    results.put("jacobian", "runs", runs);
    Table phases;
    phases.columns = {"scene", "settings", "method", "derivatives", "solver", "n", "factorization_s"};
    phases.rows = {{"ancf_pendulum", "", "radau_iia_3", "automatic", "coupled_dense", "50", "1"},
                   {"ancf_pendulum", "", "radau_iia_3", "automatic", "schur", "50", decoupled}};
    results.put("phases", "phases", phases);
    return results;
  };
  EXPECT_EQ(verdict("C15", tables(0.9, "0.9")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C15", tables(0.9, "0.1")), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C15", tables(1.5, "0.9")), Verdict::kContradicted);
}

TEST(Claims, NewmarkIsLobattoIIIA) {
  EXPECT_LT(newmarkDifference(), 1000);  // in units of round-off
  EXPECT_EQ(verdict("C10", ResultTables{}), Verdict::kConfirmed);
}

}  // namespace
}  // namespace irk::claims
