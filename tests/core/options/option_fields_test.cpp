// The table of options: all defaults are legal, and values outside a range are refused.
#include "core/options/option_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "irk/misuse.h"
#include "tests/core/other_values.h"
#include "tests/refusal.h"

namespace irk {
namespace {

TEST(OptionFields, AreNamedOnceAndExplained) {
  std::set<std::string> names;
  for (const auto& field : optionFields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_TRUE(field.meaning.ends_with(".")) << field.name << ": " << field.meaning;
    EXPECT_FALSE(field.allowed().empty()) << field.name;
    EXPECT_TRUE(field.isNumeric() || field.kind == FieldKind::kAxis || field.name == "stop_at") << field.name;
  }
}

// Detects two lines of the table that read or set the same member.
TEST(OptionFields, EachOneReadsBackAndLeavesTheOthersAlone) {
  const IntegratorOptions defaults;
  for (const auto& field : optionFields()) {
    const bool text = field.kind == FieldKind::kText;
    const auto others = text ? std::vector<std::string>{"impact:3"} : otherValues(field);
    ASSERT_FALSE(others.empty()) << field.name;
    for (const auto& value : others) {
      IntegratorOptions changed;
      field.set(changed, value);
      EXPECT_EQ(field.get(changed), value) << field.name;
      EXPECT_NE(value, field.defaultText()) << field.name;
      for (const auto& other : optionFields()) {
        if (other.name == field.name) continue;
        EXPECT_EQ(other.get(changed), other.get(defaults)) << field.name << " changes " << other.name;
      }
    }
  }
}

TEST(OptionFields, NumbersOutOfRangeAreRefusedBySettersAndByValidate) {
  int numbers = 0;
  for (const auto& field : optionFields()) {
    if (!field.isNumeric()) continue;
    ++numbers;
    for (const double x : illegalValues(field.range)) {
      IntegratorOptions options;
      const std::string text = textOf(field, x);
      const std::string by_setter = refusal([&] { field.set(options, text); });
      EXPECT_TRUE(containsAll(by_setter, {field.name, text, field.range.text()})) << field.name;
      EXPECT_EQ(field.get(options), field.defaultText()) << field.name << ": set all the same";
      if (field.kind == FieldKind::kInteger && (!std::isfinite(x) || x != std::floor(x))) continue;  // no such integer
      field.assign(options, x);
      const std::string by_core = refusal([&] { validate(options); });
      EXPECT_TRUE(containsAll(by_core, {field.name, text, field.range.text()})) << field.name;
    }
    for (const double x : legalValues(field.range)) {
      IntegratorOptions options;
      EXPECT_EQ(refusal([&] { field.set(options, textOf(field, x)); }), "") << field.name;
      EXPECT_EQ(refusal([&] { validate(options); }), "") << field.name << " = " << x;
    }
  }
  EXPECT_GT(numbers, 10);
}

TEST(OptionFields, AFixedStepNeedsASize) {
  IntegratorOptions options;
  options.step.control = StepControl::kFixed;
  options.step.estimate = ErrorEstimate::kNone;
  EXPECT_TRUE(containsAll(refusal([&] { validate(options); }), {"fixed", "h = 0", "h > 0"}));
  options.step.h = 0.5;
  EXPECT_EQ(refusal([&] { validate(options); }), "");
}

TEST(Range, TextAgreesWithTheCheck) {
  EXPECT_EQ(Range::from(0).below(1).text(), "0 <= x < 1");
  EXPECT_EQ(Range::above(0).to(1).text(), "0 < x <= 1");
  EXPECT_EQ(Range::above(0).text(), "> 0");
  EXPECT_EQ(Range::from(0.5).text(), ">= 0.5");
  EXPECT_EQ(Range::integers(-1, 1000).text(), "an integer from -1 to 1000");
  EXPECT_EQ(Range::integers(1, 1'000'000'000'000).text(), "an integer from 1 to 1000000000000");
  EXPECT_EQ(Range{}.text(), "a number");
  EXPECT_TRUE(Range::from(0).below(1).contains(0));
  EXPECT_FALSE(Range::from(0).below(1).contains(1));
  EXPECT_FALSE(Range::above(0).to(1).contains(0));
  EXPECT_TRUE(Range::above(0).to(1).contains(1));
  EXPECT_FALSE(Range::integers(1, 9).contains(2.5));
  EXPECT_FALSE(Range{}.contains(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(Range{}.contains(std::nan("")));
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(0.7), "0.7");
  EXPECT_EQ(numberText(1e-6), "1e-06");
  EXPECT_EQ(numberText(1e300), "1e+300");
  EXPECT_EQ(numberText(13), "13");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(numberText(-std::nan("")), "nan");
  for (const double x : {1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789.0}) {
    EXPECT_EQ(parseNumber("x", numberText(x), kAnyNumber), x);
    EXPECT_EQ(std::signbit(parseNumber("x", numberText(x), kAnyNumber)), std::signbit(x));
  }
}

}  // namespace
}  // namespace irk
