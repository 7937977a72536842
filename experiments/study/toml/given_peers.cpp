#include "experiments/study/toml/given_peers.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "irk/misuse.h"

namespace irk {
namespace {

bool isAmong(const std::vector<std::string>& items, std::string_view item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

// The integrator of the program that takes the same equations.
std::string_view likeOf(const PeerEntry& peer) {
  return peer.takesConstraints() && peer.max_index >= 2 ? "ida_bdf" : "cvode_bdf";
}

const PeerEntry& peerOf(const std::string& given) {
  if (const PeerEntry* peer = findPeer(loadMethod(given))) return *peer;
  throw Misuse(
      fmt::format("--peers: '{}' is no integrator of another library: CODE@PATH.so, PATH.so or PATH.cpp is "
                  "expected",
                  given));
}

}  // namespace

void addPeers(const std::vector<std::string>& given, StudyFile& study) {
  std::vector<std::string> added;
  for (const auto& text : given) {
    const PeerEntry& peer = peerOf(text);
    if (isAmong(added, peer.id)) throw Misuse(fmt::format("--peers: '{}' twice", peer.id));
    added.push_back(peer.id);
    const auto like = likeOf(peer);
    bool found = false;
    for (auto& block : study.blocks) {
      const auto methods = block.find("methods");
      if (methods == block.end() || !isAmong(methods->second.items, like)) continue;
      found = true;
      if (!isAmong(methods->second.items, peer.id)) methods->second.items.push_back(peer.id);
    }
    if (!found) {
      throw Misuse(fmt::format("--peers: '{}' solves the equations of '{}', which runs in no block of this study",
                               peer.id, like));
    }
  }
}

}  // namespace irk
