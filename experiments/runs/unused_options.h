// Refuses options of `irk solve` that have no effect on the chosen run.
#pragma once

#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// The fields of a spec that peers use; all others are refused with a peer.
const std::vector<std::string>& peerFields();

/// `given` lists the fields that the user set, including `tol` and `step`. Throws Misuse for a field without effect,
/// naming the reason, or the fields that a peer uses.
void refuseUnused(const RunSpec& spec, const std::vector<std::string>& given);

}  // namespace irk
