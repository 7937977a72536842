// Solvers in shared libraries of the user, by their calling sequence. A library stays loaded with its entry.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "experiments/own/shared_library.h"
#include "irk/peer.h"

namespace irk {

/// A library that exports the functions of irk/peer_c.h. Throws Misuse for a missing function, another version of the
/// interface, and a description out of range.
PeerEntry cPeer(const std::shared_ptr<const SharedLibrary>& library, const std::string& id);

/// Hairer and Wanner's codes RADAU, RADAU5, RODAS and SEULEX. HW II, appendix; the comments at the head of each code.
/// An entry without `make` if `code` is none of them. Throws Misuse if the library does not contain the code.
PeerEntry hairerPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code);

/// The same for Petzold's ddassl and ddaspk (with its direct solvers). Brenan, Campbell & Petzold, Numerical Solution
/// of Initial-Value Problems in DAEs (1996).
PeerEntry dasslPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code);

}  // namespace irk
