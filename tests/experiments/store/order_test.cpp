// Which of several rows of one run is valid: within a store, of writers that do not see each other, and after a merge.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "experiments/base/numbers.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class Order : public StoredRuns {
 protected:
  using Changes = std::map<std::string, std::string>;
  void SetUp() override {
    made_ = run().rows.front();
    made_.resize(runColumns().size());  // parts have no column of blocks
  }
  TableRow row(const Changes& changes) const {
    TableRow changed = made_;
    for (const auto& [column, value] : changes) changed[names_.column(column)] = value;
    return changed;
  }
  // The valid row in a folder with these parts.
  TableRow validOf(const std::map<std::string, TableRow>& parts) {
    const auto tree = folder_.path() / fmt::format("tree{}", trees_++);
    for (const auto& [name, its] : parts) writePartTable(tree / "parts" / name, {{}, runColumns(), {its}});
    return validIn(tree);
  }
  TableRow validIn(const std::filesystem::path& tree) {
    const Store read(tree, "small", Use::kRead, {}, told_);
    return read.runs().row(*read.runs().find(store::keyNumber(made_.front())));
  }
  std::filesystem::path treeOf(const TableRow& its) {
    auto tree = folder_.path() / fmt::format("tree{}", trees_++);
    writePartTable(tree / "parts" / "runs.0001.host.1.csv", {{}, runColumns(), {its}});
    return tree;
  }
  // The valid row after the folders are merged in this order.
  TableRow mergedOf(const std::vector<std::filesystem::path>& trees) {
    const auto into = folder_.path() / fmt::format("tree{}", trees_++);
    for (const auto& tree : trees) merge(tree, into);
    return validIn(into);
  }
  std::size_t merge(const std::filesystem::path& from, const std::filesystem::path& into) {
    Store to(into, "small", Use::kWrite, {}, told_);
    return to.takeOver(Store(from, "small", Use::kRead, {}, told_));
  }
  std::string code() const { return made_[names_.column("code")]; }

  TableRow made_;
  const Table names_{{}, runColumns(), {}};
  int trees_ = 0;
};

constexpr const char *kEarly = "2020-01-01T00:00:00Z", *kLate = "2021-01-01T00:00:00Z";

TEST_F(Order, OfCodeRequestAndTimes) {
  const std::vector<std::pair<TableRow, TableRow>> ranked = {
      {row({{"date", kEarly}}), row({{"code", "other"}, {"remade", "9"}, {"cpu_runs", "3"}})},
      {row({{"remade", "2"}}), row({{"remade", "1"}, {"cpu_runs", "3"}, {"date", kLate}})},
      {row({{"remade", "10"}}), row({{"remade", "9"}, {"date", kLate}})},
      {row({{"cpu_runs", "1"}, {"date", kEarly}}), row({{"cpu_runs", "0"}, {"date", kLate}})}};
  for (const auto& [better, worse] : ranked) {
    EXPECT_EQ(validOf({{"runs.0001.host.1.csv", better}, {"runs.0002.host.1.csv", worse}}), better);
    EXPECT_EQ(validOf({{"runs.0001.host.1.csv", worse}, {"runs.0002.host.1.csv", better}}), better);
    const auto one = treeOf(better), other = treeOf(worse);
    EXPECT_EQ(mergedOf({one, other}), better);
    EXPECT_EQ(mergedOf({other, one}), better);
  }
}

// Whatever their dates say, and how often they were timed.
TEST_F(Order, OfPartsIsThatOfTheirNumbers) {
  const TableRow early = row({{"cpu_runs", "1"}, {"date", kEarly}}), late = row({{"cpu_runs", "3"}, {"date", kLate}});
  EXPECT_EQ(validOf({{"runs.0001.z.7.csv", late}, {"runs.0002.a.7.csv", early}}), early);
  EXPECT_EQ(validOf({{"runs.9999.z.7.csv", late}, {"runs.10000.a.7.csv", early}}), early);
  EXPECT_EQ(validOf({{"runs.0003.a.7.csv", late}, {"runs.0003.b.7.csv", early}}), early) << "one of them must count";
}

