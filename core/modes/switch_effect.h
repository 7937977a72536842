// The effect of a switch inside a solved step, for treatments whose steps go on over switches.
#pragma once

#include "core/derivatives/consistent_start.h"
#include "core/steps/modes.h"
#include "core/steps/rate_norm.h"
#include "core/steps/switch_scan.h"

namespace irk {

/// All results are in the error norm. Owns scratch; keeps references.
template <class Real>
class SwitchEffect {
 public:
  SwitchEffect(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
               Counters& counters);

  /// Whether a switch is due inside the step, whether or not one is due at its end, and its index. `inside()` becomes
  /// the state there, with the mode of the start.
  bool dueInside(const SolvedStep<Real>& step, const State<Real>& end, Index& index);
  State<Real>& inside() { return inside_; }

  /// The norm of h times the change of (a, k) that the mode of `inside()` makes there; infinity if it cannot be
  /// determined.
  double changeOfRates(const Real& h);
  /// The norm of the difference between two ends of a step.
  double difference(const State<Real>& p, const State<Real>& q, const Real& h) const;
  /// The largest of three effects: h times the change of (a, k) from the step's start to a stage; h times the change of
  /// (a, k) at the end by the new mode; the correction of u, v, x by the switch. `before`: the end before any switch is
  /// carried out.
  double changeInStep(const SolvedStep<Real>& step, const State<Real>& before);

 private:
  const ErrorNorm<Real>& norm_;
  SwitchingFunctions<Real> functions_;
  SwitchScan<Real> scan_;
  ConsistentStart<Real> consistent_;
  RateNorm<Real> rate_norm_;
  State<Real> inside_;
  Vec<Real> rates_;
  Vec<double> ones_;
};

}  // namespace irk
