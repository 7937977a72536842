// The observed order: a least-squares slope with its confidence, in a window above round-off and below the
// pre-asymptotic range; or the reason why the order is not measurable.
#pragma once

#include <string>
#include <vector>

namespace irk {

struct ErrorPoint {
  double h;
  double error;
};

struct OrderFitOptions {
  /// > 0. Round-off of the numbers. Errors below 50 epsilon always count as round-off.
  double epsilon = 2.220446049250313e-16;
  /// > 1. The floor is this factor above the level at which errors stop shrinking. Noise of 1/10 changes a slope over
  /// one decade by less than a tenth.
  double above_noise = 10;
  /// >= 3 points, and > 1: the smallest ratio of the largest to the smallest step.
  int min_points = 3;
  double min_span = 2;
  /// > 0. The largest sum of confidence and drift of a measurable order; for orders beyond 20 this is multiplied by
  /// order / 20.
  double max_uncertainty = 0.2;
  /// The exponent q in error = C h^p (1 + c h^q + ...). It is 2 for symmetric methods, whose errors have even powers
  /// only; HNW I (II.8).
  int next_power = 1;
};

struct OrderFit {
  bool measurable = false;
  double order = 0;
  double confidence = 0;  ///< half width of the 95 % interval of the slope
  double h_min = 0, h_max = 0;
  int points = 0;
  std::string reason;  ///< why the order is not measurable; else empty
};

/// The requirement on a window as text: `at least 3 steps, the largest at least 2 times the smallest`.
std::string windowText(const OrderFitOptions& options = {});

/// The tolerance with which orders count as equal: 0.2, or one percent for orders beyond 20.
double orderTolerance(double order);

/// The fit of the steps beside the window of `first`, the coarser or the finer ones; its end belongs to both. It is not
/// measurable if too few are left, or if neither keeps to a line.
OrderFit secondWindow(const std::vector<ErrorPoint>& points, const OrderFit& first, const OrderFitOptions& options);

/// Points in any order; errors that are not positive and finite are ignored. Errors that stay constant or grow as h
/// shrinks have zero or negative orders.
OrderFit fitOrder(std::vector<ErrorPoint> points, const OrderFitOptions& options = {});

}  // namespace irk
