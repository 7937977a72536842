// The calling sequences of Petzold's DDASSL and DDASPK (with its direct solvers), for a library that the user has
// compiled from them. Brenan, Campbell & Petzold, Numerical Solution of Initial-Value Problems in DAEs (1996).
#pragma once

#include <memory>
#include <string_view>

#include "experiments/own/shared_library.h"
#include "irk/peer.h"

namespace irk {

/// The peer `code` (ddassl or ddaspk) of a library, or an entry without `make` if it is none of these codes. The
/// library stays loaded with the entry. Throws Misuse if the library does not contain the code.
PeerEntry dasslPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code);

}  // namespace irk
