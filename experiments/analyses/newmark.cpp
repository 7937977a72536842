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
constexpr double kStep = 0.01;
constexpr int kSteps = 100;
constexpr int kIterations = 60;  // the iteration contracts by about (h^2 / 4) |da/du|, far below 1/2

// A unit mass that is attracted by 1 / r^2.
struct Orbit {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T r2 = p.u[0] * p.u[0] + p.u[1] * p.u[1];
    for (Index i = 0; i < 2; ++i) r.u[i] = -p.u[i] / (r2 * sqrt(r2)) - p.a[i];
  }
  // At the pericentre of an ellipse of eccentricity 0.6.
  State<double> start() const {
    State<double> s(sizes());
    s.u << 0.4, 0;
    s.v << 0, 2;
    return s;
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

}  // namespace

double newmarkDifference() {
  const auto system = makeSystem<double>(Orbit{});
  IntegratorOptions options;
  options.step.control = StepControl::kFixed;
  options.step.h = kStep;
  Integrator<double> integrator(system, makeTableau<double>("lobatto_iiia_2"), options);
  double largest = 0;
  State<double> from = Orbit{}.start();
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    const State<double> newmark = newmarkStep(*system, from, step.h);
    const double size = std::max(newmark.u.lpNorm<Eigen::Infinity>(), newmark.v.lpNorm<Eigen::Infinity>());
    const double difference = std::max((step.state.u - newmark.u).lpNorm<Eigen::Infinity>(),
                                       (step.state.v - newmark.v).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, difference / (size * std::numeric_limits<double>::epsilon()));
    from = step.state;
  };
  const auto solution = integrator.integrate(Orbit{}.start(), kSteps * kStep, monitor);
  return solution.outcome == Outcome::kSuccess ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace irk
