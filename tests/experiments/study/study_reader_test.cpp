// The study reader refuses bad studies with file, line and key; no text ends the program.
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/study/study_reader.h"
#include "tests/experiments/support.h"
#include "tests/mutate.h"

namespace irk {
namespace {

Study parse(const std::string& toml, StudyVariant variant = StudyVariant::kFull) {
  return parseStudy(toml, "mine.toml", variant);
}

std::size_t runsOf(const Study& study) {
  std::size_t runs = 0;
  for (const auto& series : study.series) runs += series.runs.size();
  return runs;
}

// Lines 1 to 3 of every study in these tests.
const std::string kStart = "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\n";

std::string misuseOfLines(const std::string& lines) {
  return misuseOf([&] { parse(kStart + lines); });
}

TEST(StudyReader, RefusesKeysThatExcludeEachOther) {
  EXPECT_TRUE(containsAll(misuseOfLines("tolerances = 0.1\nsteps = 0.1"), {"mine.toml:5", "steps and tolerances"}));
  EXPECT_TRUE(containsAll(misuseOfLines("refine_most = 8\nsteps = 0.1"), {"mine.toml:4", "refine_most and steps"}));
  EXPECT_TRUE(containsAll(misuseOfLines("tolerances = 0.1\nrtol = 0.1"), {"mine.toml:5", "rtol beside tolerances"}));
  EXPECT_TRUE(containsAll(misuseOfLines("steps = 0.1\nh = 0.1"), {"mine.toml:5", "h beside steps"}));
  EXPECT_TRUE(containsAll(misuseOfLines("steps = 0.1\ncontrol = \"paper\""), {"mine.toml:5", "control", "'fixed'"}));
  EXPECT_TRUE(
      containsAll(misuseOfLines("refine_most = 8\nestimate = \"doubling\""), {"mine.toml:5", "estimate", "'none'"}));
  EXPECT_TRUE(containsAll(misuseOfLines("method = \"gauss_3\""), {"mine.toml:4", "'methods'"}));
  EXPECT_TRUE(containsAll(misuseOfLines("stages = 3"), {"mine.toml:4", "stages without families"}));
  EXPECT_NO_THROW(parse(kStart + "steps = 0.1\ncontrol = \"fixed\"\nestimate = \"none\"\n"));
  EXPECT_NO_THROW(parse(kStart + "tolerances = 0.1\nh = 0.1\n"));
}

TEST(StudyReader, NamesTheNearestKeyOfABlock) {
  for (const auto& [wrong, right] :
       {std::pair{"tolerancse", "tolerances"}, {"step", "steps"}, {"kapa", "kappa"}, {"metods", "methods"}}) {
    const std::string key = wrong;
    EXPECT_TRUE(
        containsAll(misuseOfLines(key + " = 0.1"), {"mine.toml:4", "'" + key + "'", std::string(right) + "'?"}));
  }
}

TEST(StudyReader, RefusesEmptyRangesAndTwins) {
  EXPECT_TRUE(containsAll(misuseOfLines("families = \"gauss\"\nstages = \"3..1\""), {"mine.toml:5", "'3..1'"}));
  EXPECT_TRUE(containsAll(misuseOfLines("families = \"gauss\"\nstages = [\"3..5\", 4]"), {"mine.toml:5", "4 twice"}));
  EXPECT_TRUE(containsAll(misuseOfLines("families = \"gauss\"\nstages = 2"), {"mine.toml:4", "gauss_2", "twice"}));
  EXPECT_TRUE(containsAll(misuseOfLines("tolerances = [1e-3, 1e-4,\n 0.001]"), {"mine.toml:5", "tolerances", "twice"}));
  EXPECT_TRUE(containsAll(misuseOfLines("newton = [\"full\", \"full\"]"), {"mine.toml:4", "newton", "'full' twice"}));
  EXPECT_TRUE(containsAll(misuseOfLines("newton = []"), {"mine.toml:4", "newton", "empty"}));
  EXPECT_TRUE(containsAll(misuseOfLines("families = \"gauss\"\nstages = \"1..\""), {"mine.toml:5", "stages"}));
  EXPECT_NO_THROW(parse(kStart + "families = \"gauss\"\nstages = [1, \"3..5\", \"7..7\"]\n"));
}

TEST(StudyReader, ACollectionStandsForItsScenes) {
  const auto scenesOf = [](const std::string& list) {
    std::vector<std::string> scenes;
    for (const auto& series : parse("[[block]]\nscene = " + list + "\nmethods = \"radau_iia_3\"\n").series) {
      scenes.push_back(series.runs.front().scene);
    }
    return scenes;
  };
  const auto ivp = scenesOf("\"@ivp\"");
  EXPECT_EQ(ivp.front(), "andrews");
  EXPECT_EQ(std::count(ivp.begin(), ivp.end(), "pendulum"), 1);
  const auto all = scenesOf("[\"@ivp\", \"kepler\", \"@multibody\"]");
  EXPECT_GT(all.size(), ivp.size() + 1);
  EXPECT_EQ(all[ivp.size()], "kepler");
  EXPECT_EQ(std::count(all.begin(), all.end(), "pendulum"), 1) << "of both collections";
  EXPECT_TRUE(containsAll(misuseOf([&] { scenesOf("\"@ipv\""); }), {"mine.toml:2: scene: ", "'ipv'", "'ivp'"}));
}

TEST(StudyReader, WantsIntegersWhereIntegersAreMeant) {
  const std::string block = "\n" + kStart;
  const auto head = [&](const std::string& lines) { return misuseOf([&] { parse(lines + block); }); };
  EXPECT_TRUE(containsAll(head("[timing]\nrepetitions = 3.7"), {"mine.toml:2", "repetitions", "3.7", "1 to 1000"}));
  EXPECT_TRUE(containsAll(head("[timing]\nrepetitions = true"), {"mine.toml:2", "repetitions"}));
  EXPECT_TRUE(containsAll(misuseOfLines("refine_most = 6.5"), {"mine.toml:4", "refine_most", "6.5"}));
  EXPECT_TRUE(containsAll(misuseOfLines("max_steps = 1.5"), {"mine.toml:4", "max_steps", "1.5"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parse("[audit]\nruns = 1.5\n"); }), {"mine.toml:2", "runs", "1.5"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parse("[audit]\nruns = 2\nseed = 0.5\n"); }), {"mine.toml:3", "seed"}));
  EXPECT_EQ(parse("[timing]\nrepetitions = 3.0\n" + block).timing.repetitions, 3);
}

