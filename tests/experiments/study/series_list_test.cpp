// The series of large blocks are made on demand; they are those of small ones.
#include "experiments/study/series_list.h"

#include <gtest/gtest.h>

#include "experiments/base/numbers.h"
#include "experiments/runner/series_keys.h"
#include "experiments/runs/fields.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

Study studyOf(const std::string& settings, const std::string& sweep) {
  return parseStudy(
      "[[block]]\nname = \"large\"\nscene = [\"kepler\", \"van_der_pol\"]\nconfiguration = \"embedded\"\n"
      "max_steps = [1000, 2000]\nmethods = [\"radau_iia_2\", \"radau_iia_3\"]\natol_of = [" +
          settings + "]\n" + sweep,
      "mine.toml", StudyVariant::kFull);
}

std::string atolOf(int i) { return "\"x=" + std::to_string(i + 1) + "e-6\""; }

std::string textOf(const Series& series) {
  std::string text = series.block + std::to_string(static_cast<int>(series.end));
  for (const auto& spec : series.runs) text += "\n" + canonicalText(spec);
  return text;
}

TEST(SeriesList, LargeBlocksAreProductsOfTheirLists) {
  constexpr int kValues = 600;  // 4800 series
  std::string all;
  for (int i = 0; i < kValues; ++i) all += (i == 0 ? "" : ", ") + atolOf(i);
  for (const std::string sweep : {"tolerances = [1e-4, 1e-6]\n", "rtol = 1e-5\n", "refine_most = 8\n"}) {
    SCOPED_TRACE(sweep);
    const Study large = studyOf(all, sweep);
    ASSERT_EQ(large.series.size(), 8u * kValues);
    // atol_of is the first list by name, and changes slowest.
    for (const int i : {0, 1, 299, kValues - 1}) {
      const Study one = studyOf(atolOf(i), sweep);
      ASSERT_EQ(one.series.size(), 8u);
      for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_EQ(textOf(large.series[8 * static_cast<std::size_t>(i) + k]), textOf(one.series[k]));
      }
    }
  }
}

// The keys of a series are made together.
TEST(SeriesList, KeysAreThoseOfEachRunAlone) {
  std::size_t runs = 0;
  for (const auto& entry : builtinStudies()) {
    const Study study = loadStudy(std::string(entry.id), StudyVariant::kQuick);
    for (const Series series : study.series) {
      const auto keys = keysOf(series);
      ASSERT_EQ(keys.size(), series.runs.size());
      for (const std::size_t run : {std::size_t(0), keys.size() / 2, keys.size() - 1}) {
        ASSERT_EQ(hexText(keys[run]), specKey(series.runs[run])) << canonicalText(series.runs[run]);
        ++runs;
      }
    }
  }
  EXPECT_GT(runs, 1000u);
}

Series ofScene(const std::string& scene) {
  RunSpec spec;
  spec.scene = scene;
  return {spec, SeriesEnd::kAll, {}};
}

TEST(SeriesList, ReadsLikeAVector) {
  SeriesList list(std::vector<Series>{ofScene("a"), ofScene("b")});
  list.append(1, [](std::size_t) { return ofScene("c"); });
  list.append(5000, [](std::size_t i) { return ofScene(std::to_string(i)); });
  ASSERT_EQ(list.size(), 5003u);
  std::vector<std::string> scenes;
  for (const auto& series : list) scenes.push_back(series.runs.front().scene);
  ASSERT_EQ(scenes.size(), 5003u);
  EXPECT_EQ(scenes[0] + scenes[1] + scenes[2] + scenes[3], "abc0");
  EXPECT_EQ(scenes.back(), "4999");
}

}  // namespace
}  // namespace irk
