// All peers, as ids of methods.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "experiments/runs/run_spec.h"
#include "irk/peer.h"
#include "irk/system.h"

namespace irk {

/// Those of the program sorted by id, then those that were registered. Ids never change; an entry keeps its address.
const std::deque<PeerEntry>& peerCatalogue();

/// Returns nullptr if no peer has this id.
const PeerEntry* findPeer(std::string_view id);

/// Throws Misuse for a spec that the peer cannot run, naming both ids and the reason.
void refuseIllegal(const PeerEntry& peer, const RunSpec& spec, const Sizes& scene);

std::unique_ptr<Peer> makeArkode(const PeerSetup& setup);
std::unique_ptr<Peer> makeCvode(const PeerSetup& setup);
std::unique_ptr<Peer> makeGslBsimp(const PeerSetup& setup);
std::unique_ptr<Peer> makeGslMsbdf(const PeerSetup& setup);
std::unique_ptr<Peer> makeGslRk4imp(const PeerSetup& setup);
std::unique_ptr<Peer> makeIda(const PeerSetup& setup);

/// Whether this program has GSL's integrators (IRK_GSL). If not, their functions above throw Misuse.
bool hasGsl();

}  // namespace irk
