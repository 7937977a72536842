// The store of results never loses finished runs, whoever writes and whatever is damaged.
#include "experiments/store/store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "experiments/base/numbers.h"
#include "tests/experiments/stored_runs.h"
#include "tests/refusal.h"

namespace irk {
namespace {

class Results : public StoredRuns {};

// --- One row per line.

TEST(Part, SecondsOfADate) {
  EXPECT_EQ(store::secondsOf("1970-01-02T00:00:01Z"), 86401u);
  EXPECT_EQ(store::secondsOf("2024-02-29T12:34:56Z"), 1709210096u);  // date -ud 2024-02-29T12:34:56 +%s
  EXPECT_EQ(store::secondsOf(""), 0u);
}

TEST_F(Results, OneDamagedLineCostsOneRow) {
  const Table whole = run();
  const auto part = partsOf(folder()).front();
  std::vector<std::string> lines;
  std::istringstream in(readInputFile(part));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 10u);
  const auto key = [&](std::size_t line) { return lines[line].substr(0, 16); };
  const std::set<std::string> lost{key(2), key(5), key(9)};
  lines[2].insert(40, "\"");
  lines[5] += ",one cell more";
  lines[9].resize(50);
  {
    std::ofstream out(part, std::ios::binary);
    for (std::size_t i = 0; i < 9; ++i) out << lines[i] << '\n';
    out << lines[9];
  }
  // Reading changes nothing.
  EXPECT_EQ(reader().runs().size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(part.parent_path() / (part.stem().string() + ".damaged")));

  expectSame(run(), whole);
  EXPECT_TRUE(containsAll(
      told_.str(), {"3 rows cannot be read (lines 3, 6: its checksum is wrong; 10: it has no line end)", ".damaged"}));
  EXPECT_EQ(made(), 3);
  auto aside = part;
  aside.replace_extension(".damaged");
  EXPECT_TRUE(
      containsAll(readInputFile(aside), {"line 3: " + lines[2], "line 6: " + lines[5], "line 10: " + lines[9]}));
  EXPECT_EQ(keysOf(readTable(partsOf(folder()).back())), lost) << "nothing else is made again";
  run();
  EXPECT_EQ(told_.str().find("cannot be read"), std::string::npos) << "it is said once";
}

TEST_F(Results, PartsOfAnotherVersionStay) {
  run();
  const auto other = folder() / "parts" / "runs.0.csv";
  writePartTable(other, {{}, {"key", "scene"}, {{"1", "kepler"}}});
  const auto before = readInputFile(other);
  EXPECT_EQ(run().rows.size(), 9u);
  EXPECT_TRUE(containsAll(told_.str(), {other.string(), "columns"}));
  EXPECT_EQ(made(), 0);
  EXPECT_EQ(readInputFile(other), before);
}

std::vector<store::Entry> entriesOf(const Store& store) {
  std::vector<store::Entry> entries;
  store.runs().forEach([&entries](const store::Entry& entry) { entries.push_back(entry); });
  return entries;
}

bool isBefore(const store::Entry& a, const store::Entry& b) { return a.offset < b.offset; }
bool hasLowerKey(const store::Entry& a, const store::Entry& b) { return a.key < b.key; }

// In any order of reading, an exported row is its line: the same as that of its cells.
TEST_F(Results, RowsAreExportedAsTheyAreWritten) {
  run();
  changePart("results", [](Table& part) {
    part.rows[1][part.column("detail")] = "say \"x\", twice";
    part.rows[4][part.column("detail")] = std::string(100'000, ',');  // longer than what is read at once
    part.rows[8].back() = "\"";
  });
  const std::string text = readInputFile(partsOf(folder()).front());
  const Store store = reader();
  auto entries = entriesOf(store);
  ASSERT_EQ(entries.size(), 9u);
  EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end(), isBefore));
  for (const std::string order : {"of the file", "of keys", "backwards"}) {
    SCOPED_TRACE(order);
    if (order == "of keys") std::sort(entries.begin(), entries.end(), hasLowerKey);
    if (order == "backwards") std::sort(entries.rbegin(), entries.rend(), isBefore);
    for (const auto& entry : entries) {
      const std::string line = text.substr(entry.offset, text.find('\n', entry.offset) - entry.offset);
      EXPECT_EQ(store::sealedRow(store.runs().csv(entry)), line);
      EXPECT_EQ(csvLine(store.runs().row(entry)), store.runs().csv(entry));
    }
  }
}

TEST_F(Results, RowsThatChangedSinceTheyWereReadAreNotExported) {
  run();
  const auto part = partsOf(folder()).front();
  const std::string text = readInputFile(part);
  const auto write = [&part](const std::string& its) { std::ofstream(part, std::ios::binary) << its; };
  const Store changed = reader(), cut = reader();
  const auto last = entriesOf(changed).back();
  std::string other = text;
  other[last.offset + 20] ^= 1;
  write(other);
  EXPECT_TRUE(containsAll(failureOf([&] { (void)changed.runs().csv(last); }), {"changed since it was read"}));
  write(text.substr(0, last.offset + 20));
  EXPECT_TRUE(containsAll(failureOf([&] { (void)cut.runs().csv(last); }), {"shorter than before"}));
}

// --- Rows are only appended.

TEST_F(Results, AStudyEditedAndEditedBackFindsItsRuns) {
  const Table first = run();
  const std::string edited = R"(
[[block]]
scene = "kepler"
t_end = 0.5
methods = ["gauss_2"]
tolerances = [1e-5, 1e-6]
)";
  const Table other = run("results", {}, edited);
  ASSERT_EQ(other.rows.size(), 2u);
  EXPECT_EQ(made(), 1);
  EXPECT_EQ(run().rows, first.rows);
  EXPECT_EQ(made(), 0);
}

TEST_F(Results, NothingToDoWritesNoPart) {
  run();
  const auto parts = partsOf(folder(), "").size();
  run();
  EXPECT_EQ(partsOf(folder(), "").size(), parts);
}

TEST_F(Results, TheExportIsInTheStudysOrderWhateverThatOfTheParts) {
  const Table first = run();
  changePart("results", [](Table& part) { std::reverse(part.rows.begin(), part.rows.end()); });
  EXPECT_EQ(run().rows, first.rows);
}

// --- Tables without parts.

TEST_F(Results, ATableWithoutPartsIsRefused) {
  run();
  const auto table = folder() / "runs.csv";
  const std::string before = readInputFile(table);
  for (const auto& part : partsOf(folder())) std::filesystem::remove(part);
  for (const auto& made : {refusal([this] { run(); }), refusal([this] { reader(); })}) {
    EXPECT_TRUE(containsAll(made, {table.string(), "without its parts", "copy the whole folder", "remove the table"}))
        << made;
  }
  EXPECT_EQ(readInputFile(table), before);
  std::filesystem::remove(table);
  EXPECT_EQ(run().rows.size(), 9u);
}

// An interrupt before the end of the first run leaves a table without rows.
TEST_F(Results, ATableWithoutRowsNeedsNoParts) {
  Table runs = run();
  std::filesystem::remove_all(folder() / "parts");
  runs.rows.clear();
  writeTable(folder() / "runs.csv", runs);
  EXPECT_EQ(run().rows.size(), 9u);
}

}  // namespace
}  // namespace irk
