// Solvers in shared libraries with the interface irk/peer_c.h.
#pragma once

#include <memory>
#include <string>

#include "experiments/own/shared_library.h"
#include "irk/peer.h"

namespace irk {

/// The peer of a library that exports the functions of irk/peer_c.h; the library stays loaded with it. Throws Misuse
/// for a missing function, another version of the interface, and a description out of range.
PeerEntry cPeer(const std::shared_ptr<const SharedLibrary>& library, const std::string& id);

}  // namespace irk
