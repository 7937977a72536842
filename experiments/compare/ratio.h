// How much slower: the ratio of two samples of times with an interval that needs no model of their noise.
#pragma once

#include <vector>

namespace irk::compare {

/// b over a. `level`: how probably low <= ratio <= high holds.
struct Ratio {
  double ratio, low, high, level;
};

/// The estimate of Hodges and Lehmann, the median of all b_j / a_i, with the interval that belongs to the rank test
/// of Mann and Whitney: it does not contain 1 where that test sees a difference with significance `alpha`.
/// Samples too small for `alpha` get their whole range: all of b against all of a. Sizes: at least one
/// number > 0 each.
/// Hollander, Wolfe & Chicken, Nonparametric Statistical Methods, 3rd ed. (2014), section 4.3.
Ratio ratioOf(const std::vector<double>& a, const std::vector<double>& b, double alpha);

/// P(U <= u), u = 0 .. n m, of the rank test's statistic for samples of n and m numbers of one distribution. Exact
/// up to n m = 400, then the normal approximation.
std::vector<double> rankProbabilities(int n, int m);

}  // namespace irk::compare
