#include "tableaus/analysis/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tableaus/analysis/spectrum.h"
#include "tableaus/families/precise.h"

namespace irk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAngleAccuracy = 1e-7;  // degrees

/// The polynomial sum_k value_k x^k, and bounds for rounding errors of its terms, in units of the tolerance.
struct RayPolynomial {
  Vec<BigFloat> value, magnitude;
};

// With z = r e^(i phi) and T_n(cos phi) = cos(n phi):
//   |D|^2 - |N|^2 = sum_ij (d_i d_j - n_i n_j) T_|i-j|(cos phi) r^(i+j)
RayPolynomial onRay(const StabilityFunction& R, const BigFloat& cosine) {
  const Index m = std::max(R.numeratorDegree(), R.denominatorDegree());
  const auto coefficient = [](const Vec<BigFloat>& polynomial, Index k) {
    return k < polynomial.size() ? polynomial[k] : BigFloat(0);
  };
  std::vector<BigFloat> T{1, cosine};
  for (Index n = 2; n <= m; ++n) {
    const auto last = T.end();
    T.push_back(2 * cosine * *(last - 1) - *(last - 2));
  }
  RayPolynomial sum{Vec<BigFloat>::Zero(2 * m + 1), Vec<BigFloat>::Zero(2 * m + 1)};
  for (Index i = 0; i <= m; ++i) {
    for (Index j = 0; j <= m; ++j) {
      const BigFloat dd = coefficient(R.denominator, i) * coefficient(R.denominator, j);
      const BigFloat nn = coefficient(R.numerator, i) * coefficient(R.numerator, j);
      sum.value[i + j] += (dd - nn) * T[static_cast<std::size_t>(std::abs(i - j))];
      sum.magnitude[i + j] += abs(dd) + abs(nn);
    }
  }
  return sum;
}

BigFloat evaluate(const Vec<BigFloat>& polynomial, const BigFloat& x) {
  BigFloat value = 0;
  for (Index k = polynomial.size() - 1; k >= 0; --k) value = value * x + polynomial[k];
  return value;
}

/// Sets coefficients within their rounding error to zero, together with that error.
void clean(RayPolynomial& F, double tolerance) {
  for (Index k = 0; k < F.value.size(); ++k) {
    if (abs(F.value[k]) <= tolerance * F.magnitude[k]) F.value[k] = F.magnitude[k] = 0;
  }
}

/// Positive x, ascending, at which the polynomial can change its sign. Pairs close to the real axis count, too: they
/// may be double zeros that rounding has split, and an additional point does no harm.
std::vector<BigFloat> positiveZeros(const Vec<BigFloat>& polynomial) {
  constexpr double kNearAxis = 1e-3;
  Index low = 0, high = polynomial.size() - 1;
  while (low <= high && polynomial[low] == 0) ++low;
  while (high > low && polynomial[high] == 0) --high;
  std::vector<BigFloat> zeros;
  if (low >= high) return zeros;
  for (const auto& [re, im] : polynomialZeros(polynomial.segment(low, high - low + 1))) {
    if (re > 0 && abs(im) <= kNearAxis * re) zeros.push_back(re);
  }
  std::ranges::sort(zeros);
  return zeros;
}

double alphaOf(const StabilityFunction& R, double tolerance) {
  const BigFloat degree = acos(BigFloat(-1)) / 180;
  const auto holds = [&](double alpha) { return stableRadius(R, -cos(alpha * degree), tolerance) == kInfinity; };
  double unstable = 90;  // unstable, or not known to be stable
  for (const auto& pole : R.poles) {
    const double angle = std::abs(std::arg(-pole)) / static_cast<double>(degree);
    unstable = std::min(unstable, angle);
  }
  double stable = 0;
  while (unstable - stable > kAngleAccuracy) {
    const double middle = (stable + unstable) / 2;
    (holds(middle) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace

double stableRadius(const StabilityFunction& R, const BigFloat& cosine, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  RayPolynomial F = onRay(R, cosine);
  clean(F, tolerance);
  const auto lowest = std::ranges::find_if(F.value, [](const BigFloat& x) { return x != 0; });
  if (lowest == F.value.end()) return kInfinity;  // |R| = 1
  if (*lowest < 0) return 0;
  const std::vector<BigFloat> zeros = positiveZeros(F.value);
  for (std::size_t i = 1; i < zeros.size(); ++i) {
    const BigFloat x = sqrt(zeros[i - 1] * zeros[i]);
    const bool stable = evaluate(F.value, x) >= -tolerance * evaluate(F.magnitude, x);
    if (!stable) return static_cast<double>(zeros[i - 1]);
  }
  Index highest = F.value.size() - 1;
  while (F.value[highest] == 0) --highest;
  return F.value[highest] > 0 ? kInfinity : static_cast<double>(zeros.back());
}

Stability analyzeStability(const StabilityFunction& R, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  Stability result{};
  result.real_limit = stableRadius(R, -1, tolerance);
  result.imaginary_limit = stableRadius(R, 0, tolerance);
  result.i_stable = result.imaginary_limit == kInfinity;
  const bool poles_right = std::ranges::all_of(R.poles, [](const auto& pole) { return pole.real() > 0; });
  result.a_stable = result.i_stable && poles_right;
  result.l_stable = result.a_stable && R.numeratorDegree() < R.denominatorDegree();
  const bool poles_left_of_zero =
      std::ranges::any_of(R.poles, [](const auto& pole) { return pole.imag() == 0 && pole.real() < 0; });
  if (result.a_stable) {
    result.alpha = 90;
  } else if (result.real_limit < kInfinity || poles_left_of_zero) {
    result.alpha = std::numeric_limits<double>::quiet_NaN();
  } else {
    result.alpha = alphaOf(R, tolerance);
  }
  return result;
}

}  // namespace irk
