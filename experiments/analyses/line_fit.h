// A straight line through points by least squares.
#pragma once

#include <span>

namespace irk {

/// y = offset + slope x.
struct LineFit {
  double offset, slope;
  double deviation;       ///< the standard error of the slope; NaN for two points
  double sum_of_squares;  ///< of the residuals
};

/// x and y have one length, at least 2, and x is not constant.
LineFit fitLine(std::span<const double> x, std::span<const double> y);

/// The half width of the slope's 95 % confidence interval, by Student's distribution with points - 2 degrees of
/// freedom; infinite for two points.
double slopeConfidence(const LineFit& fit, std::size_t points);

}  // namespace irk