TEST(StudyReader, RefusesMoreRunsThanABlockMayHave) {
  const std::string sweep =
      "newton = [\"simplified\", \"modified\", \"full\", \"broyden\"]\nfamilies = \"radau_iia\"\nstages = \"1..100\"\n"
      "tolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12]\n"
      "predictor = [\"extrapolated\", \"previous\"]\nsolver = [\"schur\", \"eigen\", \"coupled_dense\"]\n"
      "max_iterations = [5, 6, 7, 8, 9, 10, 11]\n";
  EXPECT_TRUE(containsAll(misuseOfLines(sweep), {"mine.toml:2", "203616 runs", "200000", "most_runs", "newton 4"}));
  EXPECT_TRUE(
      containsAll(misuseOfLines("tolerances = [0.1, 0.2, 0.3]\nmost_runs = 2"), {"mine.toml:2", "3 runs", "up to 2"}));
  EXPECT_TRUE(containsAll(misuseOfLines("most_runs = 0"), {"mine.toml:4", "most_runs"}));
  EXPECT_EQ(runsOf(parse(kStart + "tolerances = [0.1, 0.2, 0.3]\nmost_runs = 3\n")), 3u);
}

TEST(StudyReader, RefusesTablesWithoutEffect) {
  EXPECT_TRUE(containsAll(misuseOfLines("[defaults.quick]\nnewton = \"full\""), {"mine.toml:4", "quick"}));
  EXPECT_TRUE(containsAll(misuseOfLines("[block.quick.quick]\nnewton = \"full\""), {"mine.toml:4", "quick"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parse("[audit]\nruns = 2\n[defaults]\nscene = \"kepler\"\n"); }),
                          {"mine.toml:3", "defaults", "[audit]"}));
  EXPECT_TRUE(
      containsAll(misuseOf([] { parse("[audit]\nruns = 2\n" + kStart); }), {"mine.toml:3", "block", "[audit]"}));
}

TEST(StudyReader, RefusesListsThatPeersDoNotTake) {
  const std::string peer = "[[block]]\nscene = \"kepler\"\nmethods = [\"gauss_2\", \"cvode_bdf\"]\n";
  EXPECT_TRUE(containsAll(misuseOf([&] { parse(peer + "newton = [\"full\", \"modified\"]\n"); }),
                          {"mine.toml:4", "newton", "'cvode_bdf'"}));
  EXPECT_NO_THROW(parse(peer + "newton = \"modified\"\ntolerances = [0.1, 0.2]\nderivatives = [\"automatic\", "
                               "\"difference_forward\"]\n"));
}

