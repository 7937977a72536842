// BigFloat against the number of Boost that is inside it: all digits must agree.
#include "irk/multiprecision.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <compare>
#include <random>
#include <sstream>
#include <stdexcept>

namespace irk {
namespace {

template <class T>
class BigFloatTest : public testing::Test {};

template <int Digits>
struct Pair {
  using Ours = BigFloat<Digits>;
  using Boosts = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<unsigned(Digits)>,
                                               boost::multiprecision::et_off>;
};
using Pairs = testing::Types<Pair<50>, Pair<80>, Pair<100>, Pair<130>>;
TYPED_TEST_SUITE(BigFloatTest, Pairs);

// Enough digits that different bits have different texts.
template <class T>
std::string allDigits(const T& x) {
  return x.str(std::numeric_limits<T>::max_digits10, std::ios::scientific);
}

// Numbers of both signs with all bits in use, from 1e-6 to 1e6.
template <class T>
std::vector<T> samples() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<T> result;
  for (int i = 0; i < 40; ++i) {
    const double first = mantissa(random), second = mantissa(random), scale = std::pow(10.0, i % 13 - 6);
    result.push_back((T(first) + T(second) / T(3) * T(1e-17)) * T(scale) / T(7));
  }
  return result;
}

TYPED_TEST(BigFloatTest, ArithmeticIsThatOfBoost) {
  using Ours = typename TypeParam::Ours;
  using Boosts = typename TypeParam::Boosts;
  const auto ours = samples<Ours>();
  const auto boosts = samples<Boosts>();
  for (std::size_t i = 0; i + 1 < ours.size(); ++i) {
    const Ours &a = ours[i], &b = ours[i + 1];
    const Boosts &c = boosts[i], &d = boosts[i + 1];
    EXPECT_EQ(allDigits(a), allDigits(c));
    EXPECT_EQ(allDigits(Ours(a + b)), allDigits(Boosts(c + d)));
    EXPECT_EQ(allDigits(Ours(a - b)), allDigits(Boosts(c - d)));
    EXPECT_EQ(allDigits(Ours(a * b)), allDigits(Boosts(c * d)));
    EXPECT_EQ(allDigits(Ours(a / b)), allDigits(Boosts(c / d)));
    EXPECT_EQ(allDigits(Ours(-a)), allDigits(Boosts(-c)));
    EXPECT_EQ(allDigits(Ours(0.1 * a)), allDigits(Boosts(0.1 * c)));
    EXPECT_EQ(allDigits(Ours(a * 3 - 7)), allDigits(Boosts(c * 3 - 7)));
    EXPECT_EQ(allDigits(Ours(3 / a)), allDigits(Boosts(3 / c)));
    Ours x = a;
    Boosts y = c;
    x += b, y += d;
    x *= a, y *= c;
    x -= b, y -= d;
    x /= b, y /= d;
    EXPECT_EQ(allDigits(x), allDigits(y));
    EXPECT_EQ(a < b, c < d);
    EXPECT_EQ(a >= b, c >= d);
    EXPECT_EQ(a == 1, c == 1);
    EXPECT_EQ(static_cast<double>(a), static_cast<double>(c));
    EXPECT_EQ(static_cast<int>(a), static_cast<int>(c));
    EXPECT_EQ(static_cast<long>(a), static_cast<long>(c));
  }
}

TYPED_TEST(BigFloatTest, FunctionsAreThoseOfBoost) {
  using Ours = typename TypeParam::Ours;
  using Boosts = typename TypeParam::Boosts;
  const auto ours = samples<Ours>();
  const auto boosts = samples<Boosts>();
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Ours& a = ours[i];
    const Ours p = abs(a), q = p / (1 + p);
    const Boosts& b = boosts[i];
    const Boosts r = abs(b), s = r / (1 + r);
    const auto same = [&](const Ours& x, const Boosts& y, const char* name) {
      EXPECT_EQ(allDigits(x), allDigits(y)) << name << " of " << allDigits(a);
    };
    same(p, r, "abs");
    same(fabs(a), fabs(b), "fabs");
    same(sqrt(p), sqrt(r), "sqrt");
    same(cbrt(a), cbrt(b), "cbrt");
    same(exp(q), exp(s), "exp");
    same(expm1(q), expm1(s), "expm1");
    same(log(p), log(r), "log");
    same(log1p(p), log1p(r), "log1p");
    same(log2(p), log2(r), "log2");
    same(log10(p), log10(r), "log10");
    same(sin(a), sin(b), "sin");
    same(cos(a), cos(b), "cos");
    same(tan(a), tan(b), "tan");
    same(asin(q), asin(s), "asin");
    same(acos(q), acos(s), "acos");
    same(atan(a), atan(b), "atan");
    same(sinh(q), sinh(s), "sinh");
    same(cosh(q), cosh(s), "cosh");
    same(tanh(q), tanh(s), "tanh");
    same(asinh(a), asinh(b), "asinh");
    same(acosh(1 + p), acosh(1 + r), "acosh");
    same(atanh(q), atanh(s), "atanh");
    same(floor(a), floor(b), "floor");
    same(ceil(a), ceil(b), "ceil");
    same(round(a), round(b), "round");
    same(trunc(a), trunc(b), "trunc");
    same(pow(p, q), pow(r, s), "pow");
    same(pow(a, 5), pow(b, 5), "fifth power");
    same(pow(a, -3), pow(b, -3), "power -3");
    same(pow(p, 0.5), pow(r, 0.5), "power 0.5");
    same(atan2(a, q), atan2(b, s), "atan2");
    same(hypot(a, q), hypot(b, s), "hypot");
    same(fmod(a, q), fmod(b, s), "fmod");
    same(ldexp(a, -9), ldexp(b, -9), "ldexp");
    int n = 0, m = 0;
    same(frexp(a, &n), frexp(b, &m), "frexp");
    EXPECT_EQ(n, m);
    EXPECT_EQ(signbit(a), signbit(b) != 0);
  }
}

