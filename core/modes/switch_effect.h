// The effect of a switch inside a solved step on this step, for treatments whose steps go on over switches.
#pragma once

#include "core/derivatives/consistent_start.h"
#include "core/steps/modes.h"
#include "core/steps/rate_norm.h"
#include "core/steps/switch_scan.h"

namespace irk {

/// All in the error norm. Owns scratch; keeps references.
template <class Real>
class SwitchEffect {
 public:
  SwitchEffect(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
               Counters& counters);

  /// Whether a switch is due inside the step, whatever is at its end, and which. `inside()` becomes the state there,
  /// with the mode of the start.
  bool dueInside(const SolvedStep<Real>& step, const State<Real>& end, Index& index);
  State<Real>& inside() { return inside_; }

  /// h times the change of (a, k) from those of `inside()` to what its mode makes of them; infinity where they cannot
  /// be determined.
  double changeOfRates(const Real& h);
  /// The difference between two ends of a step.
  double difference(const State<Real>& p, const State<Real>& q, const Real& h) const;
  /// The largest of: the change of (a, k), times h, from the step's start to a stage and at its end to the mode that
  /// begins there; what the switch corrects in u, v, x. `before`: the end before any switch was done.
  double changeInStep(const SolvedStep<Real>& step, const State<Real>& before);

 private:
  const ErrorNorm<Real>& norm_;
  Switches<Real> switches_;
  SwitchScan<Real> scan_;
  ConsistentStart<Real> consistent_;
  RateNorm<Real> rate_norm_;
  State<Real> inside_;
  Vec<Real> rates_;
  Vec<double> ones_;
};

}  // namespace irk
