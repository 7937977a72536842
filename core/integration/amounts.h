// Remarks on components that the error control does not see, or that have a sign which they cannot have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/derivatives/consistent_start.h"
#include "core/stages/error_norm.h"

namespace irk {

/// Watches the accepted states of an integration for components of (u, v, x)
///  - whose magnitude never reaches their absolute tolerance: an error of 100 % in them is no error in the norm;
///  - and for components of the scene's x that fall below zero by more than their tolerance though they cannot: because
///    the problem says so (System::nonNegative), or because their rate k_i is not negative wherever the computed
///    solution crosses x_i = 0 downwards. For a concentration k_i >= 0 at x_i = 0, so that an exact solution does not
///    cross zero (the rates are quasi-positive; Hundsdorfer & Verwer, Time-Dependent Advection-Diffusion-Reaction
///    Equations, I.7). One negative rate shows that a component is none; it is not looked at again. Those that a step
///    takes below zero are looked at together, as far as that clears them: each look computes all rates.
/// Both are facts about a result that may be right; neither changes it. Evaluations are not counted. Allocates in its
/// constructor, where a component first falls below zero, and in `remark`.
template <class Real>
class Amounts {
 public:
  /// Keeps references. `start` determines rates; `counters` are what it counts in.
  Amounts(const System<Real>& system, ConsistentStart<Real>& start, Counters& counters);

  /// Begins an integration.
  void begin(const State<Real>& state, const ErrorNorm<Real>& norm);
  /// Begins anew at a switch: a component that jumps below zero is none that cannot cross it.
  void restart(const State<Real>& state) {
    std::erase_if(never_, [&](Index i) { return isBelowZero(state, i) && !system_.nonNegative(i); });
  }
  /// Looks at an accepted step.
  void look(const State<Real>& from, const State<Real>& to);
  /// One line; empty if there is nothing to say.
  std::string remark() const;
  /// Its part on components below zero, which may be why an integration has failed.
  std::string belowZero() const;

 private:
  struct Negative {
    Index i = -1;  // of the scene's x
    double value = 0, t = 0;
    bool declared = false;
  };
  // x_i of the scene, by more than its tolerance.
  bool isBelowZero(const State<Real>& state, Index i) const {
    return static_cast<double>(state.x[first_x_ + i]) < -least_[2 * sizes_.nu + first_x_ + i];
  }
  void lookBelowZero(const State<Real>& from, const State<Real>& to);
  void clearThoseThatCross(const State<Real>& from, const State<Real>& to);
  bool cannotCross(Index i, const State<Real>& from, const State<Real>& to);
  bool findRates();
  void between(double theta, const State<Real>& from, const State<Real>& to);
  std::string belowTolerance() const;

  const System<Real>& system_;
  ConsistentStart<Real>& start_;
  Counters& counters_;
  Sizes sizes_;
  Index first_x_, scene_nx_;  // the scene's x in the system's x
  double round_off_ = 0;      // of a component that is zero, in absolute tolerances
  Vec<double> least_;         // absolute tolerances of (u, v, x)
  std::vector<Index> small_;  // components of (u, v, x) that have not reached them
  Vec<double> largest_;       // magnitude so far, of small components
  std::vector<Index> never_;  // components of the scene's x that have not been below zero
  std::vector<Negative> negative_;
  std::vector<Negative> fallen_;   // undeclared ones that the last step has taken below zero
  std::optional<State<Real>> at_;  // where rates are computed; made for the first one
};

}  // namespace irk
