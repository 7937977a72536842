// claims.toml and its reader.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "experiments/claims/claim.h"
#include "experiments/claims/measurement.h"
#include "experiments/report/figure_list.h"
#include "experiments/study/builtin_studies.h"
#include "irk/scene.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

TEST(ClaimProtocol, NamesWhatExists) {
  std::set<std::string> studies, figures;
  for (const auto& study : builtinStudies()) studies.emplace(study.id);
  for (const auto& figure : readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots/figures.txt")) {
    figures.insert(figure.name);
  }
  for (const auto& scene : protocol().multibody) EXPECT_EQ(findScene(scene).id, scene);
  std::size_t number = 0;
  for (const auto& claim : protocol().claims) {
    EXPECT_EQ(claim.id, "C" + std::to_string(++number));
    for (const auto& study : claim.studies) EXPECT_TRUE(studies.contains(study)) << claim.id << ": " << study;
    for (const auto& figure : claim.figures) EXPECT_TRUE(figures.contains(figure)) << claim.id << ": " << figure;
    for (const auto& part : claim.parts) EXPECT_NE(evaluationOf(part.id), nullptr);
  }
  EXPECT_GE(number, 15u);
  EXPECT_THROW(evaluationOf("C99"), std::logic_error);
}

// A file with one claim; `part` are the last lines of its part.
std::string file(const std::string& part, const std::string& date = "2026-11-23", const std::string& more = "") {
  return "multibody = []\n[[claim]]\nid = \"C1\"\ntitle = \"t\"\nwords = \"w\"\nsection = \"1\"\nstudies = []\nfigures "
         "= []\n" +
         more + "[[claim.part]]\nid = \"C1a\"\nname = \"n\"\nmeasured = \"m\"\n" + part +
         "\n[[claim.history]]\ndate = \"" + date + "\"\nchange = \"c\"\nreason = \"r\"\n";
}

std::string refusal(const std::string& text) {
  return misuseOf([&] { parseProtocol(text, "f.toml"); });
}

TEST(ClaimProtocol, ReadsThresholds) {
  const auto rangeOf = [](const std::string& part) {
    return parseProtocol(file("statistic = \"median\"\n" + part), "f.toml").claims[0].parts[0].confirmed;
  };
  EXPECT_TRUE(rangeOf("at_least = 2").contains(2));
  EXPECT_FALSE(rangeOf("at_least = 2").contains(1.9));
  EXPECT_FALSE(rangeOf("above = 0.5").contains(0.5));
  EXPECT_TRUE(rangeOf("at_most = 1.1").contains(1.1));
  EXPECT_FALSE(rangeOf("below = 1000").contains(1000));
  EXPECT_EQ(rangeText(rangeOf("at_least = 7\nat_most = 13")), "7 to 13");
  EXPECT_EQ(rangeText(rangeOf("above = 0.5")), "above 0.5");
  const auto claim =
      parseProtocol(file("statistic = \"share\"\nat_least = 0.8\ncase_above = 1\nnot_best = \"why\""), "f.toml")
          .claims[0];
  EXPECT_EQ(claim.parts[0].statistic, Statistic::kShare);
  EXPECT_FALSE(claim.parts[0].clean.contains(1));
  EXPECT_EQ(claim.parts[0].not_applied[1], "why");
  EXPECT_EQ(claim.history[0].date, "2026-11-23");
}

TEST(ClaimProtocol, RefusesWithPlace) {
  const std::string good = "statistic = \"median\"\nat_least = 2";
  EXPECT_NO_THROW(parseProtocol(file(good), "f.toml"));
  EXPECT_TRUE(containsAll(refusal(file(good + "\nat_lest = 3")), {"f.toml:15", "at_lest", "at_least"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"mean\"")), {"f.toml:13", "mean", "median"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"median\"")), {"f.toml:9", "no threshold"}));
  EXPECT_TRUE(containsAll(refusal(file(good + "\nabove = 1")), {"f.toml:15", "exclude"}));
  EXPECT_TRUE(containsAll(refusal(file(good + "\nat_most = 1")), {"no value"}));
  EXPECT_TRUE(containsAll(refusal(file(good + "\ncase_above = 1")), {"share"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"share\"\nat_least = 95\ncase_above = 1")), {"0 to 1"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"existence\"")), {"case_"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"existence\"\ncase_at_least = 2\nyes_or_no = true")),
                          {"yes_or_no", "case_at_least = 1"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"report\"\nabove = 1")), {"median or a share"}));
  EXPECT_TRUE(containsAll(refusal(file(good + "\nnot_best = \"a\"\nnot_paper = \"b\"")), {"no setting"}));
  EXPECT_TRUE(containsAll(refusal(file("statistic = \"median\"\nat_least = \"2\"")), {"f.toml:14", "number"}));
  EXPECT_TRUE(containsAll(refusal(file(good, "23.11.2026")), {"date", "year-month-day"}));
  EXPECT_TRUE(containsAll(refusal(file(good, "2026-11-23", "colour = \"red\"\n")), {"f.toml:9", "colour"}));
  EXPECT_TRUE(containsAll(refusal("multibody = []\n"), {"[[claim]]"}));
  EXPECT_TRUE(containsAll(refusal(file(good) + file(good).substr(15)), {"C1", "twice"}));
}

}  // namespace
}  // namespace irk::claims
