#include "tableaus/files/file.h"

#include <filesystem>

#include "core/base/input_file.h"
#include "tableaus/catalogue/report.h"
#include "tests/tableaus/support.h"
#include "tests/temporary_folder.h"

namespace irk {
namespace {

/// A tableau file that lasts as long as the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) : path_(folder_.write("tableau.txt", text)) {}
  const std::string& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

// The refusals below name line numbers of this text.
const std::vector<std::string> kRadau2 = {
    "# Ehle's method",    // 1
    "family: radau_iia",  // 2
    "stages: 2",          // 3
    "order: 3",           // 4
    "stage_order: 2",     // 5
    "",                   // 6
    "A",                  // 7
    "5/12  -1/12",        // 8
    "0.75   +.25",        // 9
    "b",                  // 10
    "75e-2  2.5E-1",      // 11
    "c",                  // 12
    "1/3    1",           // 13
};

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// kRadau2 with some lines replaced; an empty replacement blanks the line.
std::string changed(const std::vector<std::pair<std::size_t, std::string>>& replacements) {
  std::vector<std::string> lines = kRadau2;
  for (const auto& [number, line] : replacements) lines[number - 1] = line;
  return joined(lines);
}

void expectRefused(const std::string& text, int line, const std::string& reason) {
  const TemporaryFile file(text);
  const std::string message = refusal([&] { readTableau(file.path()); });
  EXPECT_TRUE(contains(message, fmt::format("{}:{}: ", file.path(), line)));
  EXPECT_TRUE(contains(message, reason));
}

TEST(File, ReadsFractionsDecimalsAndComments) {
  const TemporaryFile file(joined(kRadau2));
  const auto read = makeTableau<double>(file.path());
  const auto expected = makeTableau<double>("radau_iia_2");
  EXPECT_EQ(read.A, expected.A);
  EXPECT_EQ(read.b, expected.b);
  EXPECT_EQ(read.c, expected.c);
  EXPECT_EQ(read.order, 3);
  EXPECT_EQ(read.stage_order, 2);
}

TEST(File, ReadsForeignLineEndsAndNoLastLineEnd) {
  std::string text;
  for (const std::string& line : kRadau2) text += (text.empty() ? "" : "\r\n") + line;
  EXPECT_EQ(parseTableau(text, "x").tableau.A, parseTableau(joined(kRadau2), "x").tableau.A);
}

TEST(File, LeftOutKeysHaveTheirDefaults) {
  const auto file = parseTableau(changed({{2, ""}, {5, ""}}), "x");
  EXPECT_EQ(file.tableau.family, "user");
  EXPECT_EQ(file.tableau.stage_order, 2);
  EXPECT_EQ(file.digits, 15);
  EXPECT_EQ(parseTableau(changed({{5, ""}}), "x").tableau.stage_order, 2);
}

TEST(File, RefusesEveryWayOfBeingCutShort) {
  for (std::size_t lines = 0; lines < kRadau2.size(); ++lines) {
    const TemporaryFile file(joined({kRadau2.begin(), kRadau2.begin() + static_cast<long>(lines)}));
    const std::string message = refusal([&] { readTableau(file.path()); });
    EXPECT_TRUE(contains(message, fmt::format("{}:{}: cut short", file.path(), std::max<std::size_t>(lines, 1))));
  }
}

TEST(File, RefusesWrongCounts) {
  expectRefused(changed({{8, "5/12"}}), 8, "row 1 of A has 1 numbers, not 2");
  expectRefused(changed({{9, "0.75 0.25 0"}}), 9, "row 2 of A has 3 numbers, not 2");
  expectRefused(changed({{9, ""}}), 10, "block b starts, but row 2 of A is missing");
  expectRefused(changed({{3, "stages: 1"}}), 4, "order: '3' is not a whole number from 1 to 2");
  expectRefused(changed({{3, "stages: 3"}}), 8, "row 1 of A has 2 numbers, not 3");
  expectRefused(changed({{10, "0 0"}}), 10, "block b expected");
  expectRefused(changed({{11, "1"}}), 11, "the row of b has 1 numbers, not 2");
  expectRefused(changed({{13, "1/3 1 1"}}), 13, "the row of c has 3 numbers, not 2");
}

TEST(File, RefusesWhatIsNoFiniteNumber) {
  for (const std::string word :
       {"x", "nan", "inf", "-inf", "1e99999", "1e+", "0x1p3", "1.2.3", "--1", "1/", "/2", "1/2/3", "1,5", "."}) {
    expectRefused(changed({{8, word + " -1/12"}}), 8, "is not a finite number");
  }
  expectRefused(changed({{8, "1/0 -1/12"}}), 8, "divides by zero");
  expectRefused(changed({{8, std::string(5000, '1') + " 0"}}), 8, "is not a finite number");
}

TEST(File, RefusesBadHeaders) {
  expectRefused(changed({{5, "stageorder: 2"}}), 5, "did you mean 'stage_order'");
  expectRefused(changed({{6, "order: 3"}}), 6, "'order' again, first on line 4");
  expectRefused(changed({{5, "A:"}}), 5, "'A:': a block begins with a line 'A' without ':'");
  expectRefused(changed({{5, "hello"}}), 5, "neither 'key: value' nor the start of block A");
  expectRefused(changed({{5, std::string("a\0b\1", 4)}}), 5, "'a?b?' is neither");
  expectRefused(changed({{5, "source:"}}), 5, "'source' has no value");
  expectRefused(changed({{3, ""}}), 7, "no 'stages'");
  expectRefused(changed({{4, ""}}), 7, "no 'order'");
  expectRefused(changed({{3, "stages: two"}}), 3, "not a whole number from 1 to 100");
  expectRefused(changed({{4, "order: 3.5"}}), 4, "not a whole number from 1 to 4");
  expectRefused(changed({{5, "stage_order: -1"}}), 5, "not a whole number from 0 to 2");
  expectRefused(changed({{6, "digits: 3"}}), 6, "not a whole number from 15 to 75");
}

TEST(File, RefusesTrailingGarbage) {
  expectRefused(joined(kRadau2) + "# a comment is welcome\nmore\n", 15, "after the end of block c");
}

TEST(File, RefusesNumbersThatContradictTheHeader) {
  const std::pair<std::size_t, std::string> no_family = {2, ""};
  expectRefused(changed({no_family, {11, "0.7 0.25"}}), 11, "sum of b is 0.95");
  expectRefused(changed({no_family, {9, "0.75 0.2501"}}), 9, "row 2 of A does not sum up");
  expectRefused(changed({no_family, {4, "order: 4"}}), 4, "order 4 is contradicted by B(4)");
  expectRefused(changed({no_family, {8, "4/12 0"}}), 5, "stage order 2 is contradicted by C(2)");
  expectRefused(changed({no_family, {6, "digits: 50"}, {9, "0.75 0.25000000000000000000001"}}), 9, "for 50 digits");
}

TEST(File, RefusesNumbersThatContradictTheFamily) {
  expectRefused(changed({{4, "order: 2"}}), 4, "order 2 is declared, but Radau IIA with 2 stages");
  expectRefused(changed({{5, "stage_order: 1"}}), 5, "stage order 1 is declared, but Radau IIA");
  expectRefused(changed({{2, "family: radau_ia"}, {5, ""}}), 2, "Radau IA has D(2)");
  const std::string euler =
      "stages: 1\norder: 1\nfamily: lobatto_iiic\nstage_order: 1\n"
      "A\n1\nb\n1\nc\n1\n";
  expectRefused(euler, 3, "Lobatto IIIC has 2 to 100 stages, not 1");
}

TEST(File, RefusesWhatCannotBeRead) {
  EXPECT_TRUE(contains(refusal([] { readTableau("missing.txt"); }), "'missing.txt' cannot be read"));
  EXPECT_TRUE(contains(refusal([] { readTableau(testing::TempDir()); }), "is a folder"));
}

TEST(File, RefusesFewerDigitsThanTheScalarHas) {
  const TemporaryFile file(joined(kRadau2));
  EXPECT_TRUE(contains(refusal([&] { makeTableau<BigFloat>(file.path()); }), "add 'digits: 50'"));
  const TemporaryFile exact(changed({{6, "digits: 50"}}));
  EXPECT_EQ(makeTableau<BigFloat>(exact.path()).A, makeTableau<BigFloat>("radau_iia_2").A);
  const WorkingDigits digits(100);
  EXPECT_TRUE(contains(refusal([&] { makeTableau<BigFloat>(exact.path()); }), "100 digits"));
}

TEST(File, ACheckReportsWhatTheReaderRefuses) {
  const TemporaryFile file(changed({{11, "0.7 0.25"}}));
  const auto report = checkTableau(std::string_view(file.path()));
  EXPECT_FALSE(report.ok);
  EXPECT_TRUE(contains(report.text, "CONTRADICTS"));
}

TEST(File, WritingAndReadingKeepsEverything) {
  TableauFile file = constructedFile("lobatto_iiic", 6);
  file.tableau.family = "my own";
  const std::string text = writeTableau(file);
  const TableauFile read = parseTableau(text, file.tableau.id);
  EXPECT_EQ(writeTableau(read), text);
  EXPECT_EQ(read.source, file.source);
  EXPECT_EQ(read.digits, file.digits);
  EXPECT_EQ(read.tableau.family, "my own");
  EXPECT_LT(largestDifference<BigFloat>(read.tableau.A, file.tableau.A), 1e-49);
}

// tableaus/data holds examples of the format; `irk tableau export` writes them.
TEST(Data, FilesEqualTheConstruction) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(IRK_SOURCE_DIR "/tableaus/data")) {
    EXPECT_EQ(readInputFile(entry.path()), exportTableau(entry.path().stem().string(), "file")) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 8);
}

TEST(Data, FilesGiveTheConstructionsDoubles) {
  for (const FamilyEntry& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= 20; s += 3) {
      const std::string id = memberId(family.id, s);
      const TemporaryFile file(exportTableau(id, "file"));
      const auto read = makeTableau<double>(file.path());
      const auto constructed = makeTableau<double>(id);
      EXPECT_EQ(read.A, constructed.A) << id;
      EXPECT_EQ(read.b, constructed.b) << id;
      EXPECT_EQ(read.c, constructed.c) << id;
      EXPECT_EQ(read.order, constructed.order) << id;
    }
  }
}

}  // namespace
}  // namespace irk
