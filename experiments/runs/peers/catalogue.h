// All peers, as ids of methods.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/runs/peers/peer.h"
#include "experiments/runs/run_spec.h"

namespace irk {

struct PeerEntry {
  std::string id;
  std::string title;
  bool differential_algebraic;  ///< takes F(t, y, y') = 0; else y' = f(t, y)
  bool finds_roots;             ///< of switching functions
  std::unique_ptr<Peer> (*make)(const PeerSetup&);
};

/// Sorted by id. Ids never change.
const std::vector<PeerEntry>& peerCatalogue();

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

}  // namespace irk
