// Values that a process keeps.
#include "core/base/kept.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/linear/block_form.h"
#include "core/stages/scheme.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

TEST(Kept, MakesAValueOncePerKey) {
  Kept<int> kept;
  int made = 0;
  const auto make = [&] { return ++made; };
  EXPECT_EQ(*kept.of("a", make), 1);
  EXPECT_EQ(*kept.of("b", make), 2);
  EXPECT_EQ(*kept.of("a", make), 1);
  EXPECT_EQ(made, 2);
}

TEST(Kept, ValuesOutliveTheirPlace) {
  Kept<std::string> kept;
  const auto first = kept.of("first", [] { return std::string("value"); });
  for (int i = 0; i < 1200; ++i) static_cast<void>(kept.of(std::to_string(i), [] { return std::string("other"); }));
  EXPECT_EQ(*first, "value");
  EXPECT_EQ(*kept.of("first", [] { return std::string("made anew"); }), "made anew");
}

TEST(Kept, KeepsNothingAfterAnException) {
  Kept<int> kept;
  EXPECT_THROW(static_cast<void>(kept.of("a", []() -> int { throw std::runtime_error("not made"); })),
               std::runtime_error);
  EXPECT_EQ(*kept.of("a", [] { return 7; }), 7);
}

// A file may have the id and the numbers of a family's member, but for one of them.
TEST(Kept, SchemesDifferWhereAnythingInTheTableauDiffers) {
  const Tableau<double> tableau = makeTableau<double>("radau_iia_3");
  const auto scheme = schemeOf(tableau);
  EXPECT_EQ(schemeOf(tableau), scheme);
  const auto expectOther = [&](const auto& change) {
    Tableau<double> other = tableau;
    change(other);
    const auto made = schemeOf(other);
    EXPECT_NE(made, scheme);
    EXPECT_EQ(made->tableau.id, other.id);
    EXPECT_EQ(made->tableau.family, other.family);
    EXPECT_EQ(made->tableau.order, other.order);
    EXPECT_EQ(made->tableau.stage_order, other.stage_order);
    EXPECT_EQ(made->A, other.A);
    EXPECT_EQ(made->b, other.b);
    EXPECT_EQ(made->c, other.c);
  };
  expectOther([](Tableau<double>& t) { t.id = "mine"; });
  expectOther([](Tableau<double>& t) { t.family = "user"; });
  expectOther([](Tableau<double>& t) { t.order = 4; });
  expectOther([](Tableau<double>& t) { t.stage_order = 2; });
  expectOther([](Tableau<double>& t) { t.A(2, 0) += 1e-15; });
  expectOther([](Tableau<double>& t) { t.b[1] += 1e-15; });
  expectOther([](Tableau<double>& t) { t.c[0] += 1e-15; });
}

TEST(Kept, StructuresFollowTheCoefficients) {
  Tableau<double> tableau = makeTableau<double>("gauss_2");
  const auto structure = structureOf(tableau);
  EXPECT_TRUE(structure->regular);
  EXPECT_EQ(structureOf(tableau), structure);
  tableau.A.row(1) = tableau.A.row(0);
  EXPECT_FALSE(structureOf(tableau)->regular);
}

TEST(Kept, FormsAreShared) {
  const Mat<double> A = makeTableau<double>("radau_iia_4").A;
  EXPECT_EQ(schurForm(A), schurForm(A));
  EXPECT_EQ(eigenForm(A), eigenForm(A));
}

TEST(Kept, SchemesOfManyStagesAreNotKept) {
  const Tableau<double> most = makeTableau<double>("gauss_30"), more = makeTableau<double>("gauss_31");
  ASSERT_EQ(most.stages(), kMostKeptStages);
  EXPECT_EQ(schemeOf(most), schemeOf(most));
  EXPECT_NE(schemeOf(more), schemeOf(more));
  EXPECT_EQ(schemeOf(more)->A, more.A);
}

}  // namespace
}  // namespace irk::test
