#include "core/ensemble/lane_rules.h"

#include <algorithm>
#include <string>

#include "core/options/fixed_steps.h"
#include "irk/system_check.h"

namespace irk {
namespace {

template <class E>
void requireSame(E given, E needed) {
  if (given == needed) return;
  throw Misuse("an ensemble in lanes with " + std::string(axisName<E>()) + " '" + std::string(idOf(given)) +
               "': lanes have '" + std::string(idOf(needed)) + "' only");
}

[[noreturn]] void refuseSystem(const std::string& what) { throw Misuse("an ensemble in lanes with " + what); }

std::string text(const Sizes& n) {
  return "nu, nx, nz, constraints = " + std::to_string(n.nu) + ", " + std::to_string(n.nx) + ", " +
         std::to_string(n.nz) + ", " + std::to_string(n.constraints);
}

void requireSameForm(const LaneForm& given, const LaneForm& first) {
  if (given.sizes != first.sizes) {
    refuseSystem("systems of different sizes: " + text(given.sizes) + " after " + text(first.sizes));
  }
  if (given.row_powers == first.row_powers && given.error_powers == first.error_powers) return;
  refuseSystem("systems of different formulations: their powers of h differ");
}

}  // namespace

IntegratorOptions laneOptions(IntegratorOptions options) {
  options.derivatives = DerivativeSource::kAutomatic;
  options.jacobian_point = JacobianPoint::kPredicted;
  options.jacobian = JacobianTerms::kFull;
  options.newton.kind = NewtonKind::kSimplified;
  options.solver = StageSolverKind::kEigen;
  options.predictor = Predictor::kExtrapolated;
  options.summation = Summation::kCompensated;
  options.order = OrderControl::kFixed;
  options.step.estimate = ErrorEstimate::kEmbedded;
  options.guards = Guards::kAll;
  options.tolerances.norm = NormKind::kMixed;
  return options;
}

IntegratorOptions legalInLanes(const IntegratorOptions& options) {
  validate(options);
  const IntegratorOptions lanes = laneOptions(options);
  requireSame(options.derivatives, lanes.derivatives);
  requireSame(options.jacobian_point, lanes.jacobian_point);
  requireSame(options.jacobian, lanes.jacobian);
  requireSame(options.newton.kind, lanes.newton.kind);
  requireSame(options.solver, lanes.solver);
  requireSame(options.predictor, lanes.predictor);
  requireSame(options.summation, lanes.summation);
  requireSame(options.order, lanes.order);
  requireSame(options.step.estimate, lanes.step.estimate);
  requireSame(options.guards, lanes.guards);
  requireSame(options.tolerances.norm, lanes.tolerances.norm);
  if (!options.stop_at.empty() || options.steady > 0) {
    throw Misuse("an ensemble in lanes with stop_at or steady: all lanes go to t_end; without lanes: --single");
  }
  if (hasFixedSteps(options.step)) {
    throw Misuse("an ensemble in lanes with control 'fixed': lanes choose their steps by the error estimate");
  }
  return lanes;
}

void requireLaneMethod(const Scheme<double>& scheme) {
  const bool damps = dampsStiffErrors(scheme);
  if (scheme.stiffly_accurate && scheme.regular && scheme.first == 0 && damps && scheme.tableau.stage_order > 0) return;
  throw Misuse("an ensemble in lanes with method '" + scheme.tableau.id +
               "': lanes need a stiffly accurate method with invertible A and R(infinity) = 0, as radau_iia and "
               "lobatto_iiic");
}

void requireLaneMember(const EnsembleMember& member, const LaneForm* others) {
  requireSystem(member.system.get(), member.scale);
  const System<double>& system = *member.system;
  const Sizes n = system.sizes();
  if (n.switches > 0 || n.discrete > 0 || !system.times().empty()) {
    refuseSystem("a system that switches: each lane would need residuals of its own");
  }
  if (system.projectsVelocity()) refuseSystem("formulation 'index2_projected': lanes do not project velocities");
  if (!system.secondOrder()) refuseSystem("formulation 'ggl' or 'first_order': lanes have index1, index2 and index3");
  const auto& powers = system.errorPowers().z;
  if (std::any_of(powers.begin() + n.constraints, powers.end(), [](int power) { return power > 0; })) {
    refuseSystem("algebraic unknowns of index 2 that are no multipliers of position constraints");
  }
  if (n.n() > kMostLaneUnknowns) {
    refuseSystem(std::to_string(n.n()) + " unknowns: lanes have dense Jacobians of up to " +
                 std::to_string(kMostLaneUnknowns));
  }
  if (others) requireSameForm(LaneForm(system), *others);
}

void requireLaneSystem(const System<Lanes>* system, const LaneForm& members) {
  if (!system) refuseSystem("null from its function `lanes`: the system of eight members is expected");
  requireSameForm(LaneForm(*system), members);
}

}  // namespace irk
