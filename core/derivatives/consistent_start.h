// Makes states consistent: checks that the constraints hold and computes (a, k, z) from (u, v, x).
#pragma once

#include <string>

#include <Eigen/LU>

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

struct StartReport {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;      ///< where and why it failed; one line
  bool determined = true;  ///< false: D0 is singular, and (a, k, z) are kept as given
};

/// What is checked before (a, k, z) are determined.
enum class StartCheck {
  kConstraints,  ///< for a user's start: g = 0 and dg/dt = 0
  kNone,         ///< for a restart after a switch: the constraints are violated by the drift so far
};

/// Makes any number of states of one system consistent. Owns derivatives, factors and scratch.
template <class Real>
class ConsistentStart {
 public:
  /// Keeps a reference to the system. `w_required`: if (a, k, z) cannot be determined, the given values have to
  /// satisfy the residual. `counters`, if given, count the Jacobians, and the factorizations of restarts; they
  /// must live as long as this object.
  /// `scale`: typical magnitudes > 0 of u, v, x, z (2 nu + nx + nz numbers), relative to which a start is judged;
  /// empty means 1. Throws Misuse for another length. `scratch`: see Differentiator.
  ConsistentStart(const System<Real>& system, DerivativeSource source, bool w_required, Counters* counters = nullptr,
                  const Vec<double>& scale = {}, std::shared_ptr<DifferentiatorScratch<Real>> scratch = nullptr);

  /// Resets all history before a new integration: results are then bitwise those of a new object.
  void forgetPattern() {
    differentiator_.forgetPattern();
    factorized_ = false;
  }

  /// Replaces state.w by the solution of the residual at Level::kAcceleration. Uses Newton's method for w and keeps
  /// the derivatives while it contracts well. If Newton does not converge, a residual within the tolerance of the
  /// constraint check is accepted, since w then only serves as start values. If D0 is singular (algebraic unknowns
  /// of higher index that are no multipliers of position constraints), state.w is kept, provided that a user's start
  /// satisfies the rows that read none of it (core/derivatives/constraint_check.h), and that it is not required or
  /// satisfies the residual; otherwise the outcome is kInconsistentStart. A start at which the constraints are
  /// dependent is kSingular. For kNotFinite the detail names the row, and for a derivative the component
  /// (core/derivatives/derivative_fault.h). A failure leaves the state unchanged.
  StartReport apply(State<Real>& state, StartCheck check = StartCheck::kConstraints);
  /// The same to eight digits, without a check, and with the derivatives that an earlier call has left as long as
  /// Newton's method contracts well with them.
  StartReport findRates(State<Real>& state);
  /// The same at the end of an integration, for `Multipliers::kConsistent`. If Newton does not converge, (a, k, z)
  /// stay those of the stages, and the reason is returned; otherwise the text is empty.
  std::string applyAtEnd(State<Real>& state);

 private:
  State<double> weightsOf(const State<Real>& state) const;
  Vec<double> weightsOfMotion(const State<Real>& state) const;
  std::string dependentConstraints(const State<Real>& state) const;
  StartReport checkConstraints(const State<Real>& state);
  enum class Wanted { kAllDigits, kRates };
  StartReport determine(State<Real>& state, const char* place, double tolerated, Wanted wanted = Wanted::kAllDigits);
  StartReport keep(const State<Real>& state, const char* place);
  bool factorize();
  void solve();

  const System<Real>& system_;
  DerivativeSource source_;
  bool w_required_;
  Counters* counters_;
  Differentiator<Real> differentiator_;
  Linearization<Real> D_;
  RateLu<Real> lu_;  // for a sparse pattern
  Mat<Real> scaled_;
  Equilibration<Real> equilibration_;
  Eigen::FullPivLU<Mat<Real>> dense_lu_;  // of scaled_
  Vec<Real> r_, dw_, given_;
  std::int64_t factorizations_ = 0;
  bool factorized_ = false;  // whether the factors of D_ are there
  Vec<double> scale_;        // of u, v, x, z
};

}  // namespace irk
