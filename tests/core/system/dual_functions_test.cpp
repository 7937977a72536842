// Derivatives of the elementary functions of dual numbers against differences in 50 digits.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "irk/dual.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class T>
struct Function {
  std::string name;
  std::function<T(const T&)> f;
};

template <class T>
std::vector<Function<T>> functions() {
  using std::acos, std::asin, std::atan, std::atan2, std::cbrt, std::ceil, std::cosh, std::expm1, std::fabs, std::floor,
      std::fmod, std::hypot, std::log1p, std::pow, std::sinh, std::tan;
  return {{"tan", [](const T& x) { return T(tan(x)); }},
          {"asin", [](const T& x) { return T(asin(x)); }},
          {"acos", [](const T& x) { return T(acos(x)); }},
          {"atan", [](const T& x) { return T(atan(x)); }},
          {"sinh", [](const T& x) { return T(sinh(x)); }},
          {"cosh", [](const T& x) { return T(cosh(x)); }},
          {"expm1", [](const T& x) { return T(expm1(x)); }},
          {"log1p", [](const T& x) { return T(log1p(x)); }},
          {"cbrt", [](const T& x) { return T(cbrt(x)); }},
          {"power 2.5", [](const T& x) { return T(pow(x, 2.5)); }},
          {"power 3", [](const T& x) { return T(pow(x, 3)); }},
          {"power x", [](const T& x) { return T(pow(x, x)); }},
          {"2 to the x", [](const T& x) { return T(pow(T(2), x)); }},
          {"atan2(x, 1 - x)", [](const T& x) { return T(atan2(x, T(T(1) - x))); }},
          {"atan2(x, -1)", [](const T& x) { return T(atan2(x, T(-1))); }},
          {"fabs(x^2 - x)", [](const T& x) { return T(fabs(T(x * x - x))); }},
          {"x floor(5 x)", [](const T& x) { return T(x * floor(T(5.0 * x))); }},
          {"x ceil(-5 x)", [](const T& x) { return T(x * ceil(T(-5.0 * x))); }},
          {"fmod(x^2, 0.25)", [](const T& x) { return T(fmod(T(x * x), 0.25)); }},
          {"fmod(-x^2, 0.25)", [](const T& x) { return T(fmod(T(-x * x), 0.25)); }},
          {"hypot(x, x^2)", [](const T& x) { return T(hypot(x, T(x * x))); }}};
}

// (f(x + h) - f(x - h)) / 2 h in 50 digits: right to about 30.
BigFloat difference(const std::function<BigFloat(const BigFloat&)>& f, const BigFloat& x) {
  const BigFloat h("1e-16");
  return (f(x + h) - f(x - h)) / (2 * h);
}

TEST(DualFunctions, DerivativesAreThoseOfDifferences) {
  const auto exact = functions<BigFloat>();
  const auto once = functions<Rate<double>>();
  const auto nested = functions<DualNumber<Rate<BigFloat>, 2>>();
  for (const double x : {0.3, 0.7}) {
    for (std::size_t i = 0; i < exact.size(); ++i) {
      SCOPED_TRACE(exact[i].name);
      const BigFloat slope = difference(exact[i].f, BigFloat(x));
      const Rate<double> y = once[i].f(Rate<double>(x, 1.0));
      EXPECT_NEAR(y.value, static_cast<double>(exact[i].f(BigFloat(x))), 1e-15);
      EXPECT_NEAR(y.d[0], static_cast<double>(slope), 4e-15);

      DualNumber<Rate<BigFloat>, 2> both(Rate<BigFloat>(BigFloat(x), BigFloat(1)));
      both.d[1] = Rate<BigFloat>(BigFloat(1));
      const auto z = nested[i].f(both);
      EXPECT_LT(valueOf(BigFloat(abs(BigFloat(z.d[1].value - slope)))), 1e-25);
      const auto slopeAt = [&](const BigFloat& at) { return difference(exact[i].f, at); };
      const BigFloat h("1e-8");
      const BigFloat second = (slopeAt(BigFloat(x) + h) - slopeAt(BigFloat(x) - h)) / (2 * h);
      EXPECT_LT(valueOf(BigFloat(abs(BigFloat(z.d[1].d[0] - second)))), 1e-13);
      EXPECT_EQ(valueOf(z.d[0]), 0.0);
    }
  }
}

// 1 / 0.1 is rounded to 10, but the double 0.1 is above a tenth and fits into 1 only nine times. Numbers and dual
// numbers have to jump at the same time.
TEST(DualFunctions, RemaindersAreThoseOfNumbers) {
  for (const double x : {1.0, -1.0, 0.6, 1e9 + 0.1}) {
    const Rate<double> r = fmod(Rate<double>(x, 2.0), 0.1);
    EXPECT_EQ(r.value, std::fmod(x, 0.1)) << x;
    EXPECT_EQ(r.d[0], 2.0);
  }
}

TEST(DualFunctions, PowersWhereLogarithmsDoNotExist) {
  const Rate<double> negative = pow(Rate<double>(-2.0, 1.0), 3);
  EXPECT_DOUBLE_EQ(negative.value, -8);
  EXPECT_DOUBLE_EQ(negative.d[0], 12);
  const Rate<double> zero = pow(Rate<double>(0.0, 1.0), 2);
  EXPECT_EQ(zero.value, 0);
  EXPECT_EQ(zero.d[0], 0);
  EXPECT_EQ(pow(Rate<double>(0.0, 1.0), 0).d[0], 0);
}

}  // namespace
}  // namespace irk
