// Builds scene, system, methods and options of a run from its spec. This is the only place that combines them.
#pragma once

#include <memory>

#include "experiments/runs/run_spec.h"
#include "irk/integrator.h"
#include "irk/scene.h"
#include "irk/tableau.h"

namespace irk {

/// Copies share the system, which is immutable (except with `first_order`: use one per thread).
template <class Real>
struct Setup {
  RunSpec spec;  ///< resolved
  Scene<Real> scene;
  std::shared_ptr<const System<Real>> system;
  Methods<Real> methods;
  Vec<double> scale;  ///< of the system's components u, v, x, z

  Index stages() const { return methods.members()[methods.start].stages(); }
  /// Throws Misuse for combinations that cannot work.
  Integrator<Real> integrator() const { return integrator(methods, spec.options); }
  /// What is said beside the detail of a run with this outcome: which constraints are left out, which formulation
  /// solves it, that it has taken one thread; empty if there is nothing to say.
  std::string advice(Outcome outcome) const;
  /// An integrator of the same system with other methods and options.
  Integrator<Real> integrator(const Methods<Real>& others, const IntegratorOptions& options) const {
    return {system, others, options, scale};
  }
};

/// That an integration of so many unknowns takes one thread, and why; empty if the spec asks for one, or if it takes as
/// many as the spec asks for.
std::string oneThreadText(const RunSpec& spec, Index unknowns);
/// The same for the system of the spec, which its formulation makes; empty for an integrator of another library.
std::string oneThreadText(const RunSpec& spec);

/// The setup of a resolved spec and its scene: makes the system and the method's coefficients. Throws Misuse as
/// makeSetup.
template <class Real>
Setup<Real> setUp(RunSpec spec, Scene<Real> scene);

/// The integrator of a resolved spec and its scene with all that a program makes for it, system and methods: what the
/// time of a whole call begins with. Throws Misuse as makeSetup.
template <class Real>
Integrator<Real> newIntegrator(const RunSpec& spec, const Scene<Real>& scene);

/// The magnitudes that an integrator multiplies atol by: those of the system's components (systemScale), replaced where
/// the spec's `atol_of` names a component. Throws Misuse for a name that the scene does not have.
template <class Real>
Vec<double> toleranceScale(const Scene<Real>& scene, const RunSpec& spec, const Sizes& system);

/// Magnitudes of a system's components from those of its scene: 1 for unknowns that the formulation adds; cut off
/// where it eliminates unknowns.
Vec<double> systemScale(const Vec<double>& scene, const Sizes& system);

/// Throws Misuse for every spec that can never work: unknown ids, settings out of range, a peer as method, a family
/// without a number of stages at fixed order, a scalar that the scene does not support.
template <class Real>
Setup<Real> makeSetup(const RunSpec& spec);

/// The scene of a spec with its settings, including those that depend on the step (`lambda=-1e8/h`). Throws Misuse as
/// makeScene.
template <class Real>
Scene<Real> sceneOf(const RunSpec& spec);

/// The scene's start with these values of components of u, v, x. Throws Misuse for another name and for a text that is
/// no number.
template <class Real>
State<Real> startWith(const Scene<Real>& scene, const Settings& components);

}  // namespace irk
