// Problems with parameters, over numbers or lanes, and ensembles of them.
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "irk/ensemble.h"
#include "irk/integrator.h"
#include "irk/problem.h"
#include "irk/tableaus.h"
#include "tests/core/problems.h"

namespace irk::test {

/// Van der Pol's oscillator with a force: nonlinear, stiff, non-autonomous.
template <class Real>
struct ForcedOscillator {
  Real mu;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = p.x[1] - p.k[0];
    r.x[1] = mu * ((1 - p.x[0] * p.x[0]) * p.x[1] - p.x[0]) + cos(p.t) - p.k[1];
  }
  static void start(State<double>& s, double) { s.x << 1.5, 0; }
};

/// y' = c y^2 with y(0) = 1: infinite at t = 1 / c.
template <class Real>
struct Blowup {
  Real c;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = c * (p.x[0] * p.x[0]) - p.k[0];
  }
  static void start(State<double>& s, double) { s.x << 1; }
};

/// y' = -c (y - sin t) + cos t with y = sin t.
template <class Real>
struct Tracking {
  Real c;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.x[0] = c * (sin(p.t) - p.x[0] * p.x[0] * p.x[0] + sin(p.t) * (sin(p.t) * sin(p.t) - 1)) + cos(p.t) - p.k[0];
  }
  static void start(State<double>&, double) {}
};

/// The systems of a problem with these parameters, all to one end.
template <template <class> class P>
struct Members {
  std::vector<double> parameters;
  double t_end;
  Formulation formulation = Formulation::kIndex2;

  EnsembleMember member(std::size_t i) const {
    const double parameter = parameters[i];
    const auto system = makeSystem<double>(P<double>{parameter}, {formulation});
    EnsembleMember member{system, State<double>(system->sizes()), t_end};
    P<double>::start(member.start, parameter);
    return member;
  }
  Ensemble ensemble() const {
    return {[this](std::size_t i) { return member(i); },
            [this](const std::array<std::size_t, kLanes>& at) -> std::shared_ptr<const System<Lanes>> {
              const P<Lanes> problem{Lanes::each([&](std::size_t k) { return parameters[at[k]]; })};
              return std::make_shared<const ProblemSystem<P<Lanes>, Lanes>>(problem, SystemOptions{formulation});
            }};
  }
};

/// The results of the members that `order` names, by member.
inline std::vector<Solution<double>> inLanes(const Ensemble& ensemble, const std::vector<std::size_t>& order,
                                             const std::string& method, const IntegratorOptions& options) {
  std::vector<Solution<double>> all(order.size());
  LaneIntegrator integrator(makeTableau<double>(method), options);
  std::size_t next = 0;
  integrator.integrate(
      ensemble, [&] { return next < order.size() ? std::optional(order[next++]) : std::nullopt; },
      [&](std::size_t i, Solution<double> solution) { all[i] = std::move(solution); });
  return all;
}

inline std::vector<std::size_t> inOrder(std::size_t count) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  return order;
}

inline IntegratorOptions lanesAt(double tolerance) {
  IntegratorOptions options = laneOptions({});
  options.tolerances.rtol = options.tolerances.atol = tolerance;
  return options;
}

}  // namespace irk::test
