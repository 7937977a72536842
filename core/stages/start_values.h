// Start values of Newton's iteration.
#pragma once

#include "core/base/buffer.h"
#include "core/stages/scheme.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The stages of a solved step: the polynomial through (c_i, w_i) on [t, t + h].
template <class Real>
struct StagePolynomial {
  const Scheme<Real>* scheme = nullptr;
  Real t{}, h{};
  Mat<Real> W;  ///< n x s; n columns of zero length until the first step
  bool valid = false;
};

/// Fills W for a step from a solved one. Owns its weights.
template <class Real>
class StartValues {
 public:
  /// Keeps a reference to the scheme.
  StartValues(Predictor kind, const Scheme<Real>& scheme);

  /// W (n x s) for the step [from.t, from.t + h], from the polynomial `past` (of any number of
  /// stages) where it is valid, else from (a, k, z) of `from`. The explicit first stage is always that of `from`.
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
            Mat<Real>& W);

 private:
  // Start values of stage i are W_past times column i. Kept for two places: doubling alternates
  // between the two halves of a step.
  struct Weights {
    const Scheme<Real>* past = nullptr;
    Real offset{-1}, ratio{-1};
    Buffer<Real> matrix;  // s of the past x s
  };
  MatView<Real> weights(const Scheme<Real>& past, const Real& offset, const Real& ratio);
  void compute(Weights& weights);

  Predictor kind_;
  const Scheme<Real>& scheme_;
  Weights weights_[2];
  int newest_ = 0;
  Index farthest_ = 0;  // stage
  Buffer<Real> basis_;  // s of the past x s; column i: P_0, P_1, ... at the new stage i
};

}  // namespace irk
