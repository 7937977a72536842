#include "experiments/runs/peers/catalogue.h"

#include <fmt/format.h>

#include <algorithm>

namespace irk {

const std::vector<PeerEntry>& peerCatalogue() {
  static const std::vector<PeerEntry> entries{
      {"arkode_dirk", "SUNDIALS ARKODE, diagonally implicit Runge-Kutta, order 5", false, true, makeArkode},
      {"cvode_bdf", "SUNDIALS CVODE, BDF of orders 1 to 5", false, true, makeCvode},
      {"gsl_bsimp", "GSL, Bader and Deuflhard's extrapolation", false, false, makeGslBsimp},
      {"gsl_msbdf", "GSL, BDF of orders 1 to 5", false, false, makeGslMsbdf},
      {"gsl_rk4imp", "GSL, 2-stage Gauss, order 4", false, false, makeGslRk4imp},
      {"ida_bdf", "SUNDIALS IDA, BDF of orders 1 to 5 for DAEs of index 1 and 2", true, true, makeIda}};
  return entries;
}

const PeerEntry* findPeer(std::string_view id) {
  const auto& all = peerCatalogue();
  const auto at = std::find_if(all.begin(), all.end(), [id](const auto& p) { return p.id == id; });
  return at == all.end() ? nullptr : &*at;
}

namespace {

template <class E>
void refuse(const PeerEntry& peer, E value, const char* reason) {
  throw Misuse(
      fmt::format("illegal combination: method '{}' with {} '{}': {}", peer.id, axisName<E>(), idOf(value), reason));
}

void refuseFormulation(const PeerEntry& peer, Formulation formulation) {
  const bool explicit_form = formulation == Formulation::kIndex1 || formulation == Formulation::kFirstOrder;
  if (!peer.differential_algebraic && !explicit_form) {
    refuse(peer, formulation,
           "it solves ordinary differential equations only; use formulation 'index1', where "
           "constraints drift");
  }
  if (formulation == Formulation::kIndex3) refuse(peer, formulation, "it solves up to index 2");
  if (formulation == Formulation::kIndex2Projected) {
    refuse(peer, formulation, "it does not project; use 'index2' or 'ggl'");
  }
}

}  // namespace

void refuseIllegal(const PeerEntry& peer, const RunSpec& spec, const Sizes& scene) {
  if (spec.scalar != ScalarKind::kDouble) {
    refuse(peer, spec.scalar, "the library computes in double precision");
  }
  if (spec.options.step.control == StepControl::kFixed) {
    refuse(peer, StepControl::kFixed, "a peer chooses its own steps");
  }
  if (spec.options.tolerances.norm != NormKind::kMixed) {
    refuse(peer, spec.options.tolerances.norm, "the libraries weigh by rtol |y| + atol");
  }
  if (spec.discontinuity == Discontinuity::kIterate) {
    refuse(peer, spec.discontinuity, "a peer's steps cannot be repeated from outside");
  }
  if (scene.switches > 0 && spec.discontinuity == Discontinuity::kLocate && !peer.finds_roots) {
    refuse(peer, spec.discontinuity, "the library has no root finding");
  }
  if (scene.constraints > 0) refuseFormulation(peer, spec.formulation);
}

}  // namespace irk
