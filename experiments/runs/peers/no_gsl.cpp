// The integrators of GSL in a build without them (IRK_GSL=OFF): a study that names them has rows that say so.
#include <memory>

#include "experiments/runs/peers/catalogue.h"
#include "irk/misuse.h"

namespace irk {
namespace {

[[noreturn]] std::unique_ptr<Peer> refuseGsl() {
  throw Misuse("this program was built without the integrators of GSL: build it with IRK_GSL=ON");
}

}  // namespace

std::unique_ptr<Peer> makeGslRk4imp(const PeerSetup&) { return refuseGsl(); }
std::unique_ptr<Peer> makeGslMsbdf(const PeerSetup&) { return refuseGsl(); }
std::unique_ptr<Peer> makeGslBsimp(const PeerSetup&) { return refuseGsl(); }

}  // namespace irk
