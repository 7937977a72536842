// The method of a run with its scene: one of the suite, or an integrator of another library, behind one interface.
#pragma once

#include <string>
#include <utility>

#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/setup.h"
#include "experiments/runs/texts/component_names.h"
#include "irk/integrator.h"
#include "irk/tableaus.h"

namespace irk {

/// An implicit Runge-Kutta method of the suite.
template <class Real>
class RungeKutta {
 public:
  explicit RungeKutta(const RunSpec& spec) : setup_(makeSetup<Real>(spec)), integrator_(setup_.integrator()) {}

  const RunSpec& spec() const { return setup_.spec; }
  const Scene<Real>& scene() const { return setup_.scene; }
  const std::string& family() const { return setup_.methods.members().front().family; }
  /// 0 for a family: the order controller chooses the stages.
  Index stages() const { return isFamily(setup_.spec.method) ? 0 : setup_.stages(); }
  Integrator<Real> newIntegrator() const { return irk::newIntegrator(setup_.spec, setup_.scene); }
  Solution<Real> integrate(const State<Real>& start, const Real& t_end, const Monitor<Real>& monitor) {
    auto solution = integrator_.integrate(start, t_end, monitor);
    if (solution.detail.find('[') != std::string::npos) {
      const Sizes sizes{.nu = start.u.size(), .nx = start.x.size(), .nz = start.z().size()};
      solution.detail = withNames(solution.detail, scene().names, sizes, setup_.system->sizes());
    }
    const std::string advice = setup_.advice(solution.outcome);
    if (!solution.detail.empty() && !advice.empty()) solution.detail += "; ";
    solution.detail += advice;
    return solution;
  }

 private:
  Setup<Real> setup_;
  Integrator<Real> integrator_;
};

/// An integrator of another library.
class PeerMethod {
 public:
  explicit PeerMethod(const RunSpec& spec)
      : spec_(resolved(spec)),
        scene_(sceneOf<double>(spec_)),
        entry_(*findPeer(spec_.method)),
        integrator_(entry_, scene_, spec_) {}

  const RunSpec& spec() const { return spec_; }
  const Scene<double>& scene() const { return scene_; }
  const std::string& family() const { return entry_.id; }
  Index stages() const { return 0; }
  PeerIntegrator newIntegrator() const { return {entry_, scene_, spec_}; }
  Solution<double> integrate(const State<double>& start, double t_end, const Monitor<double>& monitor) {
    return integrator_.integrate(start, t_end, monitor);
  }

 private:
  RunSpec spec_;
  Scene<double> scene_;
  const PeerEntry& entry_;
  PeerIntegrator integrator_;
};

}  // namespace irk
