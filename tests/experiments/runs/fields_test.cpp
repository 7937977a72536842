// Changes every field of a run to every other id of its axis, or to other legal numbers, and checks that everything
// derived from the fields changes, too. New fields are tested automatically.
#include "experiments/runs/fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "experiments/commands/commands.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/other_spec.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// Calls `check(field, value, changed)` for every other value of every field.
void forEachChange(const std::function<void(const SpecField&, const std::string&, const RunSpec&)>& check) {
  const RunSpec base = sliderCrank();
  for (const auto& field : specFields()) {
    const auto values = otherValues(field, base);
    ASSERT_FALSE(values.empty()) << field.name << ": no other value; a text needs one in other_spec.h";
    for (const auto& value : values) {
      SCOPED_TRACE(field.name + " = " + value);
      RunSpec changed = base;
      field.set(changed, value);
      check(field, value, changed);
    }
  }
}

RunRecord recordOf(const RunSpec& spec) {
  RunRecord record;
  record.spec = spec;
  record.outcome = "success";
  return record;
}

TEST(Fields, AreNamedOnceAndExplained) {
  std::set<std::string> names, swept;
  for (const auto& field : specFields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_TRUE(field.meaning.ends_with(".")) << field.name;
    EXPECT_FALSE(field.allowed().empty()) << field.name;
    if (field.swept) swept.insert(field.name);
  }
  EXPECT_EQ(swept, (std::set<std::string>{"h", "rtol", "atol"}));
}

TEST(Fields, EachOneChangesTextAndKey) {
  std::set<std::string> texts{canonicalText(sliderCrank())}, keys{specKey(sliderCrank())};
  forEachChange([&](const SpecField&, const std::string&, const RunSpec& changed) {
    EXPECT_TRUE(texts.insert(canonicalText(changed)).second);
    EXPECT_TRUE(keys.insert(specKey(changed)).second);
  });
}

TEST(Fields, EachOneReadsBackAndLeavesTheOthersAlone) {
  const RunSpec base = sliderCrank();
  forEachChange([&](const SpecField& field, const std::string& value, const RunSpec& changed) {
    EXPECT_EQ(field.get(changed), value);
    EXPECT_EQ(canonicalText(parseSpec(canonicalText(changed))), canonicalText(changed));
    EXPECT_NO_THROW(validate(changed));
    if (field.name == "configuration") return;  // it sets other fields
    for (const auto& other : specFields()) {
      if (other.name == field.name) continue;
      EXPECT_EQ(other.get(changed), other.get(base)) << other.name;
    }
  });
}

// Sweeps over anything but steps and tolerances must not form one series.
TEST(Fields, EachOneHasACellAndTellsSeriesApart) {
  Table runs{{}, runColumns(), {runRow("base", "study", recordOf(sliderCrank()))}};
  const TableRow before = runs.rows.front();
  ASSERT_EQ(before.size(), runs.columns.size());
  std::size_t swept = 0;
  forEachChange([&](const SpecField& field, const std::string& value, const RunSpec& changed) {
    ASSERT_TRUE(runs.hasColumn(field.name));
    const TableRow row = runRow(field.swept ? "swept" : "other", "study", recordOf(changed));
    EXPECT_EQ(textAt(runs, row, field.name), value);
    EXPECT_NE(textAt(runs, row, field.name), textAt(runs, before, field.name));
    if (field.swept) ++swept;
    runs.rows.push_back(row);
  });
  const auto series = seriesOf(runs);
  EXPECT_EQ(series.size(), runs.rows.size() - swept);
  EXPECT_EQ(series.front().rows.size(), 1 + swept);
  for (const auto* row : series.front().rows) EXPECT_NE(row->front(), "other");
}

