// The calling sequences of Hairer and Wanner's codes RADAU, RADAU5, RODAS and SEULEX, for a library that the user has
// compiled from them. HW II, appendix; the comments at the head of each code.
#pragma once

#include <memory>
#include <string_view>

#include "experiments/own/shared_library.h"
#include "irk/peer.h"

namespace irk {

/// The peer `code` of a library, or an entry without `make` if it is none of these codes. The library stays loaded
/// with the entry. Throws Misuse if the library does not contain the code.
PeerEntry hairerPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code);

}  // namespace irk
