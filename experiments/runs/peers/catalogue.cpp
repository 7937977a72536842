#include "experiments/runs/peers/catalogue.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/options/fixed_steps.h"
#include "experiments/own/files.h"
#include "irk/misuse.h"
#include "irk/registration.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr bool kRoots = true, kNoRoots = false;

std::string titleOfGsl(const std::string& title) {
  return hasGsl() ? title : title + " (not in this program: IRK_GSL=OFF)";
}

std::deque<PeerEntry>& entries() {
  static std::deque<PeerEntry> all{
      {"arkode_dirk", "SUNDIALS ARKODE, diagonally implicit Runge-Kutta, order 5", PeerForm::kOde, 1, kRoots,
       makeArkode},
      {"cvode_bdf", "SUNDIALS CVODE, BDF of orders 1 to 5", PeerForm::kOde, 1, kRoots, makeCvode},
      {"gsl_bsimp", titleOfGsl("GSL, Bader and Deuflhard's extrapolation"), PeerForm::kOde, 1, kNoRoots, makeGslBsimp},
      {"gsl_msbdf", titleOfGsl("GSL, BDF of orders 1 to 5"), PeerForm::kOde, 1, kNoRoots, makeGslMsbdf},
      {"gsl_rk4imp", titleOfGsl("GSL, 2-stage Gauss, order 4"), PeerForm::kOde, 1, kNoRoots, makeGslRk4imp},
      {"ida_bdf", "SUNDIALS IDA, BDF of orders 1 to 5 for DAEs of index 1 and 2", PeerForm::kDae, 2, kRoots, makeIda}};
  return all;
}

}  // namespace

const std::deque<PeerEntry>& peerCatalogue() { return entries(); }

const PeerEntry* findPeer(std::string_view id) {
  const auto& all = entries();
  const auto at = std::find_if(all.begin(), all.end(), [id](const auto& p) { return p.id == id; });
  return at == all.end() ? nullptr : &*at;
}

void registerPeer(PeerEntry entry) {
  const auto refuse = [&entry](const std::string& reason) {
    throw Misuse(fmt::format("method '{}' ({}): {}", entry.id, entry.title, reason));
  };
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (entry.id.empty() || entry.id.find_first_not_of(kAllowed) != std::string::npos) {
    refuse("an id consists of letters, digits, '_', '-' and '.'");
  }
  if (entry.title.empty()) refuse("it has no title, the line of `irk list methods`");
  if (!entry.make) refuse("it has no function 'make'");
  if (entry.max_index < 1 || entry.max_index > 3) {
    refuse(fmt::format("max_index = {}: 1 to 3 is allowed", entry.max_index));
  }
  if (const PeerEntry* other = findPeer(entry.id)) {
    refuse(fmt::format("the id is taken by '{}' ({})", other->id, other->title));
  }
  for (const auto& family : familyCatalogue()) {
    if (entry.id == family.id || entry.id.starts_with(family.id + "_")) {
      refuse(fmt::format("the id is taken by the family '{}' ({})", family.id, family.title));
    }
  }
  if (entry.source.empty()) entry.source = own::hashOfFile(registeringSource());
  entries().push_back(std::move(entry));
}

namespace {

template <class E>
void refuse(const PeerEntry& peer, E value, std::string_view reason) {
  throw Misuse(
      fmt::format("illegal combination: method '{}' with {} '{}': {}", peer.id, axisName<E>(), idOf(value), reason));
}

void refuseFormulation(const PeerEntry& peer, Formulation formulation) {
  const bool explicit_form = formulation == Formulation::kIndex1 || formulation == Formulation::kFirstOrder ||
                             formulation == Formulation::kFirstOrderPerStep;
  if (!peer.takesConstraints() && !explicit_form) {
    refuse(peer, formulation,
           "it solves ordinary differential equations only; use formulation 'index1', where "
           "constraints drift");
  }
  const bool index2 = !explicit_form && formulation != Formulation::kIndex3;
  if (peer.takesConstraints() && index2 && peer.max_index < 2) {
    refuse(peer, formulation, "it solves up to index 1; use formulation 'index1', where constraints drift");
  }
  if (formulation == Formulation::kIndex3 && peer.max_index < 3) {
    refuse(peer, formulation, fmt::format("it solves up to index {}", peer.max_index));
  }
  if (formulation == Formulation::kIndex2Projected) {
    refuse(peer, formulation, "it does not project; use 'index2' or 'ggl'");
  }
}

}  // namespace

void refuseIllegal(const PeerEntry& peer, const RunSpec& spec, const Sizes& scene) {
  if (!spec.scalar.isDouble()) {
    refuse(peer, spec.scalar, "the library computes in double precision");
  }
  if (hasFixedSteps(spec.options.step)) {
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
  if (spec.constraints != ConstraintUse::kAll) refuse(peer, spec.constraints, "it takes all constraints");
  if (!spec.options.stop_at.empty() || spec.options.steady > 0) {
    throw Misuse("illegal combination: method '" + peer.id + "' with stop_at or steady: a peer goes to t_end");
  }
  if (scene.constraints > 0) refuseFormulation(peer, spec.formulation);
}

}  // namespace irk
