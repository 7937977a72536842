// The region |R(z)| <= 1: A-stability, weaker properties, and intervals of stability.
#pragma once

#include "tableaus/analysis/stability_function.h"

namespace irk {

/// HW II, IV.3 and IV.5. On a ray z = r e^(i phi), |R| <= 1 is equivalent to |D|^2 - |N|^2 >= 0, a polynomial in r
/// (on the imaginary axis the E-polynomial). Its sign between its zeros decides; computed in 80 digits.
struct Stability {
  bool a_stable;  ///< |R| <= 1 for Re z <= 0: on the imaginary axis, and no pole in the left half plane
  bool l_stable;  ///< A-stable and R(infinity) = 0
  bool i_stable;  ///< |R| <= 1 on the imaginary axis
  /// The largest alpha with |R| <= 1 for |arg(-z)| <= alpha, in degrees, accurate to 1e-6; 90 if A-stable, NaN if
  /// even the negative real axis is unstable.
  double alpha;
  double real_limit;       ///< largest r such that [-r, 0] is stable; may be inf
  double imaginary_limit;  ///< the same for i [-r, r]
};

/// Quantities below `tolerance` times their largest term count as zero.
Stability analyzeStability(const StabilityFunction& R, double tolerance);

/// The largest r_0 with |R(r e^(i phi))| <= 1 for 0 <= r <= r_0; inf if there is no largest. `cosine` is cos(phi); -1
/// and 0 are treated exactly.
double stableRadius(const StabilityFunction& R, const BigFloat& cosine, double tolerance);

}  // namespace irk
