// The order in which many workers make the runs of a study: the same runs for any number of them.
#include "experiments/runner/schedule/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

struct SimulatedRun {
  RunFacts facts;
  double seconds;
};

/// The time that `workers` need for all runs. `made` gives the facts and the seconds of a run.
double simulatedSeconds(Schedule schedule, const std::function<SimulatedRun(const Piece&)>& made, int workers) {
  struct UnderWay {
    double begin, end;
    Piece piece;
    RunFacts facts;
  };
  std::vector<UnderWay> all;
  double now = 0;
  while (true) {
    // A cancelled run ends at once.
    for (auto& run : all) {
      if (run.piece.cancelled && *run.piece.cancelled) run.end = std::min(run.end, now);
    }
    while (all.size() < static_cast<std::size_t>(workers)) {
      auto piece = schedule.next();
      if (!piece) break;
      auto [facts, seconds] = made(*piece);
      all.push_back({now, now + seconds, std::move(*piece), std::move(facts)});
    }
    if (all.empty() || schedule.isOver()) return now;
    const auto first = std::min_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.end < b.end; });
    UnderWay done = std::move(*first);
    all.erase(first);
    now = done.end;
    schedule.record(done.piece, done.facts);
  }
}

/// A study with series of `runs` runs each whose outcomes and times are given; nothing is integrated.
class PaperStudy {
 public:
  PaperStudy(std::size_t series, std::size_t runs, SeriesEnd end) {
    std::vector<double> values;
    for (std::size_t k = 0; k < runs; ++k) values.push_back(std::pow(0.5, static_cast<double>(k + 1)));
    RunSpec spec;
    spec.scene = "kepler";
    const Swept swept = end == SeriesEnd::kAsymptotic ? Swept::kStep : Swept::kTolerances;
    study_.series = std::vector<Series>(series, Series{SeriesRuns(spec, swept, values), end});
  }
  /// Run k of series i takes (i + 1) 2^k seconds, up to a limit, at which it ends with a timeout.
  double secondsOf(std::size_t series, std::size_t run) const {
    return std::min(static_cast<double>(series + 1) * std::pow(2, static_cast<double>(run)), limit);
  }
  SimulatedRun made(const Piece& piece) {
    given.emplace(piece.series, piece.run);
    const double seconds = secondsOf(piece.series, piece.run);
    const bool late = seconds == limit || always_late.contains(piece.run);
    const double error = std::pow(0.5, 4 * static_cast<double>(piece.run));
    return {{std::string(name(late ? Outcome::kTimeout : Outcome::kSuccess)), {error, error, error, error}}, seconds};
  }
  double seconds(int workers) {
    given.clear();
    std::vector<std::size_t> all(study_.series.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    std::set<std::size_t> ended;
    const auto cost = [this](std::size_t i) {
      std::vector<double> costs;
      for (std::size_t run = 0; run < study_.series[i].runs.size(); ++run) costs.push_back(secondsOf(i, run));
      return costs;
    };
    Schedule schedule(study_, all,
                      {cost, [](std::size_t, std::size_t) { return std::optional<RunFacts>(); },
                       [&](std::size_t i) { EXPECT_TRUE(ended.insert(i).second) << "ended twice"; }});
    const double seconds = simulatedSeconds(
        std::move(schedule), [this](const Piece& piece) { return made(piece); }, workers);
    EXPECT_EQ(ended.size(), all.size());
    return seconds;
  }

  double limit = 1e9;
  std::set<std::size_t> always_late;                         // runs of every series
  std::multiset<std::pair<std::size_t, std::size_t>> given;  // series, run

 private:
  Study study_;
};

constexpr int kWorkers[] = {2, 5, 16, 1000};

TEST(Schedule, GivesEachRunOnce) {
  PaperStudy study(20, 6, SeriesEnd::kAll);
  const double serial = study.seconds(1);
  const auto all = study.given;
  EXPECT_EQ(all.size(), 120u);
  for (const int workers : kWorkers) {
    const double seconds = study.seconds(workers);
    EXPECT_EQ(study.given, all) << workers;
    // The longest run first: no worker ends later than the mean by more than a run (Graham 1969).
    const double longest = 20 * 32;
    EXPECT_LE(seconds, std::max(serial / workers * 4 / 3, longest) * (1 + 1e-12)) << workers;
  }
}

// The runs of a planned series depend on errors, not on the number of workers; no run is made in vain.
TEST(Schedule, PlannedSeriesHaveTheRunsOfOneWorker) {
  PaperStudy study(7, 20, SeriesEnd::kAsymptotic);
  study.seconds(1);
  const auto all = study.given;
  EXPECT_GE(all.size(), 7u * 4);
  EXPECT_LT(all.size(), 7u * 20);
  for (const int workers : kWorkers) {
    study.seconds(workers);
    EXPECT_EQ(study.given, all) << workers;
  }
}

TEST(Schedule, SkipsRunsBehindTwoThatTookTooLong) {
  PaperStudy study(3, 10, SeriesEnd::kTooLong);
  study.limit = 100;
  study.always_late = {2};  // one alone skips nothing
  study.seconds(1);
  // Series 0 takes 128 s at run 7, and is skipped after run 8; series 1 and 2 after run 7.
  const auto counting = study.given;
  std::array<std::size_t, 3> runs = {};
  for (const auto& [series, run] : counting) ++runs[series];
  EXPECT_EQ(runs, (std::array<std::size_t, 3>{9, 8, 8}));
  for (const int workers : kWorkers) {
    study.seconds(workers);
    for (const auto& run : counting) EXPECT_EQ(study.given.count(run), 1u) << workers << ": " << run.second;
  }
}

TEST(OpenSeries, CancelsRunsThatDoNotCount) {
  const Study study = parseStudy(
      "[[block]]\nscene = \"kepler\"\nmethods = \"radau_iia_3\"\ntolerances = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6]\n",
      "mine.toml", StudyVariant::kFull);
  OpenSeries series(study.series[0], {1, 1, 1, 1, 1});
  for (std::size_t run = 0; run < 4; ++run) {
    EXPECT_EQ(series.next(), run);
    series.give();
  }
  EXPECT_FALSE(series.cancelled(1)) << "it counts whatever run 0 will be";
  ASSERT_TRUE(series.cancelled(2));
  ASSERT_TRUE(series.cancelled(3));
  series.record(2, {"max_steps"});
  series.record(1, {"timeout"});
  EXPECT_TRUE(*series.cancelled(3));
  EXPECT_FALSE(*series.cancelled(2)) << "run 0 may be good";
  EXPECT_FALSE(series.next());
  EXPECT_FALSE(series.isOver());
  series.record(0, {"timeout"});
  EXPECT_TRUE(*series.cancelled(2));
  EXPECT_TRUE(series.isOver());
}

// Many workers need not wait for the easier runs of a series.
TEST(Schedule, DividesSeries) {
  PaperStudy study(64, 12, SeriesEnd::kTooLong);
  const double serial = study.seconds(1), longest = 64 * 2048;
  EXPECT_GE(serial / (16 * study.seconds(16)), 0.85);
  EXPECT_DOUBLE_EQ(study.seconds(1000), longest);
}

constexpr char kLate[] = R"(
[defaults]
max_steps = 60
tolerances = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]
[[block]]
scene = ["kepler", "van_der_pol"]
configuration = "embedded"
methods = ["radau_iia_2", "radau_iia_3", "radau_iia_5", "gauss_2"]
)";

