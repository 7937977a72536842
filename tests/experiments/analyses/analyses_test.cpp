// The catalogue of analyses, and the keys with which a study requests them.
#include "experiments/study/analysis.h"

#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <sstream>

#include "experiments/analyses/results.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

constexpr char kBlock[] =
    "[[block]]\nscene = \"kepler\"\nt_end = 0.5\nmethods = \"gauss_2\"\ntolerances = [1e-3, 1e-4]\n";

Study parse(const std::string& lines) { return parseStudy(lines + kBlock, "mine.toml", StudyVariant::kFull); }

std::set<std::string> filesOf(std::string_view list) {
  std::istringstream words{std::string(list)};
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(Analyses, AreCompleteAndWriteFilesOfTheirOwn) {
  std::set<std::string> ids, keys, written{"runs.csv"};
  for (const Analysis& analysis : analyses()) {
    EXPECT_TRUE(ids.insert(std::string(analysis.id)).second) << analysis.id;
    EXPECT_TRUE(keys.insert(std::string(analysis.key)).second) << analysis.key;
    EXPECT_FALSE(analysis.meaning.empty()) << analysis.id;
    EXPECT_NE(analysis.run, nullptr) << analysis.id;
    for (const auto& file : filesOf(analysis.reads))
      EXPECT_TRUE(written.contains(file)) << file << " is written before";
    for (const auto& file : filesOf(analysis.writes))
      EXPECT_TRUE(written.insert(file).second) << file << " by one only";
  }
}

TEST(Analyses, AStudyAsksByTheirKeys) {
  EXPECT_TRUE(parse("").analyses.empty());
  EXPECT_TRUE(parse("energy = false\n").analyses.empty());
  const Study study = parse("energy = true\nprofile = true\ntargets = [1e-3]\n");
  ASSERT_EQ(study.analyses.size(), 3u);
  EXPECT_EQ(study.analyses[0]->id, "cost");
  EXPECT_EQ(study.analyses[1]->id, "profile");
  EXPECT_EQ(study.analyses[2]->id, "energy");
  EXPECT_TRUE(containsAll(misuseOf([] { parse("title = \"x\"\nprofile = true\n"); }),
                          {"mine.toml:2", "profile without targets"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parse("energie = true\n"); }), {"mine.toml:1", "energie", "'energy'"}));
}

TEST(Analyses, WriteTheFilesThatTheyDeclare) {
  const TemporaryFolder folder;
  const auto [study, runs] = runsOf(std::string("orders = true\ntargets = [1e-2]\nprofile = true\n") + kBlock);
  std::ostringstream quiet;
  writeSummaries(study, runs, folder.path(), quiet);
  std::set<std::string> files, said;
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    files.insert(file.path().filename().string());
  for (const Analysis* analysis : study.analyses) said.merge(filesOf(analysis->writes));
  EXPECT_EQ(files, said);
}

}  // namespace
}  // namespace irk
