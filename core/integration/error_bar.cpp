#include "irk/error_bar.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/constants.h"
#include "core/integration/component_name.h"
#include "core/options/fixed_steps.h"
#include "core/system/along_rates.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

namespace irk {
namespace {

// |a - b|, each difference formed in Real.
template <class Real>
Vec<double> distances(const auto& a, const auto& b) {
  Vec<double> result(a.size());
  for (Index i = 0; i < a.size(); ++i) result[i] = std::abs(static_cast<double>(Real(a[i] - b[i])));
  return result;
}

Vec<double> unknown(Index n) { return Vec<double>::Constant(n, std::numeric_limits<double>::quiet_NaN()); }

// Sets `tolerances` and `worst`. The smaller one of the two results' values counts: one that is wrong and large would
// seem to be within 1 / rtol tolerances of its own.
template <class Real>
void weigh(const State<Real>& first, const State<Real>& second, const Tolerances& t, const Vec<double>& scale,
           ErrorBar& bar) {
  Index place = 0;
  const auto add = [&](const Vec<double>& errors, const auto& y, const auto& other) {
    for (Index i = 0; i < errors.size(); ++i, ++place) {
      const double magnitude = place < scale.size() ? scale[place] : 1;
      const auto size_of = [i](const auto& values) { return std::abs(static_cast<double>(values[i])); };
      const double size = errors[i] / t.of(magnitude, std::fmin(size_of(y), size_of(other)));
      // A component that is not finite is the worst one.
      if (bar.worst < 0 || size > bar.tolerances || std::isnan(size)) {
        bar.tolerances = std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
        bar.worst = place;
      }
    }
  };
  bar.tolerances = 0;
  add(bar.u, first.u, second.u);
  add(bar.v, first.v, second.v);
  add(bar.x, first.x, second.x);
}

}  // namespace

// What errors in the times of located switches may have changed in u, v and x, all in all.
template <class Real>
struct SwitchErrors {
  Vec<double> u, v, x;

  explicit SwitchErrors(const State<Real>& s)
      : u(Vec<double>::Zero(s.u.size())), v(Vec<double>::Zero(s.v.size())), x(Vec<double>::Zero(s.x.size())) {}

