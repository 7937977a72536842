// Consistent states: constraints hold, and (a, k, z) follow from (u, v, x).
#pragma once

#include <string>

#include <Eigen/LU>

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "irk/outcome.h"

namespace irk {

struct StartReport {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;
  bool determined = true;  ///< false: D0 is singular, (a, k, z) are the given ones
};

/// What is asked of a state before (a, k, z) are determined.
enum class StartCheck {
  kConstraints,  ///< a user's start: g = 0 and dg/dt = 0
  kNone,         ///< a restart after a switch: the drift of the integration is no mistake
};

/// Owns its derivatives, factors and scratch: for any number of starts of one system.
template <class Real>
class ConsistentStart {
 public:
  /// Keeps a reference to the system. `w_required`: a (a, k, z) that cannot be determined has to
  /// satisfy the residual as it is given.
  ConsistentStart(const System<Real>& system, DerivativeSource source, bool w_required);

  /// A new integration: the same bits as of a new object.
  void forgetPattern() { differentiator_.forgetPattern(); }

  /// Replaces state.w by the solution of the residual at Level::kAcceleration: Newton on w, with the
  /// derivatives kept while it contracts well; one that ends with a residual as small as that asked of
  /// constraints will do as start values. Where its matrix D0 is singular (algebraic unknowns
  /// of higher index that are no multipliers of position constraints) state.w is kept if it is not
  /// required or satisfies the residual; else kInconsistentStart. kNotFinite names the row. After a
  /// failure state.w is the given one.
  StartReport apply(State<Real>& state, StartCheck check = StartCheck::kConstraints);
  /// The same at the end of an integration, with `Multipliers::kConsistent`. Where Newton does not
  /// converge to (a, k, z) those of the stages stay, and what is returned says why; else it is empty.
  std::string applyAtEnd(State<Real>& state);

 private:
  StartReport checkConstraints(const State<Real>& state);
  StartReport determine(State<Real>& state, const char* place, double tolerated);
  StartReport keep(const State<Real>& state, const char* place);
  bool factorize();
  void solve();

  const System<Real>& system_;
  bool w_required_;
  Differentiator<Real> differentiator_;
  Linearization<Real> D_;
  RateLu<Real> lu_;  // sparse
  Eigen::FullPivLU<Mat<Real>> dense_lu_;
  Vec<Real> r_, dw_, given_;
};

}  // namespace irk
