// Watches an integration for components below their tolerance, which its error control does not see.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/constants.h"
#include "core/system/component_name.h"
#include "irk/monitor.h"
#include "irk/options.h"

namespace irk {

// Watches an integration for components of (u, v, x) that are below their absolute tolerance for a whole step: at both
// ends of it, and by their rate in between, so that a component that passes through zero is none of them. One whose
// estimated error is small beside its own size, by the relative tolerance of the integration that measures, is none of
// them either: it is as accurate as control by its size would make it. Nor, where rests are watched (UnstableRest), is
// the velocity of a position that is above its tolerance: such a motion rests away from zero, and its velocity falls to
// the round-off of the position, where control by its size takes short steps for nothing.
template <class Real>
class SmallComponents {
 public:
  SmallComponents(const State<Real>& start, const Tolerances& tolerances, const Vec<double>& scale,
                  bool rests_are_watched)
      : rests_are_watched_(rests_are_watched),
        relative_(kBarStricter * std::max(tolerances.rtol, tolerances.atol)),
        scale_(scale) {
    const bool ones = scale.size() == 0 || tolerances.norm == NormKind::kAbsolute;
    if (ones) scale_ = Vec<double>::Ones(2 * start.u.size() + start.x.size() + start.z().size());
    of_.resize(static_cast<std::size_t>(scale_.size() - start.z().size()));
    forEach(start, [&](Component& c, Index i, double y, double) {
      c.tolerance = tolerances.of(scale_[i], 0);
      c.starts_at_zero = y == 0;
      c.first = y;
    });
  }

  // An integration begins at `start`. What was found small before stays so.
  void begin(const State<Real>& start) {
    found_ = false;
    forEach(start, [](Component& c, Index, double y, double) { c.begins_below = y < c.tolerance; });
  }
  void look(const StepRecord<Real>& step) {
    const double h = std::abs(step.h);
    forEach(step.state, [&](Component& c, Index i, double y, double rate) {
      if (c.first == 0) c.first = y;
      const bool below = c.begins_below && y > 0 && y + h * rate < c.tolerance;
      if (!c.small && below && !isOfLargePosition(step, i) && !isAccurate(step, i, y)) c.small = found_ = true;
      c.begins_below = y < c.tolerance;
    });
  }
  // Whether this integration has found a further one.
  bool found() const { return found_; }

  // The components that were found small, "x[2]" or "x[2] and 3 more": those that are at the last step, if any are.
  std::string names(const Sizes& sizes) const {
    const auto isNow = [](const Component& c) { return c.small && c.begins_below; };
    const bool any_now = std::any_of(of_.begin(), of_.end(), isNow);
    const auto isSmall = [&](const Component& c) { return any_now ? isNow(c) : c.small; };
    const auto first = std::find_if(of_.begin(), of_.end(), isSmall);
    const auto count = std::count_if(of_.begin(), of_.end(), isSmall);
    return componentName(sizes, first - of_.begin()) + (count > 1 ? " and " + std::to_string(count - 1) + " more" : "");
  }
  // The scale of u, v and x that controls them relative to their size; empty if there are none. One that begins with
  // zero has that of its first value. Without z, which the formulation of an integration may not have.
  Vec<double> relativeScale() const {
    constexpr double nothing = 1e-100;  // a decay is followed down to here
    Vec<double> result;
    for (std::size_t i = 0; i < of_.size(); ++i) {
      if (!of_[i].small) continue;
      if (result.size() == 0) result = scale_.head(static_cast<Index>(of_.size()));
      result[static_cast<Index>(i)] = of_[i].starts_at_zero ? of_[i].first : nothing;
    }
    return result;
  }

 private:
  struct Component {
    double tolerance = 0;
    double first = 0;  // the first magnitude that is not zero
    bool starts_at_zero = false, begins_below = false, small = false;
  };
  bool isOfLargePosition(const StepRecord<Real>& step, Index i) const {
    const Index nu = step.state.u.size();
    if (!rests_are_watched_ || i < nu || i >= 2 * nu) return false;
    const double position = std::abs(static_cast<double>(step.state.u[i - nu]));
    return !(position < of_[static_cast<std::size_t>(i - nu)].tolerance);
  }
  bool isAccurate(const StepRecord<Real>& step, Index i, double y) const {
    if (!step.errors) return false;
    return std::abs(static_cast<double>(componentOf(*step.errors, i))) <= relative_ * y;
  }
  // Calls f(component, its index, its magnitude, that of its rate).
  template <class F>
  void forEach(const State<Real>& s, F&& f) {
    const auto size = [](const Real& value) { return std::abs(static_cast<double>(value)); };
    const auto add = [&](Index i, const Real& y, const Real& rate) {
      f(of_[static_cast<std::size_t>(i)], i, size(y), size(rate));
    };
    const Index nu = s.u.size();
    for (Index i = 0; i < nu; ++i) {
      add(i, s.u[i], s.v[i]);
      add(nu + i, s.v[i], s.w[i]);
    }
    for (Index i = 0; i < s.x.size(); ++i) add(2 * nu + i, s.x[i], s.w[nu + i]);
  }

  bool found_ = false;
  bool rests_are_watched_;
  double relative_;
  Vec<double> scale_;
  std::vector<Component> of_;
};

}  // namespace irk
