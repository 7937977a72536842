#include "irk/tableaus.h"

#include "irk/multiprecision.h"
#include "tableaus/catalogue/constants.h"
#include "tableaus/catalogue/report.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

TEST(Catalogue, ConstantsAreTheConstructionRounded) {
  ASSERT_EQ(familyCatalogue().size(), 8u);
  for (const FamilyEntry& entry : familyCatalogue()) {
    const Family& family = familyOf(entry.id);
    for (Index s = entry.min_stages; s <= kConstantStages + 1; ++s) {
      const auto read = makeTableau<double>(memberId(entry.id, s));
      const auto made = constructFamily(family, s).cast<double>();
      SCOPED_TRACE(made.id);
      EXPECT_EQ(read.id, memberId(entry.id, s));
      EXPECT_EQ(read.family, entry.id);
      EXPECT_EQ(read.order, made.order);
      EXPECT_EQ(made.order, classicalOrder(entry.id, s));
      EXPECT_EQ(read.stage_order, made.stage_order);
      EXPECT_EQ(made.stage_order, stageOrder(entry.id, s));
      EXPECT_EQ(read.A, made.A);
      EXPECT_EQ(read.b, made.b);
      EXPECT_EQ(read.c, made.c);
    }
  }
}

TEST(Catalogue, OrderTextsAgreeWithOrders) {
  for (const FamilyEntry& family : familyCatalogue()) {
    const int gap = 2 * 7 - classicalOrder(family.id, 7);
    EXPECT_EQ(family.order, gap == 0 ? "2s" : "2s-" + std::to_string(gap)) << family.id;
  }
}

TEST(Catalogue, FilesAreRecognizedByTheirName) {
  const std::string path = IRK_SOURCE_DIR "/tableaus/data/radau_iia_4.txt";
  EXPECT_EQ(makeTableau<double>(path).A, makeTableau<double>("radau_iia_4").A);
  EXPECT_EQ(makeTableau<double>(path).id, path);
}

TEST(Report, ShowsTheTableau) {
  EXPECT_EQ(showTableau("lobatto_iiia_2", 5),
            "lobatto_iiia_2: family lobatto_iiia, 2 stages, order 2, stage order 2\n"
            "0 |    0    0\n"
            "1 |  0.5  0.5\n"
            "--+----------\n"
            "  |  0.5  0.5\n");
  EXPECT_TRUE(contains(refusal([] { showTableau("gauss_2", 0); }), "1 to 75"));
}

TEST(Report, ChecksAnId) {
  const auto report = checkTableau("radau_iia_3");
  EXPECT_TRUE(report.ok);
  EXPECT_TRUE(contains(report.text, "order 5 is proven by B, C, D"));
  EXPECT_TRUE(contains(report.text, "agrees with its declarations"));
}

}  // namespace
}  // namespace irk
