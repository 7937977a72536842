#include "experiments/compare/ratio.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irk::compare {
namespace {

constexpr int kMaxExact = 400;

// The numbers of orderings of n + m values with rank statistic u = 0 .. n m: the coefficients of product_i (1 - q^(m
// + i)) / (1 - q^i), i = 1 .. n.
std::vector<double> rankCounts(int n, int m) {
  const int most = n * m;
  std::vector<double> counts(static_cast<std::size_t>(most) + 1, 0);
  counts[0] = 1;
  const auto at = [&](int u) -> double& { return counts[static_cast<std::size_t>(u)]; };
  for (int i = 1; i <= n; ++i) {
    for (int u = most; u >= m + i; --u) at(u) -= at(u - m - i);
    for (int u = i; u <= most; ++u) at(u) += at(u - i);
  }
  return counts;
}

double normalProbability(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

std::vector<double> rankProbabilities(int n, int m) {
  if (n * m <= kMaxExact) {
    auto sums = rankCounts(n, m);
    std::partial_sum(sums.begin(), sums.end(), sums.begin());
    const double all = sums.back();
    for (double& sum : sums) sum /= all;
    return sums;
  }
  const double mean = 0.5 * n * m, deviation = std::sqrt(n * m / 12.0 * (n + m + 1));
  std::vector<double> probabilities;
  for (int u = 0; u <= n * m; ++u) probabilities.push_back(normalProbability((u + 0.5 - mean) / deviation));
  return probabilities;
}

Ratio ratioOf(const std::vector<double>& a, const std::vector<double>& b, double alpha) {
  std::vector<double> ratios;
  for (const double x : a) {
    for (const double y : b) ratios.push_back(y / x);
  }
  std::sort(ratios.begin(), ratios.end());
  const std::size_t last = ratios.size() - 1;
  const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
  const auto below = rankProbabilities(n, m);
  // The number of ratios that the test leaves out at each end; without any the interval contains all ratios.
  std::size_t first = 0;
  while (first + 1 < last - first && below[first + 1] <= alpha / 2) ++first;
  const double median = std::sqrt(ratios[last / 2] * ratios[last - last / 2]);
  return {median, ratios[first], ratios[last - first], std::max(1 - 2 * below[first], 0.0)};
}

}  // namespace irk::compare
