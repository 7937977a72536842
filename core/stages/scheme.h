// A tableau prepared for the K-form: A^2, end weights, what its structure allows.
#pragma once

#include "irk/tableau.h"

namespace irk {

/// Switching functions are sampled at the ends of this many equal parts of a step. A function that rises above 0
/// and returns between two samples is not seen by them; core/steps/switch_scan.h looks for it.
constexpr Index kParts = 8;

template <class Real>
struct Scheme {
  Tableau<Real> tableau;
  Index s;
  Mat<Real> A, A2;  ///< A and A^2, s x s
  Vec<Real> b, c;
  Vec<Real> A1;  ///< A 1: c but for stage order 0
  Vec<Real> bA;  ///< A^T b: weights of a in u1 = u0 + h v0 + h^2 sum (b^T A)_j a_j
  /// Stages that need no solve because they repeat the step's start: 1 for Lobatto IIIA (first row
  /// of A zero, last row b: the last stage is the next step's first), else 0.
  Index first = 0;
  bool stiffly_accurate = false;  ///< last row of A is b and c_s = 1: z1 = z_s
  bool regular = false;           ///< A (without the explicit first stage) is invertible
  /// z1 = (1 - sum d) z0 + sum d_i z_i with d = A^-T b, paper (2.11) corrected. If regular.
  Vec<Real> d;
  /// Weights of the stage polynomial of (a, k) at the step's end (start values, not results) and at
  /// its start.
  Vec<Real> end, start;
  /// V^-1 with V_ik = P_k(c_i), orthonormal shifted Legendre polynomials: coefficients of the
  /// polynomial through the stages. Stable for any s. HW II (IV.5).
  Mat<Real> legendre_inverse, legendre_inverse_transposed;
  Mat<Real> A_transposed, A2_transposed;
  /// Weights of the stages in w, v (or x) and u at theta = j / kParts, j = 1 .. kParts - 1; of the
  /// dense output, core/stages/dense_output.h. s x (kParts - 1).
  Mat<Real> inside, inside_once, inside_twice;

  explicit Scheme(Tableau<Real> t);

  Index implicitStages() const { return s - first; }
  /// A without the explicit first stage; its square is the same block of A^2.
  Mat<Real> implicitA() const { return A.bottomRightCorner(s - first, s - first); }
  /// Algebraic unknowns need z at the end of a step, and stage values that determine them.
  bool allowsAlgebraic() const { return regular; }
};

}  // namespace irk
