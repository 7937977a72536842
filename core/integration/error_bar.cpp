#include "irk/error_bar.h"

#include <algorithm>
#include <cmath>

#include "core/base/constants.h"
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

// Sets `tolerances` and `worst`. `second`: the more accurate result, whose magnitudes count: a result that is wrong and
// large would seem to be within a few tolerances of its own.
template <class Real>
void weigh(const State<Real>& second, const Tolerances& t, const Vec<double>& scale, ErrorBar& bar) {
  Index place = 0;
  const auto add = [&](const Vec<double>& errors, const auto& y) {
    for (Index i = 0; i < errors.size(); ++i, ++place) {
      const double magnitude = place < scale.size() ? scale[place] : 1;
      const double size = errors[i] / t.of(magnitude, static_cast<double>(y[i]));
      // A component that is not finite is the worst one.
      if (bar.worst < 0 || size > bar.tolerances || std::isnan(size)) {
        bar.tolerances = std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
        bar.worst = place;
      }
    }
  };
  bar.tolerances = 0;
  add(bar.u, second.u);
  add(bar.v, second.v);
  add(bar.x, second.x);
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
  second.derivatives = first.derivatives;
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

template <class Real>
ErrorBar measureErrorBar(const State<Real>& result, Integrator<Real>& second, const State<Real>& start,
                         const Tolerances& tolerances, const Vec<double>& scale, Solution<Real>& second_result,
                         const Monitor<Real>& monitor, const std::optional<Real>& t_end) {
  const Index nu = start.u.size(), nx = start.x.size();
  const Sizes sizes{.nu = nu, .nx = nx, .nz = start.w.size() - nu - nx, .discrete = start.d.size()};
  requireState("the result", result, sizes);
  requireScale(scale, sizes);
  IntegratorOptions checked;
  checked.tolerances = tolerances;
  validate(checked);
  SwitchErrors<Real> switches(result);
  Monitor<Real> watched = monitor;
  watched.located = [&](const LocatedSwitch<Real>& at) {
    switches.add(at);
    if (monitor.located) monitor.located(at);
  };
  second_result = second.integrate(start, t_end ? *t_end : result.t, watched);
  ErrorBar bar;
  if (second_result.outcome != Outcome::kSuccess) {
    bar.u = unknown(result.u.size());
    bar.v = unknown(result.v.size());
    bar.x = unknown(result.x.size());
    bar.z = unknown(result.z().size());
    bar.problem = "the second integration ended as " + std::string(name(second_result.outcome));
    if (!second_result.detail.empty()) bar.problem += ": " + second_result.detail;
    return bar;
  }
  const State<Real>& other = second_result.state;
  bar.u = distances<Real>(result.u, other.u) + switches.u;
  bar.v = distances<Real>(result.v, other.v) + switches.v;
  bar.x = distances<Real>(result.x, other.x) + switches.x;
  bar.z = distances<Real>(result.z(), other.z());
  if (t_end) bar.t = std::abs(static_cast<double>(Real(result.t - other.t)));
  weigh(other, tolerances, scale, bar);
  return bar;
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
