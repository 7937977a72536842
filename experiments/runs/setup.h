// What a run is made of, from its spec: the one place where scene, system, methods and options come together.
#pragma once

#include <memory>

#include "experiments/runs/run_spec.h"
#include "irk/integrator.h"
#include "irk/scene.h"
#include "irk/tableau.h"

namespace irk {

/// A value: copies share the system, which is immutable (but for `first_order`: one per thread).
template <class Real>
struct Setup {
  RunSpec spec;  ///< resolved
  Scene<Real> scene;
  std::shared_ptr<const System<Real>> system;
  Methods<Real> methods;
  Vec<double> scale;  ///< of the system's components u, v, x, z

  Index stages() const { return methods.members[methods.start].stages(); }
  /// Throws Misuse for combinations that cannot work.
  Integrator<Real> integrator() const { return integrator(methods, spec.options); }
  /// The same system with other methods and options.
  Integrator<Real> integrator(const Methods<Real>& others, const IntegratorOptions& options) const {
    return {system, others, options, scale};
  }
};

/// Magnitudes of a system's components from those of its scene: 1 for unknowns that only the formulation has; cut off
/// where it has eliminated some.
Vec<double> systemScale(const Vec<double>& scene, const Sizes& system);

/// Throws Misuse for everything that can never work: unknown ids, settings out of range, a peer as method, a family
/// without a number of stages where the order is fixed, a scalar that the scene does not have.
template <class Real>
Setup<Real> makeSetup(const RunSpec& spec);

/// The scene of a spec with its settings, those over the step (`lambda=-1e8/h`) included. Throws Misuse as makeScene.
template <class Real>
Scene<Real> sceneOf(const RunSpec& spec);

}  // namespace irk
