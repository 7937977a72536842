// Options of `irk solve` that the chosen run would not look at.
#pragma once

#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// Fields of a spec that the integrators of other libraries take; the others are refused with a peer.
const std::vector<std::string>& peerFields();

/// `given`: the fields that the user set one by one, `tol` and `step` among them. Throws Misuse for one that would
/// change nothing: what it needs, or what a peer takes.
void refuseUnused(const RunSpec& spec, const std::vector<std::string>& given);

}  // namespace irk
