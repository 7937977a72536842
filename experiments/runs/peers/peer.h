// What all peers have in common. Peers are the integrators of other libraries that the suite's
// methods are compared with.
#pragma once

#include <memory>
#include <string>

#include "core/derivatives/consistent_start.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// What a peer integrates, and how accurately. The system outlives the peer.
struct PeerSetup {
  const System<double>& system;
  double rtol;
  Vec<double> atol;  ///< per component of the state (u, v, x, z) as the system orders it
  double h;          ///< the first step; 0 = the peer's choice
  double h_max;
  DerivativeSource derivatives;
  bool determined;  ///< (a, k, z) follow from (u, v, x) at acceleration level; else index 2
  bool locate;      ///< steps end at roots of the switching functions
};

/// An integrator of a library, step by step, with the library's own step and order control. One per
/// thread.
class Peer {
 public:
  virtual ~Peer() = default;

  /// From `state` on, whatever was before; a multistep method begins at order 1 again. Sets state.w
  /// if the peer needs it; `check` is for that.
  virtual StartReport start(State<double>& state, double t_end, StartCheck check) = 0;

  /// One accepted step. It ends at t_end at the latest. Sets t, u, v, x of the state, and w if the
  /// peer has it.
  [[nodiscard]] virtual Outcome step(State<double>& state) = 0;

  /// Whether the last step ended at a root of switching function i.
  virtual bool foundRoot(Index i) const {
    static_cast<void>(i);
    return false;
  }

  /// A new discrete state without a new start.
  virtual void setDiscrete(const Vec<double>& d) = 0;

  /// Adds what the peer has counted since the last start: all but accepted steps. What a library
  /// does not tell stays 0.
  virtual void count(Counters& counters) const = 0;

  /// What the library said about the last failure.
  virtual std::string message() const = 0;
};

}  // namespace irk
