// The interface of all peers: integrators of other libraries with which the suite's methods are compared.
#pragma once

#include <memory>
#include <string>

#include "core/derivatives/consistent_start.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// The system that a peer integrates, and its tolerances. The system must outlive the peer.
struct PeerSetup {
  const System<double>& system;
  double rtol;
  Vec<double> atol;  ///< per component of the state (u, v, x, z), in the system's order
  double h;          ///< the first step; 0 = the peer's choice
  double h_max;
  DerivativeSource derivatives;
  bool determined;  ///< (a, k, z) follow from (u, v, x) at acceleration level; else the index is 2
  bool locate;      ///< steps end at roots of the switching functions
};

/// One integrator of another library, step by step, with the library's own control of step and order. Use one object
/// per thread.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Starts from `state` and discards all history; a multistep method starts with order 1 again. If the peer needs
  /// state.w, it computes and sets it; `check` applies to that computation.
  virtual StartReport start(State<double>& state, double t_end, StartCheck check) = 0;

  /// Takes one accepted step, which ends at t_end at the latest. Sets t, u, v, x of the state, and w if the peer
  /// computes it.
  [[nodiscard]] virtual Outcome step(State<double>& state) = 0;

  /// Whether the last step ended at a root of switching function i.
  virtual bool foundRoot(Index i) const {
    static_cast<void>(i);
    return false;
  }

  /// Sets a new mode without a restart.
  virtual void setDiscrete(const Vec<double>& d) = 0;

  /// Adds the peer's counts since the last start, except accepted steps. Counts that a library does not report stay
  /// 0.
  virtual void count(Counters& counters) const = 0;

  /// The library's message about the last failure.
  virtual std::string message() const = 0;
};

}  // namespace irk
