// The integrators of GSL in a build without them (IRK_GSL=OFF): a study that names them has rows that say so.
#include <fmt/format.h>

#include <memory>
#include <string_view>

#include "experiments/runs/peers/catalogue.h"
#include "irk/misuse.h"

namespace irk {
namespace {

[[noreturn]] void refuseGsl(std::string_view method) {
  throw Misuse(fmt::format(
      "method '{}': this program was built without GSL and its integrators gsl_bsimp, gsl_msbdf and gsl_rk4imp; "
      "cmake -DIRK_GSL=ON builds them in",
      method));
}

}  // namespace

bool hasGsl() { return false; }

std::unique_ptr<Peer> makeGslRk4imp(const PeerSetup&) { refuseGsl("gsl_rk4imp"); }
std::unique_ptr<Peer> makeGslMsbdf(const PeerSetup&) { refuseGsl("gsl_msbdf"); }
std::unique_ptr<Peer> makeGslBsimp(const PeerSetup&) { refuseGsl("gsl_bsimp"); }

}  // namespace irk
