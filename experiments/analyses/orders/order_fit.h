// The observed order: a least-squares slope in a window above round-off and below the
// pre-asymptotic range, with its confidence; or the reason why there is none.
#pragma once

#include <string>
#include <vector>

namespace irk {

struct ErrorPoint {
  double h;
  double error;
};

struct OrderFitOptions {
  /// > 0. Round-off of the numbers. Errors below 50 of it are round-off whatever they look like.
  double epsilon = 2.220446049250313e-16;
  /// > 1. Where errors stop shrinking, the floor is this much above their level: noise of 1/10
  /// bends a slope over one decade by less than a tenth of itself.
  double above_noise = 10;
  /// >= 3 points, and > 1: at least this ratio between the largest and the smallest step.
  int min_points = 3;
  double min_span = 2;
  /// > 0. Largest sum of confidence and drift that still is a measurement; for orders beyond 20
  /// this much times order / 20.
  double max_uncertainty = 0.2;
  /// q of error = C h^p (1 + c h^q + ...): 2 for symmetric methods, whose errors have even powers
  /// only; HNW I (II.8).
  int next_power = 1;
};

struct OrderFit {
  bool measurable = false;
  double order = 0;
  double confidence = 0;  ///< half width of the 95 % interval of the slope
  double h_min = 0, h_max = 0;
  int points = 0;
  std::string reason;  ///< why it is not measurable
};

/// What a window must have: `at least 3 steps, the largest at least 2 times the smallest`.
std::string windowText(const OrderFitOptions& options = {});

/// What counts as the same order: 0.2, or one percent of orders beyond 20.
double orderTolerance(double order);

/// Errors that stay or grow have orders, too: zero and negative ones.
/// Points in any order; errors that are not positive and finite are left out.
OrderFit fitOrder(std::vector<ErrorPoint> points, const OrderFitOptions& options = {});

}  // namespace irk