TEST(Fields, HelpNamesAndExplainsEachOne) {
  const auto help = program({"solve", "--help"}).out;
  for (const auto& field : specFields()) {
    EXPECT_TRUE(containsAll(help, {optionName(field.name) + " ", field.meaning, field.allowed()})) << field.name;
    if (!field.defaultText().empty()) {
      EXPECT_TRUE(containsAll(helpText(field), {"default " + field.defaultText()}));
    }
    EXPECT_TRUE(containsAll(help, {helpText(field)})) << field.name;
  }
}

TEST(Fields, ListsNameEachOne) {
  const auto list = program({"list"}).out;
  for (const auto& field : specFields()) {
    if (field.kind == FieldKind::kText) continue;  // scenes and methods are tested elsewhere
    EXPECT_TRUE(containsAll(list, {"\n" + field.name + " ", field.meaning})) << field.name;
    if (field.kind != FieldKind::kAxis) continue;
    for (const auto& choice : field.choices()) {
      EXPECT_TRUE(containsAll(list, {"    " + choice.id + " ", choice.meaning})) << field.name;
    }
  }
}

TEST(Fields, JsonHoldsEachOneAndNumbersAsNumbers) {
  const std::string before = solveJson(recordOf(sliderCrank()));
  std::set<std::string> texts{before};
  forEachChange([&](const SpecField& field, const std::string&, const RunSpec& changed) {
    const std::string json = solveJson(recordOf(changed));
    EXPECT_TRUE(texts.insert(json).second);
    const bool quoted = json.find("\"" + field.name + "\": \"") != json.npos;
    EXPECT_TRUE(containsAll(json, {"\"" + field.name + "\": "}));
    if (field.name == "settings") return;  // an object in JSON
    EXPECT_EQ(quoted, !field.isNumeric());
  });
}

TEST(Fields, StudiesTakeEachOne) {
  forEachChange([&](const SpecField& field, const std::string& value, const RunSpec&) {
    if (field.kind == FieldKind::kText) return;  // their keys are of another kind
    const std::string text = field.isNumeric() ? value : '"' + value + '"';
    const Study study = parseStudy(
        "[[block]]\nscene = \"slider_crank\"\nmethods = \"radau_iia_3\"\n" + field.name + " = " + text + "\n",
        "mine.toml", StudyVariant::kFull);
    ASSERT_EQ(study.series.size(), 1u);
    EXPECT_EQ(field.get(study.series[0].runs.front()), value);
  });
}

// Every field is set by its option, or refused because it would have no effect.
TEST(Fields, OptionsSetEachOneOrAreRefused) {
  forEachChange([&](const SpecField& field, const std::string& value, const RunSpec&) {
    if (field.kind == FieldKind::kText || field.name == "h") return;
    SolveOptions options;
    options.scene = "slider_crank";
    options.fields = {{field.name, value}};
    try {
      EXPECT_EQ(field.get(solveSpec(options)), value);
    } catch (const Misuse& misuse) {
      EXPECT_TRUE(field.unused) << misuse.what();
      EXPECT_TRUE(containsAll(misuse.what(), {optionName(field.name) + " has no effect here: "}));
    }
  });
}

TEST(Fields, NumbersOutOfRangeAreRefused) {
  for (const auto& field : specFields()) {
    if (!field.isNumeric()) continue;
    for (const double x : illegalValues(field.range)) {
      if (field.name == "t_end" && std::isnan(x)) continue;  // stands for the scene's own end time
      const std::string text = textOf(field, x);
      RunSpec spec = sliderCrank();
      EXPECT_TRUE(containsAll(misuseOf([&] { field.set(spec, text); }), {field.name, text, field.range.text()}));
      if (field.kind == FieldKind::kInteger && (!std::isfinite(x) || x != std::floor(x))) continue;  // not an integer
      field.assign(spec, x);
      EXPECT_TRUE(containsAll(misuseOf([&] { validate(spec); }), {field.name, text, field.range.text()}));
      EXPECT_TRUE(containsAll(misuseOf([&] { prepare(spec); }), {field.name, text, field.range.text()}));
    }
  }
}

}  // namespace
}  // namespace irk
