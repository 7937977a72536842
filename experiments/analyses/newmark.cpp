#include "experiments/analyses/newmark.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "irk/integrator.h"
#include "irk/problem.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr double kBeta = 0.25, kGamma = 0.5;
constexpr double kStepSizes[] = {0.002, 0.005, 0.01, 0.02};
constexpr int kSteps = 100;
constexpr int kIterations = 60;  // the iteration contracts by about (h / 2) |da/dv| + (h^2 / 4) |da/du|, far below 1/2

// u'' = -u - u^3 - 0.3 v + 0.5 cos(1.2 t): a spring that stiffens.
struct Duffing {
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T& u = p.u[0];
    r.u[0] = -u - u * u * u - 0.3 * p.v[0] + 0.5 * cos(1.2 * p.t) - p.a[0];
  }
};

// u'' = -4 sin(u) - 0.2 v + 2 cos(t): a driven pendulum.
struct DrivenPendulum {
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos, std::sin;
    r.u[0] = -4.0 * sin(p.u[0]) - 0.2 * p.v[0] + 2.0 * cos(p.t) - p.a[0];
  }
};

// A unit mass that is attracted by 1 / r^2, in air that moves to and fro.
struct DampedOrbit {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin, std::sqrt;
    const T r2 = p.u[0] * p.u[0] + p.u[1] * p.u[1];
    const T speed = sqrt(1.0 + p.v[0] * p.v[0] + p.v[1] * p.v[1]);
    for (Index i = 0; i < 2; ++i) {
      r.u[i] = -p.u[i] / (r2 * sqrt(r2)) - 0.1 * speed * (p.v[i] - 0.5 * sin(2.0 * p.t)) - p.a[i];
    }
  }
};

// a(t, u, v) for the residual f(t, u, v) - M a with a unit mass matrix.
Vec<double> acceleration(const System<double>& system, const State<double>& at) {
  State<double> rest = at;
  rest.w.setZero();
  Vec<double> r(system.sizes().n());
  system.evaluate(Level::kFormulated, pointOf(rest), {r.data(), r.size()});
  return r;
}

State<double> newmarkStep(const System<double>& system, const State<double>& from, double h) {
  const Vec<double> a0 = acceleration(system, from);
  Vec<double> a1 = a0;
  State<double> to = from;
  to.t = from.t + h;
  for (int i = 0; i < kIterations; ++i) {
    to.u = from.u + h * from.v + h * h * ((0.5 - kBeta) * a0 + kBeta * a1);
    to.v = from.v + h * ((1 - kGamma) * a0 + kGamma * a1);
    a1 = acceleration(system, to);
  }
  return to;
}

// The largest difference of all steps from the start (1, 0, ...) with velocities (0, ..., 1).
template <class Problem>
double largestDifference(const Problem& problem, double h) {
  const auto system = makeSystem<double>(problem);
  IntegratorOptions options;
  options.step.control = StepControl::kFixed;
  options.step.h = h;
  Integrator<double> integrator(system, makeTableau<double>("lobatto_iiia_2"), options);
  State<double> from(problem.sizes());
  from.u[0] = 1;
  from.v[from.v.size() - 1] = 1;
  double largest = 0;
  Monitor<double> monitor;
  const State<double> start = from;
  monitor.accepted = [&](const StepRecord<double>& step) {
    const State<double> newmark = newmarkStep(*system, from, step.h);
    const double size = std::max(newmark.u.lpNorm<Eigen::Infinity>(), newmark.v.lpNorm<Eigen::Infinity>());
    const double difference = std::max((step.state.u - newmark.u).lpNorm<Eigen::Infinity>(),
                                       (step.state.v - newmark.v).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, difference / (size * std::numeric_limits<double>::epsilon()));
    from = step.state;
  };
  const auto solution = integrator.integrate(start, kSteps * h, monitor);
  return solution.outcome == Outcome::kSuccess ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<NewmarkDifference> newmarkDifferences() {
  std::vector<NewmarkDifference> all;
  for (const double h : kStepSizes) {
    all.push_back({"duffing", h, largestDifference(Duffing{}, h)});
    all.push_back({"driven_pendulum", h, largestDifference(DrivenPendulum{}, h)});
    all.push_back({"damped_orbit", h, largestDifference(DampedOrbit{}, h)});
  }
  return all;
}

}  // namespace irk
