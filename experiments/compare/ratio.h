// The ratio of two samples of times, with a confidence interval that assumes no model of their noise.
#pragma once

#include <vector>

namespace irk::compare {

/// The ratio b / a. `level` is the probability of low <= ratio <= high.
struct Ratio {
  double ratio, low, high, level;
};

/// The estimate of Hodges and Lehmann, the median of all b_j / a_i, and the interval that belongs to the rank test of
/// Mann and Whitney: it excludes 1 if the test finds a difference with significance `alpha`. Samples too small for
/// `alpha` get the range of all ratios. Each sample has at least one number, all > 0. Hollander, Wolfe & Chicken,
/// Nonparametric Statistical Methods, 3rd ed. (2014), section 4.3.
Ratio ratioOf(const std::vector<double>& a, const std::vector<double>& b, double alpha);

/// P(U <= u), u = 0 .. n m, for the statistic of the rank test with samples of n and m numbers from one distribution.
/// Exact up to n m = 400, beyond that the normal approximation.
std::vector<double> rankProbabilities(int n, int m);

}  // namespace irk::compare
