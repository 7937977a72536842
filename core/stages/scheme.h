// A scheme: a tableau prepared for the stage equations, with A^2, end weights and properties of its structure.
#pragma once

#include <cmath>
#include <memory>

#include "irk/tableau.h"

namespace irk {

/// Switching functions are sampled at the ends of this many equal parts of a step. Samples miss a function that rises
/// above 0 and returns between two of them; core/steps/switch_scan.h searches for such functions.
constexpr Index kParts = 8;

/// Throws Misuse for sizes that do not fit each other, for coefficients that are not finite, and for orders that no
/// method of s stages has; see irk/tableau.h.
template <class Real>
void requireTableau(const Tableau<Real>& tableau);

/// What a tableau's structure says about its stages.
template <class Real>
struct Structure {
  /// Number of stages that need no solve because they equal the step's start: 1 for Lobatto IIIA, where the first row
  /// of A is zero and the last row is b, so that the last stage is the first one of the next step; else 0.
  Index first = 0;
  bool stiffly_accurate = false;  ///< last row of A is b and c_s = 1: z1 = z_s
  bool regular = false;           ///< A (without the explicit first stage) is invertible

  explicit Structure(const Tableau<Real>& tableau);
  /// Whether the scheme can integrate algebraic unknowns: the stages determine them, and z at the end of a step
  /// follows from the stages.
  bool allowsAlgebraic() const { return regular; }
};

/// Owns a copy of the tableau and all matrices derived from it. Immutable; may be shared by threads.
template <class Real>
struct Scheme : Structure<Real> {
  using Structure<Real>::first;
  using Structure<Real>::stiffly_accurate;
  using Structure<Real>::regular;
  Tableau<Real> tableau;
  Index s;
  Mat<Real> A, A2;  ///< A and A^2, s x s
  Vec<Real> b, c;
  Vec<Real> A1;  ///< A 1, the row sums of A; equal to c if the stage order is at least 1
  Vec<Real> bA;  ///< A^T b: weights of a in u1 = u0 + h v0 + h^2 sum (b^T A)_j a_j
  /// z1 = (1 - sum d) z0 + sum d_i z_i with d = A^-T b, paper (2.11) corrected. Only if `regular` and first = 0.
  Vec<Real> d;
  /// Weights of the polynomial through the stages of (a, k), at the step's end and at its start. They give start
  /// values, not results.
  Vec<Real> end, start;
  /// V^-1 with V_ik = P_k(c_i), orthonormal shifted Legendre polynomials. It gives the coefficients of the polynomial
  /// through the stages, and is stable for any s. HW II (IV.5).
  Mat<Real> legendre_inverse, legendre_inverse_transposed;
  Mat<Real> A_transposed, A2_transposed;
  /// Weights of the stages for w, v (or x) and u at theta = j / kParts, j = 1 .. kParts - 1, for the dense output
  /// (core/stages/dense_output.h). s x (kParts - 1).
  Mat<Real> inside, inside_once, inside_twice;

  explicit Scheme(Tableau<Real> t);

  Index implicitStages() const { return s - first; }
  /// A without the explicit first stage. Its square is the same block of A^2.
  Mat<Real> implicitA() const { return A.bottomRightCorner(s - first, s - first); }
};

/// Whether errors of stiff components decay from step to step: |R(infinity)| < 1. Otherwise they add up.
template <class Real>
bool dampsStiffErrors(const Scheme<Real>& scheme) {
  using std::abs;
  if (!scheme.regular || scheme.first > 0) return false;
  return abs(Real(Real(1) - scheme.d.sum())) < Real(0.99);
}

/// The process keeps schemes and structures in double with up to this many stages (60 kB each).
inline constexpr Index kMostKeptStages = 30;

/// The scheme of a tableau. Threads may share it.
template <class Real>
std::shared_ptr<const Scheme<Real>> schemeOf(const Tableau<Real>& tableau);
/// The structure alone, which costs less.
template <class Real>
std::shared_ptr<const Structure<Real>> structureOf(const Tableau<Real>& tableau);

}  // namespace irk