TEST_F(Order, AWriterComesAfterAllThatItHasRead) {
  std::vector<std::string> names;
  const auto write = [&](store::Rows& rows, const char* date) {
    rows.append(row({{"date", date}}));
    EXPECT_EQ(rows.row(*rows.find(store::keyNumber(made_.front()))), row({{"date", date}})) << "in its own memory";
  };
  const auto tree = folder_.path() / "writers";
  const auto open = [&] {
    auto rows = std::make_unique<store::Rows>(tree, "runs", runColumns(), code());
    rows->read(store::Rows::Damage::kReport, told_);
    return rows;
  };
  {
    const auto one = open(), other = open();  // neither sees the other's part
    write(*one, "2099-01-01T00:00:00Z");
    write(*other, "2099-01-01T00:00:01Z");
  }
  for (const char* date : {kLate, kEarly}) {
    write(*open(), date);
    EXPECT_EQ(validIn(tree), row({{"date", date}})) << "read again";
  }
  const auto parts = store::partsInOrder(tree / "parts", "runs");
  std::vector<std::uint64_t> numbers;
  for (const auto& part : parts) numbers.push_back(store::numberOfPart(part));
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 1, 2, 3}));
  EXPECT_EQ(rowsInParts(tree), 4) << "nothing is lost";
}

// The order of rows in two folders is not known.
TEST_F(Order, OfFoldersIsByRepetitionsThenTheFirst) {
  const TableRow few = row({{"cpu_runs", "3"}, {"date", kLate}}), many = row({{"cpu_runs", "5"}, {"date", kEarly}});
  const auto one = treeOf(few), other = treeOf(many), third = treeOf(row({{"cpu_runs", "3"}, {"date", kEarly}}));
  EXPECT_EQ(mergedOf({one, other}), many);
  EXPECT_EQ(mergedOf({other, one}), many);
  EXPECT_EQ(mergedOf({one, third}), few);
  EXPECT_EQ(merge(other, one), 1u);
  EXPECT_EQ(merge(other, one), 0u) << "it is there";
  EXPECT_EQ(validIn(one), many);
}

TEST_F(Order, OfFoldersPrefersARunThatHadTimeEnough) {
  const TableRow ended = row({{"outcome", "success"}}), late = row({{"outcome", "timeout"}});
  EXPECT_EQ(mergedOf({treeOf(late), treeOf(ended)}), ended);
  EXPECT_EQ(mergedOf({treeOf(ended), treeOf(late)}), ended);
}

TEST_F(Order, OfStatesIsThatOfTheirRuns) {
  const std::string key = made_.front();
  const auto store = [&](const char* name, const char* state, const Changes& changes) {
    const auto tree = folder_.path() / name;
    Store writer(tree, "small", Use::kWrite, {}, told_);
    writer.addState(key, state, "");
    writer.addRun(row(changes));
    return tree;
  };
  const auto timed = store("timed", "1", {{"cpu_runs", "3"}}), untimed = store("untimed", "2", {});
  for (const auto& trees : {std::pair(timed, untimed), std::pair(untimed, timed)}) {
    const auto into = folder_.path() / fmt::format("tree{}", trees_++);
    merge(trees.first, into);
    merge(trees.second, into);
    const auto states = store::partsInOrder(into / "parts", "states");
    EXPECT_EQ(readPartTable(states.back()).rows.back()[1], "1");
  }
}

// A run that is made again for another reason, as for its state, replaces a row that a --fresh has asked for.
TEST_F(Order, ARowAfterARequestCounts) {
  run("results", {.finished = store::FinishedRuns::kRunAgain});
  {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    writer.addRun(row({{"detail", "again"}}));
  }
  EXPECT_EQ(validIn(folder()), row({{"detail", "again"}, {"remade", "1"}}));
}

}  // namespace
}  // namespace irk
