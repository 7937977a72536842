#include "irk/error_bar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

#include "core/base/constants.h"
#include "core/integration/small_components.h"
#include "core/integration/unstable_rest.h"
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

// Sets `tolerances`, `worst` and `part_of_motion`. The smaller one of the two results' values counts: one that is wrong
// and large would seem to be within 1 / rtol tolerances of its own. `motion`: of u, v, x.
template <class Real>
void weigh(const State<Real>& first, const State<Real>& second, const Tolerances& t, const Vec<double>& scale,
           const Vec<double>& motion, ErrorBar& bar) {
  Index place = 0;
  const auto add = [&](const Vec<double>& errors, const auto& y, const auto& other) {
    for (Index i = 0; i < errors.size(); ++i, ++place) {
      const double magnitude = place < scale.size() ? scale[place] : 1;
      const auto size_of = [i](const auto& values) { return std::abs(static_cast<double>(values[i])); };
      const double size = errors[i] / t.of(magnitude, std::fmin(size_of(y), size_of(other)));
      if (size * kBarStricter > 1) bar.part_of_motion = std::fmax(bar.part_of_motion, errors[i] / motion[place]);
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

// How far u, v and x go from their start.
template <class Real>
struct Motion {
  const State<Real>& start;
  Vec<double> farthest = Vec<double>::Zero(2 * start.u.size() + start.x.size());

  void follow(const State<Real>& s) {
    Index place = 0;
    const auto add = [&](const auto& y, const auto& from) {
      for (Index i = 0; i < y.size(); ++i, ++place) {
        farthest[place] = std::fmax(farthest[place], std::abs(static_cast<double>(Real(y[i] - from[i]))));
      }
    };
    add(s.u, start.u);
    add(s.v, start.v);
    add(s.x, start.x);
  }
};

// The time that an integration loses by rounding: the solution goes on by h in a step, and the time by the difference
// of two rounded times. It is below round-off unless the times are far larger than the steps, as seconds since 1970
// are.
template <class Real>
struct LostTime {
  Real t;
  double lost = 0;

  void step(const StepRecord<Real>& step) {
    if (!std::is_same_v<Real, double>) return;  // a step's size is not known to more digits, and times have many
    lost += step.h - static_cast<double>(Real(step.t - t));
    t = step.t;
  }
};

// What errors in the times of located switches, and of the end, may have changed in u, v and x, all in all.
template <class Real>
struct TimeErrors {
  Vec<double> u, v, x;

  explicit TimeErrors(const State<Real>& s)
      : u(Vec<double>::Zero(s.u.size())), v(Vec<double>::Zero(s.v.size())), x(Vec<double>::Zero(s.x.size())) {}

  // A switch that comes earlier by the error leaves another state behind, which then goes on for that time.
  void add(const LocatedSwitch<Real>& at) {
    const State<Real> earlier = alongRates(at.earlier, at.behind, Real(at.time_error));
    u += distances<Real>(earlier.u, at.behind.u);
    v += distances<Real>(earlier.v, at.behind.v);
    x += distances<Real>(earlier.x, at.behind.x);
  }
  // The end of the integration is late by so much.
  void addAtEnd(const State<Real>& end, double late) {
    if (late == 0) return;
    u += std::abs(late) * end.v.cwiseAbs().template cast<double>();
    v += std::abs(late) * end.a().cwiseAbs().template cast<double>();
    x += std::abs(late) * end.k().cwiseAbs().template cast<double>();
  }
};

}  // namespace

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
  TimeErrors<Real> times(of.result);
  LostTime<Real> time{of.start.t};
  Motion<Real> motion{of.start};
  watched.accepted = [&motion, &time, look = std::move(watched.accepted)](const StepRecord<Real>& step) {
    motion.follow(step.state);
    time.step(step);
    if (look) look(step);
  };
  watched.located = [&](const LocatedSwitch<Real>& at) {
    times.add(at);
    if (of.monitor.located) of.monitor.located(at);
  };
  other = second.integrate(of.start, of.t_end ? *of.t_end : of.result.t, watched);
  if (other.outcome != Outcome::kSuccess) return unknownBar(of.result, other);
  motion.follow(other.state);  // behind a jump at the end
  if (!of.t_end) times.addAtEnd(other.state, time.lost);
  ErrorBar bar;
  bar.u = distances<Real>(of.result.u, other.state.u) + times.u;
  bar.v = distances<Real>(of.result.v, other.state.v) + times.v;
  bar.x = distances<Real>(of.result.x, other.state.x) + times.x;
  bar.z = distances<Real>(of.result.z(), other.state.z());
  if (of.t_end) bar.t = std::abs(static_cast<double>(Real(of.result.t - other.state.t))) + std::abs(time.lost);
  weigh(of.result, other.state, of.tolerances, of.scale, motion.farthest, bar);
  return bar;
}

template <class Real>
Sizes sizesOf(const State<Real>& s) {
  const Index nu = s.u.size(), nx = s.x.size();
  return {.nu = nu, .nx = nx, .nz = s.w.size() - nu - nx, .discrete = s.d.size()};
}

// Weighs the errors of an integrator by another scale and limits its steps as long as it lives, also if the integration
// throws.
template <class Real>
class Stricter {
 public:
  Stricter(Integrator<Real>& integrator, const Vec<double>& scale, double longest_step) : integrator_(integrator) {
    integrator_.weighErrorsBy(scale);
    integrator_.limitSteps(longest_step);
  }
  ~Stricter() {
    integrator_.weighErrorsBy({});
    integrator_.limitSteps(std::numeric_limits<double>::infinity());
  }
  Stricter(const Stricter&) = delete;
  Stricter& operator=(const Stricter&) = delete;

 private:
  Integrator<Real>& integrator_;
};

template <class Real>
std::string lacks(const SmallComponents<Real>& small, const UnstableRest<Real>& rest, const State<Real>& start) {
  if (small.relativeScale().size() > 0) {
    return "what comes of " + small.names(sizesOf(start)) +
           ", below the absolute tolerance on the way: an integration that controls it there";
  }
  std::ostringstream text;
  text.precision(3);
  text << "how the motion leaves an unstable rest at t = " << rest.t() << ": an integration that follows it there";
  return text.str();
}

template <class Real>
ErrorBar withRemark(ErrorBar bar, const std::string& lacking, const UnstableRest<Real>& rest) {
  if (!bar.known()) return bar;
  bar.remark = lacking;
  if (!lacking.empty() || !rest.vanished()) return bar;
  std::ostringstream text;
  text.precision(3);
  text << "how the motion leaves the rest that is unstable at t = " << rest.t()
       << " is not known: it had come nearer to it than round-off";
  bar.remark = text.str();
  return bar;
}

// The same with what is below the tolerance on the way under control: the integration begins anew with each component
// that is found small, and with shorter steps at each unstable rest. If that fails or takes too many steps, they are
// left as they are, and the bar's remark says so.
template <class Real>
ErrorBar controlledBar(Integrator<Real>& second, const Measured<Real>& of, Solution<Real>& other) {
  const std::int64_t effort = kBarEffort.whole() / static_cast<std::int64_t>(of.start.w.size());
  std::int64_t left = effort;
  std::string lacking;  // what former integrations could not control
  UnstableRest<Real> rest(second.system(), of.tolerances, of.scale, of.start.t, of.t_end ? *of.t_end : of.result.t);
  SmallComponents<Real> small(of.start, of.tolerances, of.scale, rest.watches());
  Monitor<Real> watched = of.monitor;
  watched.accepted = [&](const StepRecord<Real>& step) {
    small.look(step);
    rest.look(step);
    if (rest.follows()) second.limitSteps(rest.limit());
    if (of.monitor.accepted) of.monitor.accepted(step);
  };
  for (;;) {
    const Vec<double> relative_scale = small.relativeScale();
    const bool controls = relative_scale.size() > 0 || rest.follows();
    watched.interrupt = [&] {
      const bool too_long = controls && left-- <= 0;
      if (small.found() || rest.found() || too_long) return Outcome::kTimeout;
      return of.monitor.interrupt ? of.monitor.interrupt() : Outcome::kSuccess;
    };
    small.begin(of.start);
    rest.begin();
    const ErrorBar bar = [&] {
      const Stricter<Real> stricter(second, relative_scale, rest.limit());
      return barBy(second, of, watched, other);
    }();
    if (small.found() || rest.found()) continue;
    if (bar.known()) return withRemark(bar, lacking, rest);
    if (!controls) return bar;
    const std::string ended = left < 0 ? " takes too many steps" : " ends as " + std::string(name(other.outcome));
    lacking = "the bar may lack " + lacks(small, rest, of.start) + ended;
    if (rest.leaveDecays()) {
      left = effort;
      continue;
    }
    return withRemark(barBy(second, of, of.monitor, other), lacking, rest);
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

bool asksForStricter(const ErrorBar& bar) { return bar.known() && bar.part_of_motion > kBarStricter; }

ErrorBar larger(const ErrorBar& a, const ErrorBar& b) {
  ErrorBar result = a.tolerances < b.tolerances ? b : a;  // has `tolerances`, `worst` and `remark` of the larger one
  result.u = a.u.cwiseMax(b.u);
  result.v = a.v.cwiseMax(b.v);
  result.x = a.x.cwiseMax(b.x);
  result.part_of_motion = std::fmax(a.part_of_motion, b.part_of_motion);
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
