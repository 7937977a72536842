// A changed byte in a part is found: the row is set aside, told, and made again.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "experiments/base/numbers.h"
#include "experiments/store/checksum.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class Checksums : public StoredRuns {
 protected:
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
};

constexpr char kFewRuns[] = R"(
[[block]]
scene = "kepler"
t_end = 0.5
methods = ["radau_iia_2", "gauss_2"]
tolerances = [1e-3, 1e-4]
)";

// The same on every machine: stored rows depend on it.
TEST(Checksum, StaysAsItIs) {
  EXPECT_EQ(store::sealedRow("0123456789abcdef,1,2"), "0123456789abcdef,1,2,8ba1c013b5dc5774");
  EXPECT_EQ(store::sealedNames("key,a,b"), "key,a,b,checksum:1291dfad0a09579d");
}

TEST(Checksum, SealsLines) {
  std::string_view row = "a,\"b,c\",and more than two words";
  const std::string sealed = store::sealedRow(row);
  std::string_view read = sealed;
  EXPECT_TRUE(store::checkRow(read));
  EXPECT_EQ(read, row);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = sealed;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      std::string_view its = flipped;
      EXPECT_FALSE(store::checkRow(its)) << flipped;
    }
  }
  const std::string names = store::sealedNames("key,a");
  std::string_view header = names, plain = "key,a";
  EXPECT_TRUE(store::checkNames(header));
  EXPECT_EQ(header, "key,a");
  EXPECT_FALSE(store::checkNames(plain));
}

// Flips bytes of all kinds of parts, one at a time: none of them goes unsaid, and no table is exported with it.
TEST_F(Checksums, NoFlippedByteIsSilent) {
  constexpr int kFlips = 200;
  Study with_states = study(kFewRuns);
  with_states.states = true;
  runStudy(with_states, options(), told_);
  {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    for (int i = 0; i < 3; ++i) writer.addCalibration(1e-3 * (1 + i));
  }
  std::vector<std::filesystem::path> parts;
  for (const char* kind : {"runs", "states", "environments", "calibrations"}) {
    const auto its = partsOf(folder(), kind);
    ASSERT_FALSE(its.empty()) << kind;
    parts.insert(parts.end(), its.begin(), its.end());
  }
  std::mt19937 random(45);
  int silent = 0;
  for (int i = 0; i < kFlips; ++i) {
    const auto& part = parts[random() % parts.size()];
    const std::string text = readInputFile(part);
    std::string flipped = text;
    const std::size_t at = random() % flipped.size();
    flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ (1 + random() % 255));
    write(part, flipped);
    std::ostringstream told;
    const Store read(folder(), "small", Use::kRead, {}, told);
    if (told.str().find(part.filename().string()) == std::string::npos) ++silent;
    write(part, text);
  }
  EXPECT_EQ(silent, 0);
}

TEST_F(Checksums, AChangedRowIsMadeAgain) {
  const Table whole = run();
  const auto part = partsOf(folder()).front();
  const std::string text = readInputFile(part);
  std::string changed = text;
  changed[changed.find("success") + 6] = 'S';
  write(part, changed);
  expectSame(run(), whole);
  EXPECT_EQ(made(), 1);
  EXPECT_TRUE(containsAll(told_.str(), {part.filename().string(), "lines 2", "checksum", "set aside"}));
  run();
  EXPECT_EQ(told_.str().find("checksum"), std::string::npos) << "it is said once";
  EXPECT_EQ(made(), 0);
}

// A damaged line of names, and a part whose lines have no checksums: its rows are made again, and it stays as it is.
TEST_F(Checksums, NamesWithoutTheirChecksumCostThePart) {
  const Table whole = run();
  const auto part = partsOf(folder()).front();
  std::string damaged = readInputFile(part);
  damaged[damaged.find("outcome")] ^= 1;
  const Table table = readPartTable(part);
  std::string plain = csvLine(table.columns) + '\n';
  for (const auto& row : table.rows) plain += csvLine(row) + '\n';
  for (const auto& text : {damaged, plain}) {
    std::filesystem::remove_all(folder());
    run();
    write(part, text);
    expectSame(run(), whole);
    EXPECT_EQ(made(), 9);
    EXPECT_TRUE(containsAll(told_.str(), {part.filename().string(), "column names has no checksum, or a wrong one"}));
    EXPECT_EQ(readInputFile(part), text);
  }
}

}  // namespace
}  // namespace irk