TYPED_TEST(BigFloatTest, LimitsAreThoseOfBoost) {
  using Ours = std::numeric_limits<typename TypeParam::Ours>;
  using Boosts = std::numeric_limits<typename TypeParam::Boosts>;
  EXPECT_EQ(Ours::digits, Boosts::digits);
  EXPECT_EQ(Ours::digits10, Boosts::digits10);
  EXPECT_EQ(Ours::max_digits10, Boosts::max_digits10);
  EXPECT_EQ(allDigits(Ours::epsilon()), allDigits(Boosts::epsilon()));
  EXPECT_LE(Ours::max_exponent, Boosts::max_exponent);
  EXPECT_GE(Ours::min_exponent, Boosts::min_exponent);
}

TEST(BigFloat, NotANumberIsUnordered) {
  const mp50 nan = std::numeric_limits<mp50>::quiet_NaN(), inf = std::numeric_limits<mp50>::infinity();
  EXPECT_TRUE(isnan(nan));
  EXPECT_FALSE(isfinite(nan));
  EXPECT_FALSE(nan == nan);
  EXPECT_TRUE(nan != nan);
  EXPECT_FALSE(nan < 1);
  EXPECT_FALSE(nan >= 1);
  EXPECT_TRUE(isinf(inf));
  EXPECT_FALSE(isfinite(inf));
  EXPECT_LT(mp50(1e300) * mp50(1e300), inf);
  EXPECT_TRUE(isinf(-1 / mp50(0)));
  EXPECT_TRUE(isnan(mp50(std::numeric_limits<double>::quiet_NaN())));
}

TEST(BigFloat, TextsAreReadAndWritten) {
  const mp50 tenth("0.1");
  EXPECT_EQ(tenth.str(), mp50(mp50(1) / 10).str());
  EXPECT_NE(tenth, mp50(0.1)) << "0.1 in double is not a tenth";
  EXPECT_EQ(mp50("-1.5e3"), -1500);
  EXPECT_THROW(mp50("one"), std::runtime_error);
  std::stringstream text;
  text.precision(20);
  text << mp50(1) / 3;
  EXPECT_EQ(text.str(), "0.33333333333333333333");
  mp50 read;
  text >> read;
  EXPECT_EQ(read, mp50("0.33333333333333333333"));
}

TEST(BigFloat, ConversionsRoundToNearest) {
  const BigFloat<80> third = BigFloat<80>(1) / 3;
  EXPECT_EQ(mp50(third), mp50(1) / 3);
  EXPECT_NE(BigFloat<80>(mp50(third)), third);
  EXPECT_EQ(static_cast<double>(third), 1.0 / 3.0);
  EXPECT_EQ(static_cast<int>(mp50("-2.9")), -2);
  EXPECT_EQ(mp50(18446744073709551615ULL).str(), "18446744073709551615");
}

}  // namespace
}  // namespace irk
