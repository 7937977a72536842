// A clock that is set back changes no decision; and times of other timing classes are not joined.
#include <gtest/gtest.h>

#include "experiments/analyses/results.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class SetBackClock : public StoredRuns {
 protected:
  // As if all that is stored had been written before the clock was set back.
  void setClockBack() const {
    for (const auto& part : partsOf(folder(), "")) {
      Table rows = readPartTable(part);
      for (const char* column : {"date", "first_date"}) {
        if (!rows.hasColumn(column)) continue;
        for (auto& row : rows.rows) row[rows.column(column)] = "2099-01-01T00:00:00Z";
      }
      writePartTable(part, rows);
    }
  }
  std::set<std::string> requests() {
    std::set<std::string> requests;
    for (const auto& row : run().rows) requests.insert(textAt(names_, row, "remade"));
    EXPECT_EQ(made(), 0);
    return requests;
  }
  std::uint64_t anyKey() {
    std::uint64_t key = 0;
    reader().runs().forEach([&key](const store::Entry& entry) { key = entry.key; });
    return key;
  }
  void time(std::uint64_t key, std::size_t repetitions) {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    TableRow row = writer.runs().row(*writer.runs().find(key));
    setTiming(names_, row, {1, 1, 0, std::vector<double>(repetitions, 1.0)});
    writer.addTimes(row);
  }

  const store::StoreOptions fresh_{.finished = store::FinishedRuns::kRunAgain};
  const Table names_{{}, runColumns(), {}};
};

TEST_F(SetBackClock, FreshMakesAllRunsAgain) {
  run();
  for (const char* request : {"1", "2"}) {
    setClockBack();
    run("results", fresh_);
    EXPECT_EQ(made(), 9);
    EXPECT_EQ(requests(), std::set<std::string>{request});
    for (const auto& row : run().rows) EXPECT_LT(textAt(names_, row, "date"), "2099") << "it says when it was written";
  }
}

TEST_F(SetBackClock, EachRepetitionCounts) {
  run();
  const std::uint64_t key = anyKey();
  for (const std::size_t repetitions : {1u, 2u, 3u, 4u, 5u}) {
    setClockBack();
    time(key, repetitions);
    EXPECT_EQ(reader().runs().find(key)->repetitions, repetitions);
  }
}

// Two times by this machine after three by another one.
TEST_F(SetBackClock, FewerTimesOfThisMachineCount) {
  run();
  moveToOtherMachine("results", 9);
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) row[part.column("cpu_runs")] = "3";
  });
  setClockBack();
  const std::uint64_t key = anyKey();
  time(key, 2);
  const Store store = reader();
  EXPECT_EQ(store.runs().find(key)->repetitions, 2);
  EXPECT_TRUE(store.timedHere(*store.runs().find(key)));
}

// The same processor with other flags.
TEST_F(StoredRuns, TimesOfOtherFlagsAreNotJoined) {
  run();
  moveToOther("results", 4, {{"flags", "-O0"}});
  run();
  const std::string refusal = refusedTimes(folder() / "runs.csv");
  EXPECT_TRUE(containsAll(refusal, {"2 timing classes", "-O0", "--times here"})) << refusal;
  const Table here{{}, environmentColumns(), {thisEnvironment()}};
  writeOtherEnvironment("results", {{"libraries", "GSL 9.9; " + textAt(here, here.rows[0], "libraries")}});
  run();
  EXPECT_EQ(refusedTimes(folder() / "runs.csv"), "") << "no run here uses GSL";
}

}  // namespace
}  // namespace irk
