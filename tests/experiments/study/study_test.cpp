#include "experiments/study/analysis.h"
#include "experiments/study/study_reader.h"

#include <gtest/gtest.h>

#include "tests/experiments/support.h"

namespace irk {
namespace {

Study parsed(const std::string& toml, StudyVariant variant = StudyVariant::kFull) {
  return parseStudy(toml, "mine.toml", variant);
}

constexpr char kSweep[] = R"(
title = "A sweep"
targets = [1e-4, 1e-6]
[defaults]
newton = "modified"
[timing]
repetitions = 2
[[block]]
scene = ["kepler", "pendulum"]
formulation = ["index2", "index3"]
families = ["gauss", "lobatto_iiia"]
stages = ["1..3", 5]
tolerances = [1e-2, 1e-4, 1e-6]
[block.quick]
scene = "kepler"
stages = 2
)";

TEST(Study, IsACartesianProduct) {
  const Study study = parsed(kSweep);
  EXPECT_EQ(study.id, "mine");
  EXPECT_EQ(study.title, "A sweep");
  EXPECT_EQ(study.targets, (std::vector<double>{1e-4, 1e-6}));
  EXPECT_TRUE(study.timing.wanted);
  EXPECT_EQ(study.timing.repetitions, 2);
  ASSERT_EQ(study.analyses.size(), 1u);
  EXPECT_EQ(study.analyses[0]->id, "cost");
  // 2 scenes, 2 formulations, gauss_1, 2, 3, 5 and lobatto_iiia_2, 3, 5 (lobatto_iiia_1 does not exist).
  ASSERT_EQ(study.series.size(), 2u * 2 * 7);
  for (const auto& series : study.series) {
    ASSERT_EQ(series.runs.size(), 3u);
    EXPECT_EQ(series.end, SeriesEnd::kTooLong);
    EXPECT_EQ(series.runs[2].options.tolerances.rtol, 1e-6);
    EXPECT_EQ(series.runs[2].options.tolerances.atol, 1e-6);
    EXPECT_EQ(series.runs[0].options.newton.kind, NewtonKind::kModified);
  }
}

TEST(Study, QuickVariantReplacesKeys) {
  const Study quick = parsed(kSweep, StudyVariant::kQuick);
  EXPECT_EQ(quick.series.size(), 2u * 2);
}

TEST(Study, StepsForOrdersAreCandidatesOfThePlanner) {
  const Study study = parsed(R"(
[[block]]
scene = "kepler"
t_end = 6
methods = "gauss_2"
refine_most = 6
)");
  ASSERT_EQ(study.series.size(), 1u);
  const auto& series = study.series[0];
  EXPECT_EQ(series.end, SeriesEnd::kAsymptotic);
  ASSERT_EQ(series.runs.size(), 3u);
  EXPECT_EQ(series.runs[1].options.step.h, 1.5);
  EXPECT_EQ(series.runs[1].options.step.control, StepControl::kFixed);
}

TEST(Study, ErrorsNameFileLineKeyAndWhatIsAllowed) {
  const std::string start = "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\n";
  const auto misuse = [&](const std::string& line) { return misuseOf([&] { parsed(start + line + "\n"); }); };
  EXPECT_TRUE(containsAll(misuse("newtn = \"full\""), {"mine.toml:4", "newtn", "'newton'"}));
  EXPECT_TRUE(containsAll(misuse("newton = \"ful\""), {"mine.toml:4", "'ful'", "'full'"}));
  EXPECT_TRUE(containsAll(misuse("tolerances = [1e-3, -1]"), {"mine.toml:4", "tolerances", "-1", "> 0"}));
  EXPECT_TRUE(containsAll(misuse("refine_most = 0"), {"mine.toml:4", "refine_most", "0", "an integer from 2"}));
  EXPECT_TRUE(containsAll(misuse("families = \"gaus\"\nstages = 2"), {"mine.toml:4", "gaus", "'gauss'"}));
  EXPECT_TRUE(containsAll(misuse("families = \"gauss\"\nstages = 200"), {"mine.toml:5", "stages", "200", "100"}));
  EXPECT_TRUE(containsAll(misuse("families = \"gauss\""), {"mine.toml:4", "stages"}));
  EXPECT_TRUE(containsAll(misuse("steps = []"), {"mine.toml:4", "steps", "empty"}));
  EXPECT_TRUE(containsAll(misuse("settings = \"eccentricty=0.5\""), {"mine.toml:", "eccentricty"}));
  EXPECT_TRUE(containsAll(misuse("x = = 1"), {"mine.toml:4"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parsed("titel = 1\n[[block]]\n"); }), {"mine.toml:1", "titel", "'title'"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parsed("title = \"x\"\n"); }), {"mine.toml", "[[block]]"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parsed("[[block]]\nmethods=\"gauss_2\"\n"); }), {"mine.toml:1", "scene"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parsed("[[block]]\nscene=\"kepler\"\nmethods=\"radau_iia\"\n"); }),
                          {"mine.toml:3", "'radau_iia': that is a family", "order 'variable' only", "radau_iia_5"}));
  const Study family = parsed("[[block]]\nscene=\"kepler\"\nconfiguration=\"variable\"\nmethods=\"radau_iia\"\n");
  EXPECT_EQ(family.series.front().runs.front().method, "radau_iia");
  EXPECT_TRUE(containsAll(misuseOf([] { parsed("orders = 3\n[[block]]\nscene=\"kepler\"\nmethods=\"gauss_2\"\n"); }),
                          {"mine.toml:1", "orders", "true or false"}));
  EXPECT_TRUE(containsAll(misuseOf([] { loadStudy("ordr", StudyVariant::kFull); }), {"ordr", "'order'"}));
}

// Such analyses would fail after all runs are made, or describe another run than the one in the table.
TEST(Study, AnalysesOfOneMethodRefuseVariableOrder) {
  const std::string block = "\n[[block]]\nscene = \"kepler\"\n";
  for (const std::string analysis : {"scaling", "estimates", "phases"}) {
    const std::string wanted = analysis + " = true";
    for (const std::string methods : {"radau_iia", "radau_iia_5"}) {
      const std::string text = wanted + block + "methods = \"" + methods + "\"\n";
      EXPECT_TRUE(containsAll(misuseOf([&] { parsed(text + "configuration = \"variable\"\n"); }),
                              {"mine.toml:5", "order 'variable'", wanted}));
      EXPECT_TRUE(containsAll(misuseOf([&] { parsed(text + "estimate = \"embedded\"\norder = \"variable\"\n"); }),
                              {"mine.toml:6", "order 'variable'", wanted}));
    }
    EXPECT_NO_THROW(parsed(wanted + block + "methods = \"radau_iia_5\"\n"));
  }
  EXPECT_NO_THROW(parsed("title = \"none\"" + block + "methods = \"radau_iia\"\nconfiguration = \"variable\"\n"));
}

}  // namespace
}  // namespace irk
