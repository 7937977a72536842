#include "experiments/analyses/orders/order_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "experiments/analyses/line_fit.h"

namespace irk {
namespace {

struct Slope {
  double offset;  // log(error) at h = 1
  double value;
  double deviation;   // standard error; 0 for two points
  double confidence;  // 95 %
};

Slope fitSlope(std::span<const ErrorPoint> window) {
  std::vector<double> x, y;
  for (const auto& p : window) {
    x.push_back(std::log(p.h));
    y.push_back(std::log(p.error));
  }
  const LineFit fit = fitLine(x, y);
  return {fit.offset, fit.slope, x.size() == 2 ? 0 : fit.deviation, slopeConfidence(fit, x.size())};
}

double centre(std::span<const ErrorPoint> window) { return std::sqrt(window.front().h * window.back().h); }

// For error = C h^p (1 + c h^q) local slopes are p + q c h^q. The difference between the slopes of the coarse and the
// fine half, extrapolated to h = 0, is therefore the remaining error of the fit. A slope over half the points is
// about 2^(3/2) times as uncertain as that over all, the difference of two four times.
double drift(std::span<const ErrorPoint> window, const Slope& whole, int next_power) {
  constexpr double kHalves = 4;
  const std::size_t half = window.size() / 2;
  const auto coarse = window.first(half + 1);
  const auto fine = window.last(window.size() - half);
  const double change = std::abs(fitSlope(coarse).value - fitSlope(fine).value);
  const auto at = [next_power](auto part) { return std::pow(centre(part), next_power); };
  const double extrapolation = at(window) / (at(coarse) - at(fine));
  return (change + kHalves * whole.deviation) * extrapolation;
}

// Detects a window in which the error is about to change its sign: its slope is stable over decades, but wrong. At
// finer steps two points in a row then lie below the fitted line; round-off lies above it.
bool continues(std::span<const ErrorPoint> finer, const Slope& slope) {
  constexpr double kFactor = 2;
  const auto below = [&slope](const ErrorPoint& p) {
    return std::log(kFactor * p.error) < slope.offset + slope.value * std::log(p.h);
  };
  return std::adjacent_find(finer.begin(), finer.end(), [&below](auto& p, auto& q) { return below(p) && below(q); }) ==
         finer.end();
}

// Finite positive errors, from coarse to fine.
std::vector<ErrorPoint> usable(std::vector<ErrorPoint> points) {
  std::erase_if(points, [](const ErrorPoint& p) { return !(p.h > 0) || !(p.error > 0) || !std::isfinite(p.error); });
  std::sort(points.begin(), points.end(), [](auto& a, auto& b) { return a.h > b.h; });
  return points;
}

// Removes noise: all points from the one on where small errors no longer shrink, and the coarser points whose slope
// this noise would change. Larger errors that do not shrink are kept, as they belong to an order of zero or less.
// Returns the error below which points have been removed.
double removeNoise(std::vector<ErrorPoint>& points, const OrderFitOptions& options) {
  constexpr double kLevel = 3;
  double floor = 50 * options.epsilon;
  const double small = 100 * std::sqrt(options.epsilon);
  const auto less = [](const ErrorPoint& a, const ErrorPoint& b) { return a.error < b.error; };
  const auto least = std::min_element(points.begin(), points.end(), less);
  if (least != points.end() && least->error <= small) {
    const double level = kLevel * least->error;
    const auto first =
        std::find_if(points.begin(), points.end(), [level](const ErrorPoint& p) { return p.error <= level; });
    const bool shrinks = std::is_sorted(first, points.end(), [](auto& a, auto& b) { return a.error > b.error; });
    if (!shrinks) {
      std::vector<ErrorPoint> tail(first, points.end());
      const auto middle = tail.begin() + static_cast<std::ptrdiff_t>(tail.size() / 2);
      std::nth_element(tail.begin(), middle, tail.end(), less);
      floor = std::max(floor, options.above_noise * middle->error);
      points.erase(first, points.end());
    }
  }
  std::erase_if(points, [floor](const ErrorPoint& p) { return p.error < floor; });
  return floor;
}

OrderFit notMeasurable(std::string reason) {
  OrderFit fit;
  fit.reason = std::move(reason);
  return fit;
}

}  // namespace

std::string windowText(const OrderFitOptions& options) {
  return fmt::format("at least {} steps, the largest at least {:g} times the smallest", options.min_points,
                     options.min_span);
}

OrderFit secondWindow(const std::vector<ErrorPoint>& points, const OrderFit& first, const OrderFitOptions& options) {
  std::vector<ErrorPoint> coarser, finer;
  for (const auto& p : points) {
    if (p.h >= first.h_max) coarser.push_back(p);
    if (p.h <= first.h_min) finer.push_back(p);
  }
  const OrderFit fine = fitOrder(finer, options);
  return fine.measurable ? fine : fitOrder(coarser, options);
}

double orderTolerance(double order) { return std::max(0.2, 0.01 * std::abs(order)); }

OrderFit fitOrder(std::vector<ErrorPoint> given, const OrderFitOptions& options) {
  std::vector<ErrorPoint> points = usable(std::move(given));
  const double floor = removeNoise(points, options);
  const auto enough = static_cast<std::size_t>(options.min_points);
  if (points.size() < enough) {
    return notMeasurable(fmt::format("{} points above the floor {:.1e}, {} are needed", points.size(), floor, enough));
  }
  const double coarsest = points.front().h, finest = points.back().h;
  if (coarsest < options.min_span * finest * (1 - 1e-9)) {
    return notMeasurable(
        fmt::format("steps only from {:.1e} to {:.1e}: less than a factor {:g}", coarsest, finest, options.min_span));
  }
  // The asymptotic range is at the fine end, so a window must reach into the finest quarter of the range of steps:
  // slopes of coarser steps can be constant at a wrong value.
  const double reach = finest * std::pow(coarsest / finest, 0.25);
  OrderFit best = notMeasurable("");
  double best_uncertainty = INFINITY;
  for (std::size_t end = enough; end <= points.size(); ++end) {
    if (points[end - 1].h > reach) continue;
    for (std::size_t begin = 0; begin + enough <= end; ++begin) {
      const auto window = std::span(points).subspan(begin, end - begin);
      if (window.front().h < options.min_span * window.back().h * (1 - 1e-9)) continue;
      const Slope slope = fitSlope(window);
      if (!continues(std::span(points).subspan(end), slope)) continue;
      const double uncertainty = slope.confidence + drift(window, slope, options.next_power);
      if (uncertainty >= best_uncertainty) continue;
      best_uncertainty = uncertainty;
      best = {true, slope.value, slope.confidence, window.back().h, window.front().h, static_cast<int>(window.size()),
              ""};
    }
  }
  if (!best.measurable) return notMeasurable("no window in which the errors keep to a line");
  const double scale = orderTolerance(best.order) / orderTolerance(0);
  if (best_uncertainty <= options.max_uncertainty * scale) return best;
  return notMeasurable(fmt::format("no stable slope above the floor {:.1e}: at best {:.2f}, uncertain by {:.2f}", floor,
                                   best.order, best_uncertainty));
}

}  // namespace irk