class SkippedRuns : public StoredRuns {
 protected:
  static std::size_t skippedIn(const Table& runs) {
    return static_cast<std::size_t>(std::count_if(runs.rows.begin(), runs.rows.end(), [&](const auto& row) {
      return textAt(runs, row, "detail").starts_with("not run: ");
    }));
  }
};

TEST_F(SkippedRuns, AreTheSameForAnyNumberOfThreads) {
  const Table one = run("one", {}, kLate);
  ASSERT_EQ(one.rows.size(), 64u);
  EXPECT_GE(skippedIn(one), 8u);
  EXPECT_LE(skippedIn(one), 48u);
  for (const int jobs : {2, 5}) {
    RunnerOptions its = options("jobs_" + std::to_string(jobs));
    its.jobs = jobs;
    const Table many = runStudy(study(kLate), its, told_);
    EXPECT_EQ(skippedIn(many), skippedIn(one));
    expectSame(many, one);
  }
}

// Another worker has made a run before it was known that it does not count.
TEST_F(SkippedRuns, ReplaceRunsThatWereMade) {
  const Table before = run("results", {}, kLate);
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) {
      if (textAt(part, row, "detail").starts_with("not run: ")) row[part.column("detail")] = "longer";
    }
  });
  EXPECT_EQ(skippedIn(readTable(partsOf(folder()).front())), 0u);
  expectSame(run("results", {}, kLate), before);
  EXPECT_EQ(made(), 0);
  EXPECT_EQ(skippedIn(readTable(folder() / "runs.csv")), skippedIn(before));
  EXPECT_EQ(Store(folder(), "small", Use::kRead, {}, told_).runs().size(), 64u);
}

}  // namespace
}  // namespace irk