TEST(StudyReader, RefusesWhatBlocksOfPeersDoNotTake) {
  const std::string peer = "[[block]]\nscene = \"kepler\"\nmethods = [\"ida_bdf\", \"cvode_bdf\"]\n";
  EXPECT_EQ(misuseOf([&] { parse(peer + "newton = \"full\"\ntolerances = 0.1\n"); }).substr(0, 113),
            "mine.toml:4: newton has no effect on 'ida_bdf', another library's integrator; it takes formulation, "
            "scaling, disc");
  EXPECT_TRUE(containsAll(misuseOf([&] { parse(peer + "tolerances = 0.1\nconfiguration = \"paper\"\n"); }),
                          {"mine.toml:5: configuration has no effect", "h_max, ", "time_limit, ", ", settings"}));
  EXPECT_NO_THROW(parse("[defaults]\nnewton = \"full\"\n" + peer + "tolerances = 0.1\nstorage = \"dense\"\n"));
  static_cast<void>(parseStudy("[quick]\nnewton = \"full\"\n" + peer, "mine.toml", StudyVariant::kQuick));
  EXPECT_TRUE(containsAll(misuseOf([&] { parse("[defaults]\nnewton = \"full\"\n" + peer + "newton = \"full\"\n"); }),
                          {"mine.toml:6", "newton"}));
}

TEST(StudyReader, RefusesWhatIsNoToml) {
  EXPECT_TRUE(containsAll(misuseOfLines("[\n[[block]]\n"), {"mine.toml:4", "key"}));
  EXPECT_TRUE(containsAll(misuseOfLines("[.a]\n"), {"mine.toml:4", "key"}));
  EXPECT_TRUE(containsAll(misuseOfLines("newton = [\"full\", }\"modified\"]\n"), {"mine.toml:4", "value"}));
  EXPECT_TRUE(containsAll(misuseOfLines("steps = [2,\n \xe2\x80\xa8 3]\n"), {"mine.toml:5"}));
  EXPECT_TRUE(containsAll(misuseOfLines("t_end = 1979-05-27T07:32:00Z\n"), {"mine.toml:4", "t_end", "a number"}));
  // toml++ would end the program.
  std::string parts = "a";
  for (int i = 0; i < 300'000; ++i) parts += ".a";
  EXPECT_TRUE(containsAll(misuseOfLines(parts + " = 1\n"), {"mine.toml:4", "key", "1000 parts"}));
  EXPECT_TRUE(containsAll(misuseOfLines("[" + parts + "]\n"), {"mine.toml:4", "key", "1000 parts"}));
  // Numbers have dots, too.
  std::string steps = "0.5";
  for (int i = 1; i < 2000; ++i) steps += ", " + std::to_string(0.5 + 1e-4 * i);
  EXPECT_NO_THROW(parse(kStart + "steps = [\n" + steps + "]\n"));
  EXPECT_EQ(parse("title = \"[ } \\\" \xe2\x80\xa8\"  # [ }\n" + kStart).title, "[ } \" \xe2\x80\xa8");
  EXPECT_NO_THROW(parse("\xef\xbb\xbf" + kStart));
}

const std::string kSeeds[] = {
    "title = \"A sweep\"\ntargets = [1e-4, 1e-6]\n[defaults]\nnewton = \"modified\"\n[timing]\nrepetitions = 2\n"
    "[[block]]\nscene = [\"kepler\", \"pendulum\"]\nfamilies = [\"gauss\"]\nstages = [\"1..3\", 5]\n"
    "tolerances = [1e-2, 1e-4]\n[block.quick]\nscene = \"kepler\"\nstages = 2\n",
    "orders = true  # a comment\n[quick]\nrefine_most = 4\n[[block]]\nscene = 'kaps'\nsettings = [\"\", "
    "\"eps=0.5\"]\n"
    "t_end = 1\nmethods = [\"gauss_2\",\n  \"radau_iia_3\"]\nrefine_most = 8\n"};

const std::string kPieces[] = {"[",
                               "]",
                               "[[",
                               "]]",
                               "{",
                               "}",
                               "=",
                               ".",
                               "\"",
                               "'",
                               "#",
                               "\n",
                               "\r",
                               ",",
                               "nan",
                               "-inf",
                               "\"\"\"",
                               "'''",
                               "0x",
                               "1_0",
                               "1__",
                               "99999999",
                               "\\u0000",
                               "\\",
                               "true",
                               "block",
                               "quick",
                               "\xff",
                               "\v",
                               " ",
                               "\t",
                               "a.b",
                               "\xc2\xa0",
                               "\xe2\x80\xa8",
                               "[block.quick]",
                               "1979-05-27T07:32:00Z",
                               std::string(1, '\0')};

// 100 000 texts made from two valid ones by a few random changes: each gives a study or a misuse of one line.
TEST(StudyReader, SurvivesMutatedTexts) {
  const auto [read, refused] = test::readMutated(test::Mutations(kSeeds, kPieces, 20041), 100'000, "mine.toml",
                                                 [](const std::string& text) { parse(text); });
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace irk