  // A switch that comes earlier by the error leaves another state behind, which then goes on for that time.
  void add(const LocatedSwitch<Real>& at) {
    const State<Real> earlier = alongRates(at.earlier, at.behind, Real(at.time_error));
    u += distances<Real>(earlier.u, at.behind.u);
    v += distances<Real>(earlier.v, at.behind.v);
    x += distances<Real>(earlier.x, at.behind.x);
  }
};

// Watches an integration for components of (u, v, x) that are below their absolute tolerance for a whole step: at both
// ends of it, and by their rate in between, so that a component that passes through zero is none of them.
template <class Real>
class SmallComponents {
 public:
  SmallComponents(const State<Real>& start, const Tolerances& tolerances, const Vec<double>& scale) : scale_(scale) {
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
    forEach(step.state, [&](Component& c, Index, double y, double rate) {
      if (c.first == 0) c.first = y;
      if (!c.small && c.begins_below && y > 0 && y + h * rate < c.tolerance) c.small = found_ = true;
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
  Vec<double> scale_;
  std::vector<Component> of_;
};

template <class Real>
IntegratorOptions independentOptions(const IntegratorOptions& first) {
  IntegratorOptions second;
  second.tolerances = first.tolerances;
  const double eps = static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
  const auto stricter = [eps](double tolerance) {
    return std::min(tolerance, std::max(kBarStricter * tolerance, kBarLeast * eps));
  };
  if (hasFixedSteps(first.step)) {
    second.tolerances.rtol = second.tolerances.atol = kBarOfFixedSteps;
  } else {
    second.tolerances.rtol = stricter(first.tolerances.rtol);
    second.tolerances.atol = stricter(first.tolerances.atol);
    second.step.h_max = first.step.h_max;
  }
  second.storage = first.storage;
  second.threads = first.threads;
  second.step.max_steps = first.step.max_steps;
  second.step.looks = std::max<std::int64_t>(kBarLooks.whole(), first.step.looks);
  second.step.estimate = ErrorEstimate::kEmbedded;
  second.solver = StageSolverKind::kEigen;
  second.jacobian_point = JacobianPoint::kPredicted;
  second.newton.kind = NewtonKind::kBroyden;
  second.order = OrderControl::kVariable;
  second.stop_at = first.stop_at;
  return second;
}

namespace {

// What a measurement is made for.
template <class Real>
struct Measured {
  const State<Real>& result;
  const State<Real>& start;
  const Tolerances& tolerances;
  const Vec<double>& scale;
  const Monitor<Real>& monitor;
  const std::optional<Real>& t_end;
};

template <class Real>
ErrorBar unknownBar(const State<Real>& result, const Solution<Real>& second) {
  ErrorBar bar;
  bar.u = unknown(result.u.size());
  bar.v = unknown(result.v.size());
  bar.x = unknown(result.x.size());
  bar.z = unknown(result.z().size());
  bar.problem = "the integration that measures it ended as " + std::string(name(second.outcome));
  if (!second.detail.empty()) bar.problem += ": " + second.detail;
  return bar;
}

// The bar by one integration with `second`, whose result it sets.
template <class Real>
ErrorBar barBy(Integrator<Real>& second, const Measured<Real>& of, Monitor<Real> watched, Solution<Real>& other) {
  SwitchErrors<Real> switches(of.result);
  watched.located = [&](const LocatedSwitch<Real>& at) {
    switches.add(at);
    if (of.monitor.located) of.monitor.located(at);
  };
  other = second.integrate(of.start, of.t_end ? *of.t_end : of.result.t, watched);
  if (other.outcome != Outcome::kSuccess) return unknownBar(of.result, other);
  ErrorBar bar;
  bar.u = distances<Real>(of.result.u, other.state.u) + switches.u;
  bar.v = distances<Real>(of.result.v, other.state.v) + switches.v;
  bar.x = distances<Real>(of.result.x, other.state.x) + switches.x;
  bar.z = distances<Real>(of.result.z(), other.state.z());
  if (of.t_end) bar.t = std::abs(static_cast<double>(Real(of.result.t - other.state.t)));
  weigh(of.result, other.state, of.tolerances, of.scale, bar);
  return bar;
}

template <class Real>
Sizes sizesOf(const State<Real>& s) {
  const Index nu = s.u.size(), nx = s.x.size();
  return {.nu = nu, .nx = nx, .nz = s.w.size() - nu - nx, .discrete = s.d.size()};
}

// Weighs the errors of an integrator by another scale as long as it lives, also if the integration throws.
template <class Real>
class OtherWeights {
 public:
  OtherWeights(Integrator<Real>& integrator, const Vec<double>& scale) : integrator_(integrator) {
    integrator_.weighErrorsBy(scale);
  }
  ~OtherWeights() { integrator_.weighErrorsBy({}); }
  OtherWeights(const OtherWeights&) = delete;
  OtherWeights& operator=(const OtherWeights&) = delete;

 private:
  Integrator<Real>& integrator_;
};

// The same with all components under control that are found small on the way: the integration begins anew with each of
// them. If that fails or takes too many steps, they are left as they are, and the bar's remark says so.
template <class Real>
ErrorBar controlledBar(Integrator<Real>& second, const Measured<Real>& of, Solution<Real>& other) {
  std::int64_t left = kBarEffort.whole() / static_cast<std::int64_t>(of.start.w.size());
  SmallComponents<Real> small(of.start, of.tolerances, of.scale);
  Monitor<Real> watched = of.monitor;
  watched.accepted = [&](const StepRecord<Real>& step) {
    small.look(step);
    if (of.monitor.accepted) of.monitor.accepted(step);
  };
  for (;;) {
    const Vec<double> relative_scale = small.relativeScale();
    watched.interrupt = [&] {
      const bool too_long = relative_scale.size() > 0 && left-- <= 0;
      if (small.found() || too_long) return Outcome::kTimeout;
      return of.monitor.interrupt ? of.monitor.interrupt() : Outcome::kSuccess;
    };
    small.begin(of.start);
    const ErrorBar bar = [&] {
      const OtherWeights<Real> weights(second, relative_scale);
      return barBy(second, of, watched, other);
    }();
    if (small.found()) continue;
    if (bar.known() || relative_scale.size() == 0) return bar;
    const std::string ended = left < 0 ? "takes too many steps" : "ends as " + std::string(name(other.outcome));
    ErrorBar plain = barBy(second, of, of.monitor, other);
    if (!plain.known()) return plain;
    plain.remark = "the bar may lack what comes of " + small.names(sizesOf(of.start)) +
                   ", below the absolute tolerance on the way: an integration that controls it there " + ended;
    return plain;
  }
}

}  // namespace

template <class Real>
ErrorBar measureErrorBar(const State<Real>& result, Integrator<Real>& second, const State<Real>& start,
                         const Tolerances& tolerances, const Vec<double>& scale, Solution<Real>& second_result,
                         const Monitor<Real>& monitor, const std::optional<Real>& t_end) {
  const Sizes sizes = sizesOf(start);
  requireState("the result", result, sizes);
  requireScale(scale, sizes);
  IntegratorOptions checked;
  checked.tolerances = tolerances;
  validate(checked);
  return controlledBar<Real>(second, {result, start, tolerances, scale, monitor, t_end}, second_result);
}

bool asksForStricter(const ErrorBar& bar) { return bar.known() && bar.tolerances * kBarStricter > 1; }

ErrorBar larger(const ErrorBar& a, const ErrorBar& b) {
  ErrorBar result = a.tolerances < b.tolerances ? b : a;  // has `tolerances`, `worst` and `remark` of the larger one
  result.u = a.u.cwiseMax(b.u);
  result.v = a.v.cwiseMax(b.v);
  result.x = a.x.cwiseMax(b.x);
  result.z = a.z.cwiseMax(b.z);
  result.t = std::fmax(a.t, b.t);
  if (result.remark.empty()) result.remark = a.remark + b.remark;
  return result;
}

double largestErrorBar(const Tolerances& tolerances) {
  return kLargestBar + kLargestBarRoundOff / std::max(tolerances.rtol, tolerances.atol);
}

#define IRK_ERROR_BAR(Real)                                                                                       \
  template IntegratorOptions independentOptions<Real>(const IntegratorOptions&);                                  \
  template ErrorBar measureErrorBar(const State<Real>&, Integrator<Real>&, const State<Real>&, const Tolerances&, \
                                    const Vec<double>&, Solution<Real>&, const Monitor<Real>&,                    \
                                    const std::optional<Real>&);
IRK_ERROR_BAR(double)
IRK_ERROR_BAR(BigFloat)
#undef IRK_ERROR_BAR

}  // namespace irk
