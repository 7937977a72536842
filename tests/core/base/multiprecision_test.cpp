// BigFloat against the numbers of Boost.Multiprecision, which have another arithmetic: all digits must agree.
#include "irk/multiprecision.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <compare>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "irk/misuse.h"

namespace irk {
namespace {

template <int Digits>
struct Peer {
  template <int D>
  using OfDigits =
      boost::multiprecision::number<boost::multiprecision::cpp_bin_float<unsigned(D)>, boost::multiprecision::et_off>;
  using Number = OfDigits<Digits>;
  using Wider = OfDigits<2 * Digits>;
};
using Peers =
    testing::Types<Peer<30>, Peer<50>, Peer<100>, Peer<130>, Peer<200>>;  // 200 digits have memory of their own

template <class T>
class BigFloatTest : public testing::Test {
  WorkingDigits digits_{std::numeric_limits<typename T::Number>::digits10};
};
TYPED_TEST_SUITE(BigFloatTest, Peers);

// Enough digits that different bits have different texts.
std::string allDigits(const auto& x) { return x.str(WorkingDigits::now() + 3, std::ios::scientific); }

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
  using Ours = BigFloat;
  using Boosts = typename TypeParam::Number;
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

TYPED_TEST(BigFloatTest, FunctionsAreRoundedToNearest) {
  using Ours = BigFloat;
  using Boosts = typename TypeParam::Number;
  using Wider = typename TypeParam::Wider;
  const auto ours = samples<Ours>();
  const auto boosts = samples<Boosts>();
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Ours& a = ours[i];
    const Ours p = abs(a), q = p / (1 + p);
    const Boosts half = abs(boosts[i]);
    const Wider b(boosts[i]), r(half), s(Boosts(half / (1 + half)));
    // Boost computes with twice the digits.
    const auto same = [&](const Ours& x, const Wider& y, const char* name) {
      const Wider error = abs(Wider(x.str(3 * WorkingDigits::now(), std::ios::scientific)) - y);
      EXPECT_LE(error, 0.5001 * std::numeric_limits<Boosts>::epsilon().template convert_to<Wider>() * abs(y))
          << name << " of " << allDigits(a);
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
    same(acosh(1 + p), acosh(Wider(Boosts(1 + half))), "acosh");
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

TYPED_TEST(BigFloatTest, EpsilonIsThatOfBoost) {
  EXPECT_EQ(allDigits(std::numeric_limits<BigFloat>::epsilon()),
            allDigits(std::numeric_limits<typename TypeParam::Number>::epsilon()));
}

TEST(BigFloat, NotANumberIsUnordered) {
  const BigFloat nan = std::numeric_limits<BigFloat>::quiet_NaN(), inf = std::numeric_limits<BigFloat>::infinity();
  EXPECT_TRUE(isnan(nan));
  EXPECT_FALSE(isfinite(nan));
  EXPECT_FALSE(nan == nan);
  EXPECT_TRUE(nan != nan);
  EXPECT_FALSE(nan < 1);
  EXPECT_FALSE(nan >= 1);
  EXPECT_TRUE(isinf(inf));
  EXPECT_FALSE(isfinite(inf));
  EXPECT_LT(BigFloat(1e300) * BigFloat(1e300), inf);
  EXPECT_TRUE(isinf(-1 / BigFloat(0)));
  EXPECT_TRUE(isnan(BigFloat(std::numeric_limits<double>::quiet_NaN())));
}

TEST(BigFloat, TextsAreReadAndWritten) {
  const BigFloat tenth("0.1");
  EXPECT_EQ(tenth.str(), BigFloat(BigFloat(1) / 10).str());
  EXPECT_NE(tenth, BigFloat(0.1)) << "0.1 in double is not a tenth";
  EXPECT_EQ(BigFloat("-1.5e3"), -1500);
  EXPECT_THROW(BigFloat("one"), std::runtime_error);
  std::stringstream text;
  text.precision(20);
  text << BigFloat(1) / 3;
  EXPECT_EQ(text.str(), "0.33333333333333333333");
}

TEST(BigFloat, ConversionsRoundToNearest) {
  BigFloat third;
  {
    const WorkingDigits digits(80);
    third = BigFloat(1) / 3;
  }
  EXPECT_NE(third, BigFloat(1) / 3) << "a copy keeps its bits";
  EXPECT_EQ(third.rounded(), BigFloat(1) / 3);
  EXPECT_EQ(static_cast<double>(third), 1.0 / 3.0);
  EXPECT_EQ(static_cast<int>(BigFloat("-2.9")), -2);
  EXPECT_EQ(BigFloat(18446744073709551615ULL).str(), "18446744073709551615");
}

TEST(BigFloat, EachThreadHasItsOwnDigits) {
  const WorkingDigits digits(100);
  int other = 0;
  std::thread([&other] { other = WorkingDigits::now(); }).join();
  EXPECT_EQ(other, WorkingDigits::kDefault);
  EXPECT_EQ(WorkingDigits::now(), 100);
  {
    const WorkingDigits inner(30);
    EXPECT_LT(abs(BigFloat(1) / 3 * 3 - 1), BigFloat("1e-29"));
    EXPECT_GT(abs(BigFloat(1) / 3 - BigFloat("1e-31") - BigFloat(1) / 3), 0);
  }
  EXPECT_EQ(WorkingDigits::now(), 100);
  EXPECT_THROW(WorkingDigits(16), Misuse);
  EXPECT_THROW(WorkingDigits(2001), Misuse);
}

// The number of limbs changes the place where they are.
TEST(BigFloat, CopiesAndMovesKeepTheValue) {
  std::vector<BigFloat> all;
  for (const int digits : {30, 50, 150, 155, 400}) {
    const WorkingDigits work(digits);
    all.push_back(BigFloat(1) / 3);
  }
  for (const BigFloat& from : all) {
    for (const BigFloat& to : all) {
      BigFloat copied(to), moved(to), source(from);
      copied = from;
      EXPECT_EQ(copied, from);
      moved = std::move(source);
      EXPECT_EQ(moved, from);
      source = to;
      EXPECT_EQ(source, to);
      EXPECT_EQ(BigFloat(std::move(moved)), from);
      copied = 0;
      EXPECT_EQ(copied, 0);
    }
  }
  BigFloat& self = all.back();
  self = *&self;
  EXPECT_EQ(self, BigFloat(all.back()));
}

}  // namespace
}  // namespace irk
