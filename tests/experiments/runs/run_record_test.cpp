// From a record to a row, to a file, and back: every number is found under its own name.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/runs/run_table.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// Another value of a field than the one it has; empty if the field takes none of these.
std::string otherValue(const SpecField& field, const RunSpec& spec) {
  const std::map<std::string_view, std::vector<std::string>> known = {
      {"scene", {"pendulum", "slider_crank"}},
      {"settings", {"torque_off_at=0.25"}},
      {"method", {"gauss_4"}}};
  std::vector<std::string> candidates;
  if (const auto own = known.find(field.name); own != known.end()) candidates = own->second;
  // The ids of an axis; then numbers that some range allows.
  const std::string allowed = field.allowed();
  for (std::size_t from = 0; allowed.find(" | ") != allowed.npos;) {
    const auto to = allowed.find(" | ", from);
    candidates.push_back(allowed.substr(from, to == allowed.npos ? to : to - from));
    if (to == allowed.npos) break;
    from = to + 3;
  }
  candidates.insert(candidates.end(), {"0.0625", "7", "3"});
  const std::string before = field.get(spec);
  for (const auto& value : candidates) {
    RunSpec changed = spec;
    try {
      field.set(changed, value);
    } catch (const Misuse&) {
      continue;
    }
    if (field.get(changed) != before) return value;
  }
  return {};
}

RunSpec base() {
  RunSpec spec;
  spec.scene = "slider_crank";
  return spec;
}

TEST(SpecFields, EachOneChangesTheKeyAndTheText) {
  const RunSpec spec = base();
  std::set<std::string> keys{specKey(spec)}, texts{canonicalText(spec)};
  for (const auto& field : specFields()) {
    const std::string value = otherValue(field, spec);
    ASSERT_FALSE(value.empty()) << field.name << ": no other value found";
    RunSpec changed = spec;
    field.set(changed, value);
    EXPECT_TRUE(keys.insert(specKey(changed)).second) << field.name << " = " << value;
    EXPECT_TRUE(texts.insert(canonicalText(changed)).second) << field.name << " = " << value;
  }
}

TEST(SpecFields, EachOneReadsBackAndLeavesTheOthersAlone) {
  const RunSpec spec = base();
  for (const auto& field : specFields()) {
    RunSpec changed = spec;
    field.set(changed, otherValue(field, spec));
    const RunSpec back = parseSpec(canonicalText(changed));
    EXPECT_EQ(canonicalText(back), canonicalText(changed)) << field.name;
    EXPECT_EQ(field.get(back), field.get(changed)) << field.name;
    if (field.name == "configuration") continue;  // sets several
    for (const auto& other : specFields()) {
      if (other.name == field.name) continue;
      EXPECT_EQ(other.get(changed), other.get(spec)) << field.name << " changes " << other.name;
    }
  }
}

// A record in which no two numbers are equal.
RunRecord distinct() {
  RunRecord record;
  record.spec = base();
  for (const auto& field : specFields()) {
    if (field.name == "configuration" || field.name == "scene") continue;
    field.set(record.spec, otherValue(field, record.spec));
  }
  record.family = "the_family";
  record.stages = 17;
  record.outcome = "success";
  record.detail = "a, \"detail\"";
  record.errors = {.all = 0.125, .u = 0.25, .v = 0.375, .x = 0.5, .z = 0.625, .drift = 0.75};
  Counters& c = record.counters;
  c.residuals = 101;
  c.dual_residuals = 102;
  c.jacobians = 103;
  c.factorizations = 104;
  c.solves = 105;
  c.newton_iterations = 106;
  c.newton_restarts = 107;
  c.steps_accepted = 108;
  c.steps_rejected_error = 109;
  c.steps_rejected_newton = 110;
  c.switches = 111;
  c.discontinuous_iterations = 112;
  c.located_events = 113;
  c.chattering = 114;
  record.cpu_s = 0.875;
  return record;
}

Table writtenAndRead(const std::vector<TableRow>& rows) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "runs.csv";
  writeTable(file, {{}, runColumns(), rows});
  return readTable(file);
}

