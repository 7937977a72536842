#include "experiments/analyses/line_fit.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace irk {

LineFit fitLine(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  LineFit fit{0, xy / xx, std::numeric_limits<double>::quiet_NaN(), 0};
  fit.offset = mean_y - fit.slope * mean_x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - mean_y - fit.slope * (x[i] - mean_x);
    fit.sum_of_squares += residual * residual;
  }
  if (x.size() > 2) fit.deviation = std::sqrt(fit.sum_of_squares / (n - 2) / xx);
  return fit;
}

double slopeConfidence(const LineFit& fit, std::size_t points) {
  if (points <= 2) return std::numeric_limits<double>::infinity();
  constexpr double kBelow = 0.975;  // of both tails 2.5 %
  const boost::math::students_t student(static_cast<double>(points - 2));
  return boost::math::quantile(student, kBelow) * fit.deviation;
}

}  // namespace irk
