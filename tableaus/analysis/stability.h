// Where |R(z)| <= 1: A-stability and what is weaker, intervals of stability.
#pragma once

#include "tableaus/analysis/stability_function.h"

namespace irk {

/// HW II, IV.3 and IV.5. |R| <= 1 on a ray z = r e^(i phi) is |D|^2 - |N|^2 >= 0, a polynomial in r
/// (on the imaginary axis the E-polynomial): its sign between its zeros decides, in 80 digits.
struct Stability {
  bool a_stable;  ///< |R| <= 1 wherever Re z <= 0: on the imaginary axis, and no pole on the left
  bool l_stable;  ///< A-stable and R(infinity) = 0
  bool i_stable;  ///< |R| <= 1 on the imaginary axis
  /// Largest alpha with |R| <= 1 for |arg(-z)| <= alpha, in degrees, right to 1e-6; 90 if A-stable,
  /// NaN if not even the negative real axis is stable.
  double alpha;
  double real_limit;       ///< [-real_limit, 0] is stable and no longer interval; may be inf
  double imaginary_limit;  ///< the same for i [-imaginary_limit, imaginary_limit]
};

/// Quantities below `tolerance` times their largest term count as zero.
Stability analyzeStability(const StabilityFunction& R, double tolerance);

/// Largest r_0 with |R(r e^(i phi))| <= 1 for 0 <= r <= r_0; inf if there is no largest.
/// `cosine` = cos(phi); -1 and 0 are exact.
double stableRadius(const StabilityFunction& R, const mp80& cosine, double tolerance);

}  // namespace irk
