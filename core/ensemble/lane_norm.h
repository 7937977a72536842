// The error norm of eight systems (core/stages/error_norm.h, the mixed norm).
#pragma once

#include <vector>

#include "core/ensemble/lane_state.h"
#include "irk/options.h"

namespace irk {

class LaneNorm {
 public:
  LaneNorm(const Sizes& sizes, const ErrorPowers& powers, const Tolerances& tolerances);

  /// The magnitudes of lane i's components (u, v, x, z); empty means 1.
  void setScale(std::size_t i, const Vec<double>& scale);
  /// Sets the weights from the magnitudes of the states, and those of Newton's increments for a step h.
  void update(const LaneState& from, const Lanes& h);

  bool index3() const { return !powers_.v.empty() && powers_.v.front() > 0; }
  /// The norm of an error of (u, v, x) and of z.
  Lanes magnitude(const Lanes* y, const Lanes* z) const;
  /// The norm of Newton's increments of (a, k, z) in s stages.
  Lanes increment(const Lanes* dw, Index s) const;

 private:
  Sizes sizes_;
  const ErrorPowers& powers_;
  Tolerances tolerances_;
  std::vector<Lanes> atol_;     // atol times the magnitudes
  std::vector<Lanes> inverse_;  // 1 / weights of u, v, x; h^power / weight of z
  std::vector<Lanes> squares_;  // weights of increments
};

}  // namespace irk
