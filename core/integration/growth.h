// Judges a motion at one of its states: how fast it is in tolerances, what grows in it, and what is left of it.
#pragma once

#include <complex>
#include <optional>

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "irk/options.h"

namespace irk {

/// The tolerances of a motion at a point, and the linearized motion (u, v, x)' = J (u, v, x) there, with (a, k, z) =
/// -D0^-1 (D1 (v, x) + D2 u) of Level::kAcceleration.
template <class Real>
class Growth {
 public:
  /// The most components of (u, v, x) whose eigenvalues are computed. Measured where steps are cheapest (`heat`,
  /// tridiagonal): eigenvalues of 60 components double the time of a bar, those of 250 make it ten times as long. On
  /// beams with 26 to 80 components they add at most 12 %.
  static constexpr Index kMost = 50;

  /// Keeps a reference to the system. `tolerances` and `scale` are those of the result that is measured.
  Growth(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale);

  /// Takes the tolerances and the round-off of (u, v, x) at `state` for all calls until the next one. Returns the
  /// largest component of (u, v, x)' in tolerances.
  double speed(const State<Real>& state);
  /// Of u, v and x.
  Index components() const { return tolerance_.size(); }
  /// The largest |lambda| among the eigenvalues of J at `state` that grow by more than a factor e within `time`,
  /// Re lambda time > 1. 0 if there are none, if (u, v, x) do not determine (a, k, z), and if there are more than
  /// kMost components: eigenvalues of N components cost about 10 N^3 operations, with their vectors 25 N^3 (Golub & Van
  /// Loan, Matrix Computations, 7.5.6). Allocates.
  double rate(const State<Real>& state, double time);

  /// The motions along the eigenvectors q of J: the distance of each from the rest of the linearized motion is
  /// q c / lambda with sum_i q_i c_i = f = (v, a, k).
  struct Motions {
    double resting = 0;     ///< the largest |lambda| of those that grow and are nearer to the rest than the tolerance
    double faster = 0;      ///< the largest Re lambda of these
    double living = 0;      ///< the largest |lambda| of those that are further away than round-off
    bool vanished = false;  ///< some of those that grow and rest are not further away than round-off, and none is
  };
  /// For the state of the last calls of `speed` and `rate`. A motion that rests for the time `since` and would have
  /// decayed to round-off in it is not a living one: others drive it. Nothing if the eigenvectors are not known.
  std::optional<Motions> motions(const State<Real>& state, double time, double since);

 private:
  bool linearize(const State<Real>& state);
  bool grows(const std::complex<double>& lambda, double time) const;

  const System<Real>& system_;
  Differentiator<Real> differentiator_;
  Linearization<Real> D_;
  Mat<double> J_;
  double lambda_round_off_ = 0;  // of eigenvalues of J_
  Tolerances tolerances_;
  Vec<double> scale_, tolerance_, round_off_, rates_;
};

}  // namespace irk
