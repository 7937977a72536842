// Ids of tableaus that do not exist.
#include <gtest/gtest.h>

#include "irk/multiprecision.h"
#include "irk/tableaus.h"
#include "tests/misuse_table.h"

namespace irk::test {
namespace {

std::function<void()> tableau(const char* id) {
  return [id] { (void)makeTableau<double>(id); };
}
std::function<void()> methods(const char* id, Index max_stages, Index first = 3) {
  return [=] { (void)makeMethods<double>(id, max_stages, first); };
}

TEST(TableauMisuse, IdsAndNumbersOfStagesAreChecked) {
  expectRefusals({
      {"nothing", "unknown tableau ''", tableau("")},
      {"a family", "tableau 'gauss' lacks its number of stages: gauss_1 to gauss_100", tableau("gauss")},
      {"an unknown family", "did you mean 'gauss_3'?", tableau("gaus_3")},
      {"no stages", "'0' stages, but gauss has 1 to 100", tableau("gauss_0")},
      {"too many", "'101' stages, but gauss has 1 to 100", tableau("gauss_101")},
      {"too few", "'1' stages, but lobatto_iiia has 2 to 100", tableau("lobatto_iiia_1")},
      {"a sign", "'-1' stages, but gauss has 1 to 100", tableau("gauss_-1")},
      {"another number", "'03' stages, but gauss has", tableau("gauss_03")},
      {"beyond any integer", "stages, but gauss has 1 to 100", tableau("gauss_99999999999999999999")},
      {"a fraction", "'2.5' stages, but radau_iia has 1 to 100", tableau("radau_iia_2.5")},
      {"an empty number", "'' stages, but radau_iia has 1 to 100", tableau("radau_iia_")},
      {"a family with a typing error", "did you mean 'radau_iia_5'?", tableau("raudau_iia_5")},
      {"one without a number", "did you mean 'lobatto_iiib_S'?", tableau("lobato_iiib")},
      {"no file", "'no_such_tableau.txt' cannot be read", tableau("no_such_tableau.txt")},
      {"no file in a folder", "'missing/gauss_3' cannot be read", tableau("missing/gauss_3")},
      {"a folder", "is a folder", tableau("/")},
      {"in 50 digits", "'0' stages, but gauss has 1 to 100", [] { (void)makeTableau<BigFloat>("gauss_0"); }},
      {"max_stages", "max_stages = 0: 1 to 100 is expected", methods("radau_iia", 0)},
      {"max_stages of a member", "max_stages = -3: 1 to 100 is expected", methods("radau_iia_3", -3)},
      {"max_stages, many", "max_stages = 101: 1 to 100 is expected", methods("radau_iia", 101)},
      {"a family", "unknown tableau 'radau'", methods("radau", 5)},
      {"a member", "'0' stages, but radau_iia has", methods("radau_iia_0", 5)},
      {"orders of a family", "unknown tableau family 'gaus'; did you mean 'gauss'?",
       [] { (void)classicalOrder("gaus", 2); }},
      {"orders of no stages", "0 stages, but gauss has 1 to 100", [] { (void)classicalOrder("gauss", 0); }},
      {"orders of one stage", "1 stages, but lobatto_iiic has 2 to 100", [] { (void)stageOrder("lobatto_iiic", 1); }},
      {"orders of many stages", "101 stages, but gauss has 1 to 100", [] { (void)stageOrder("gauss", 101); }},
  });
  EXPECT_EQ(refusal(methods("radau_iia", 5, -7)), "") << "`first` counts as the nearest member";
}

}  // namespace
}  // namespace irk::test
