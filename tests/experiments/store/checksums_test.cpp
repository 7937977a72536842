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
  // Writes the part of runs as a former version did, without checksums.
  void unseal(const std::function<void(Table&)>& change) const {
    const auto part = partsOf(folder()).front();
    Table table = readPartTable(part);
    change(table);
    writeTable(part, table);
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
  EXPECT_EQ(store::sealedRow("0123456789abcdef,1,2"), "0123456789abcdef,1,2,b3ef5dfe998142cc");
  EXPECT_EQ(store::sealedNames("key,a,b"), "key,a,b,checksum:94c8b010713b2415");
}

TEST(Checksum, SealsLines) {
  std::string_view row = "a,\"b,c\",and more than two words";
  const std::string sealed = store::sealedRow(row);
  std::string_view read = sealed;
  EXPECT_EQ(store::checkRow(read), store::Seal::kRight);
  EXPECT_EQ(read, row);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = sealed;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      std::string_view its = flipped;
      EXPECT_NE(store::checkRow(its), store::Seal::kRight) << flipped;
    }
  }
  const std::string names = store::sealedNames("key,a");
  std::string_view header = names, plain = "key,a";
  EXPECT_EQ(store::checkNames(header), store::Seal::kRight);
  EXPECT_EQ(header, "key,a");
  EXPECT_EQ(store::checkNames(plain), store::Seal::kNone);
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

TEST_F(Checksums, DamagedNamesAreToldFromThoseOfAnotherVersion) {
  const Table whole = run();
  const auto part = partsOf(folder()).front();
  std::string changed = readInputFile(part);
  changed[changed.find("outcome")] ^= 1;
  write(part, changed);
  expectSame(run(), whole);
  EXPECT_EQ(made(), 9);
  EXPECT_TRUE(containsAll(told_.str(), {part.filename().string(), "column names is damaged"}));
}

// --- Parts of a version without checksums.

TEST_F(Checksums, FormerPartsAreReadAndTold) {
  const Table whole = run();
  unseal([](Table&) {});
  EXPECT_EQ(run().rows, whole.rows);
  EXPECT_EQ(made(), 0);
  EXPECT_TRUE(containsAll(told_.str(), {"1 of its parts", "no checksums", "irk merge"}));
}

TEST_F(Checksums, CellsOfFormerPartsHaveTheirKinds) {
  const Table whole = run();
  const std::pair<const char*, const char*> illegal[] = {
      {"outcome", "succeUs"}, {"newton_iterations", "3p"}, {"error", "0.00x"}, {"cpu_all", "1 2 b"},
      {"date", "2026-13-"},   {"environment", "no hash"},  {"stages", "-2"},   {"key", "0123456789abcdeg"}};
  for (const auto& [column, cell] : illegal) {
    SCOPED_TRACE(column);
    std::filesystem::remove_all(folder());
    run();
    unseal([&](Table& part) { part.rows[3][part.column(column)] = cell; });
    expectSame(run(), whole);
    EXPECT_EQ(made(), 1);
    EXPECT_TRUE(containsAll(told_.str(), {"lines 5", column, cell, "set aside"}));
  }
}

// --- The key is that of the row's settings.

TEST_F(Checksums, RowsThatSwapTheirKeysAreMadeAgain) {
  const Table whole = run();
  for (const bool sealed : {true, false}) {
    std::filesystem::remove_all(folder());
    run();
    const auto swapKeys = [](Table& part) { std::swap(part.rows[1][0], part.rows[7][0]); };
    if (sealed) {
      changePart("results", swapKeys);
    } else {
      unseal(swapKeys);
    }
    EXPECT_EQ(run().rows.size(), 7u);
    EXPECT_TRUE(containsAll(told_.str(), {"line 3", "line 9", "key is not that of its settings", "next irk run"}));
    expectSame(run(), whole);
    EXPECT_EQ(made(), 2);
    run();
    EXPECT_EQ(made(), 0);
    EXPECT_EQ(told_.str().find("settings"), std::string::npos);
  }
}

TEST_F(Checksums, AChangedSettingIsFound) {
  const Table whole = run();
  unseal([](Table& part) {
    part.rows[0][part.column("t_end")] = "9";
    part.rows[4][part.column("method")] = "gauss_22";
  });
  EXPECT_EQ(run().rows.size(), 7u);
  expectSame(run(), whole);
  EXPECT_EQ(made(), 2);
}

}  // namespace
}  // namespace irk