TEST(RunRow, HoldsEveryNumberUnderItsName) {
  const RunRecord record = distinct();
  const Table table = writtenAndRead({runRow("the_key", "the_study", record)});
  ASSERT_EQ(table.rows.size(), 1u);
  const TableRow& row = table.rows.front();
  ASSERT_EQ(row.size(), table.columns.size());
  const auto text = [&](const char* column) { return textAt(table, row, column); };
  EXPECT_EQ(text("key"), "the_key");
  EXPECT_EQ(text("study"), "the_study");
  EXPECT_EQ(text("family"), "the_family");
  EXPECT_EQ(text("stages"), "17");
  EXPECT_EQ(text("outcome"), "success");
  EXPECT_EQ(text("detail"), "a, \"detail\"");
  EXPECT_EQ(text("integrator"), integratorName(record.spec));
  const std::map<const char*, double> numbers = {{"error", 0.125},
                                                 {"error_u", 0.25},
                                                 {"error_v", 0.375},
                                                 {"error_x", 0.5},
                                                 {"error_z", 0.625},
                                                 {"drift", 0.75},
                                                 {"residuals", 101},
                                                 {"dual_residuals", 102},
                                                 {"jacobians", 103},
                                                 {"factorizations", 104},
                                                 {"solves", 105},
                                                 {"newton_iterations", 106},
                                                 {"newton_restarts", 107},
                                                 {"steps_accepted", 108},
                                                 {"steps_rejected_error", 109},
                                                 {"steps_rejected_newton", 110},
                                                 {"switches", 111},
                                                 {"discontinuous_iterations", 112},
                                                 {"located_events", 113},
                                                 {"chattering", 114},
                                                 {"cpu_s", 0.875},
                                                 {"cpu_runs", 0}};
  for (const auto& [column, number] : numbers) {
    EXPECT_EQ(numberAt(table, row, column), number) << column;
  }
  EXPECT_TRUE(std::isnan(numberAt(table, row, "cpu_median_s")));
  EXPECT_TRUE(std::isnan(numberAt(table, row, "cpu_spread")));
  for (const auto& field : specFields()) {
    if (!table.hasColumn(field.name)) continue;
    EXPECT_EQ(textAt(table, row, field.name), field.get(record.spec)) << field.name;
  }
}

TEST(RunRow, ColumnsAreNamedOnce) {
  const auto columns = runColumns();
  EXPECT_EQ(std::set<std::string>(columns.begin(), columns.end()).size(), columns.size());
}

TEST(RunRow, TimesGoToTheirColumns) {
  Table table{{}, runColumns(), {runRow("key", "study", distinct())}};
  setTiming(table, table.rows.front(), {0.25, 0.5, 2.5, {0.75, 0.25, 0.5}});
  const TableRow& row = table.rows.front();
  EXPECT_EQ(numberAt(table, row, "cpu_s"), 0.25);
  EXPECT_EQ(numberAt(table, row, "cpu_median_s"), 0.5);
  EXPECT_EQ(numberAt(table, row, "cpu_spread"), 2.5);
  EXPECT_EQ(numberAt(table, row, "cpu_runs"), 3);
  EXPECT_EQ(textAt(table, row, "cpu_all"), "0.75 0.25 0.5");
}

// What a series runs through, and all else tells series apart.
TEST(RunSeries, DifferInAllThatHasAColumnButStepAndTolerances) {
  const RunSpec spec = base();
  std::vector<std::string> names;
  std::vector<TableRow> rows;
  const auto add = [&](const std::string& name, const RunSpec& s) {
    RunRecord record;
    record.spec = s;
    record.outcome = "success";
    names.push_back(name);
    rows.push_back(runRow(name, "study", record));
  };
  add("", spec);
  Table table{{}, runColumns(), {}};
  std::set<std::string> swept;
  for (const auto& field : specFields()) {
    if (!table.hasColumn(field.name) || field.name == "t_end") continue;
    RunSpec changed = spec;
    field.set(changed, otherValue(field, spec));
    if (field.name == "h" || field.name == "rtol" || field.name == "atol")
      swept.insert(std::string(field.name));
    add(std::string(field.name), changed);
  }
  table.rows = rows;
  ASSERT_EQ(swept.size(), 3u);
  const auto series = seriesOf(table);
  EXPECT_EQ(series.size(), rows.size() - 3);
  EXPECT_EQ(series.front().rows.size(), 4u);
  for (const auto* row : series.front().rows) {
    EXPECT_TRUE(row->front().empty() || swept.contains(row->front())) << row->front();
  }
}

}  // namespace
}  // namespace irk
