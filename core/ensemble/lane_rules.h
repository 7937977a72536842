// The limits of lanes. Each function throws Misuse that names the option, the method or the property.
#pragma once

#include <vector>

#include "core/stages/scheme.h"
#include "irk/ensemble.h"

namespace irk {

/// Returns `options` if they are in range and have the strategies of laneOptions.
IntegratorOptions legalInLanes(const IntegratorOptions& options);
void requireLaneMethod(const Scheme<double>& scheme);

/// What the systems of an ensemble have in common.
struct LaneForm {
  Sizes sizes;
  std::vector<int> row_powers;
  ErrorPowers error_powers;

  template <class Real>
  explicit LaneForm(const System<Real>& system)
      : sizes(system.sizes()), row_powers(system.rowPowers()), error_powers(system.errorPowers()) {}
};

/// Checks the system of a member. `others`: the form of the ensemble's systems so far, or null.
void requireLaneMember(const EnsembleMember& member, const LaneForm* others);
/// Checks the system that Ensemble::lanes has made for members of the form `members`.
void requireLaneSystem(const System<Lanes>* system, const LaneForm& members);

}  // namespace irk
