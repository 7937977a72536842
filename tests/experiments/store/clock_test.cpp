// A clock that is set back changes no decision; and times of other timing classes are not joined.
#include <gtest/gtest.h>

#include "experiments/analyses/results.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class SetBackClock : public StoredRuns {
 protected:
  // As if all rows had been written before the clock was set back.
  void ageBy(const char* column) const {
    changePart("results", [column](Table& part) {
      for (auto& row : part.rows) row[part.column(column)] = "2099-01-01T00:00:00Z";
    });
  }
};

TEST_F(SetBackClock, FreshMakesAllRunsAgain) {
  run();
  ageBy("remade");
  run("results", {.finished = store::FinishedRuns::kRunAgain});
  EXPECT_EQ(made(), 9);
  const Table names{{}, runColumns(), {}};
  for (const auto& row : run().rows) EXPECT_EQ(textAt(names, row, "remade").substr(0, 19), "2099-01-01T00:00:01");
  EXPECT_EQ(made(), 0);
}

// The times of three repetitions are in a part whose name, and in rows whose dates, are later than those of five.
TEST_F(SetBackClock, NewTimesCount) {
  run();
  const Table names{{}, runColumns(), {}};
  std::uint64_t key = 0;
  reader().runs().forEach([&key](const store::Entry& entry) { key = entry.key; });
  const auto time = [&](std::size_t repetitions) {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    TableRow row = writer.runs().row(*writer.runs().find(key));
    setTiming(names, row, {1, 1, 0, std::vector<double>(repetitions, 1.0)});
    writer.addTimes(row);
  };
  time(3);
  for (const auto& part : partsOf(folder())) {
    Table rows = readPartTable(part);
    for (auto& row : rows.rows) row[rows.column("date")] = "2099-01-01T00:00:00Z";
    writePartTable(part, rows);
  }
  std::filesystem::rename(partsOf(folder()).back(), folder() / "parts" / "runs.later.csv");
  EXPECT_EQ(reader().runs().find(key)->repetitions, 3);
  time(5);
  EXPECT_EQ(reader().runs().find(key)->repetitions, 5);
}

// Two times by this machine in the second in which another machine has written three.
TEST_F(SetBackClock, TimesOfThisMachineCountInTheSameSecond) {
  run();
  const Table names{{}, runColumns(), {}};
  moveToOtherMachine("results", 9);
  std::uint64_t key = 0;
  reader().runs().forEach([&key](const store::Entry& entry) { key = entry.key; });
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) {
      row[part.column("date")] = "2099-01-01T00:00:00Z";
      row[part.column("cpu_runs")] = "3";
    }
  });
  {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    TableRow row = writer.runs().row(*writer.runs().find(key));
    setTiming(names, row, {1, 1, 0, {1, 1}});
    writer.addTimes(row);
  }
  const Store store = reader();
  EXPECT_EQ(store.runs().find(key)->repetitions, 2);
  EXPECT_TRUE(store.timedHere(*store.runs().find(key)));
}

// The same processor with other flags.
TEST_F(StoredRuns, TimesOfOtherFlagsAreNotJoined) {
  run();
  moveToOtherMachine("results", 4);
  Table environments{{}, environmentColumns(), {thisEnvironment()}};
  environments.rows[0][0] = "abc";
  environments.rows[0][environments.column("flags")] = "-O0";
  writePartTable(folder() / "parts" / "environments.0.csv", environments);
  run();
  const std::string refusal = refusedTimes(folder() / "runs.csv");
  EXPECT_TRUE(containsAll(refusal, {"2 timing classes", "-O0", "--times here"})) << refusal;
  environments.rows[0][environments.column("flags")] = thisEnvironment()[environments.column("flags")];
  environments.rows[0][environments.column("libraries")] =
      "GSL 9.9; " + thisEnvironment()[environments.column("libraries")];
  writePartTable(folder() / "parts" / "environments.0.csv", environments);
  run();
  EXPECT_EQ(refusedTimes(folder() / "runs.csv"), "") << "no run here uses GSL";
}

}  // namespace
}  // namespace irk
