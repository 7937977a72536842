#include "experiments/analyses/newmark.h"

#include <algorithm>
#include <limits>

#include "experiments/runs/setup.h"

namespace irk {
namespace {

constexpr double kBeta = 0.25, kGamma = 0.5;
constexpr double kStep = 0.01;
constexpr int kSteps = 100;
constexpr int kIterations = 60;  // the iteration contracts by about (h^2 / 4) |da/du|, far below 1/2

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
  RunSpec spec;
  spec.scene = "kepler";
  spec.method = "lobatto_iiia_2";
  spec.options.step.control = StepControl::kFixed;
  spec.options.step.h = kStep;
  const auto setup = makeSetup<double>(spec);
  auto integrator = setup.integrator();
  double largest = 0;
  State<double> from = setup.scene.start;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    const State<double> newmark = newmarkStep(*setup.system, from, step.h);
    const double size = std::max(newmark.u.lpNorm<Eigen::Infinity>(), newmark.v.lpNorm<Eigen::Infinity>());
    const double difference = std::max((step.state.u - newmark.u).lpNorm<Eigen::Infinity>(),
                                       (step.state.v - newmark.v).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, difference / (size * std::numeric_limits<double>::epsilon()));
    from = step.state;
  };
  const auto solution = integrator.integrate(setup.scene.start, kSteps * kStep, monitor);
  return solution.outcome == Outcome::kSuccess ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace irk
