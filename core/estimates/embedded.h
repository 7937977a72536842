// The embedded error estimate: a method of order s (or s - 1) in the same stages, filtered by one real system.
#pragma once

#include <optional>

#include "core/newton/newton_matrix.h"
#include "core/stages/error_norm.h"
#include "core/stages/start_values.h"

namespace irk {

/// HW II (IV.8.19-20) for r(t; u, v, x; a, k, z) = 0. A method of order s in the same stages, with an additional stage
/// of weight mu at the start, differs from the step's result by h mu times the defect k0 - K(0) of the stages'
/// polynomial K at the start, for any s. Its stiff part is damped with the same mu:
///   e = -(D0 + h mu D1 + h^2 mu^2 D2)^-1 r(t0; u0 + h mu (v0 - V(0)), v0, x0; K(0)).
/// The errors of u, v, x are h mu (v0 - V(0) + h mu e_a), h mu e_a, h mu e_k. mu is the real eigenvalue of A or, for
/// even s, the s-th root of det A. Multipliers of index 2 and 3 count as the error norm weighs them.
///
/// A first stage at the start, as in Radau IA and Lobatto IIIC and IIID, is left out of K, and the order is s - 1: for
/// y' = f(t) this stage equals k0, so that a polynomial through it has no defect at the start, however large the error
/// is.
///
/// Owns scratch and a real system. It factorizes that system only if the stages' solver, to which it keeps a reference,
/// does not have the same factors.
template <class Real>
class EmbeddedEstimate {
 public:
  /// Requires an invertible A without an explicit first stage, which would be the step's start, and a stage order of at
  /// least 1. (Radau IA with one stage, c = 0 and a = 1, has stage order 0; its stage values belong to another time.)
  EmbeddedEstimate(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
                   NewtonMatrix<Real>& stages, const ErrorNorm<Real>& norm, Counters& counters);
  EmbeddedEstimate(const EmbeddedEstimate&) = delete;
  EmbeddedEstimate& operator=(const EmbeddedEstimate&) = delete;

  struct Result {
    Outcome outcome = Outcome::kSuccess;
    double error = 0;  ///< in the error norm
  };
  /// The estimate for the solved step from `from`. An estimate above `again_above` is filtered a second time, HW II
  /// (IV.8.21): in a first step and after a rejection; otherwise pass infinity.
  [[nodiscard]] Result evaluate(const State<Real>& from, const StagePolynomial<Real>& stages, double again_above);
  /// The estimate that q < s stages would give, from the polynomial of degree q - 1 (q - 2) in K. Call it after
  /// `evaluate` of the same step.
  [[nodiscard]] Result evaluateLower(const State<Real>& from, const StagePolynomial<Real>& stages, Index q);

  /// The largest error -h mu (D0 + h mu D1 + h^2 mu^2 D2)^-1 r of `count` points inside a step of size h, whose
  /// (a, k, z) are those of the continuous solution: the defect there (core/estimates/defect.h). One above the
  /// tolerance is filtered a second time, HW II (IV.8.21), so that a transient that the step damps does not count: by
  /// the residual behind that error, and by the one that the linearization predicts there; the larger one counts. The
  /// residual alone would be zero where the error leads out of a force that acts in a short range. Counts u, v, x; rows
  /// of constraints of index 2 and 3 are left out. `most`, n: the largest |r_i| at the points before these in this
  /// step; a point whose residual is larger in no row has the error 0 and is not filtered. That is exact where the
  /// filter couples no rows; in other systems the parts of an earlier residual may have cancelled in the filter.
  [[nodiscard]] Result largestInside(const StagePoints<Real>& at, Index count, const Real& h, Vec<Real>& most);

  /// Allocates what the next evaluation would, where the pattern is known.
  void reserve() {
    if (own_) own_->reserve();
  }
  /// The component of (u, v, x, z) with the largest part in the error computed last.
  Index worstComponent() const;
  /// The last result of `evaluate` by component.
  const State<Real>& errors() const { return error_; }
  /// Among which vector work is divided.
  int threads() const { return threads_; }
  double mu() const { return static_cast<double>(mu_); }
  /// p of the estimate's error h^(p+1): s (s - 1 with a stage at the start), but at most the stage order plus 1.
  static int order(const Tableau<Real>& tableau);
  /// Weights of the stages in the polynomial K at the step's start.
  static Vec<Real> atStart(const Scheme<Real>& scheme);
  /// mu of this method.
  static Real weight(const Tableau<Real>& tableau);

 private:
  // Two columns: the weights l of the stages in a polynomial K at the step's start, and A^T l.
  using AtStart = Mat<Real>;
  Result estimate(const State<Real>& from, const StagePolynomial<Real>& stages, const AtStart& polynomial,
                  double again_above, State<Real>& error);
  enum class EquationsAt { kStart, kInside };
  static constexpr Index kAtOnce = 8;  // points inside a step whose residuals are evaluated in one call
  Point<Real> pointAt(const Real& t, const Vec<Real>& u, const State<Real>& state) const;
  Outcome evaluateAt(const Point<Real>& p, EquationsAt at);
  Outcome scaleAndCheck(Real* r, EquationsAt at) const;
  Result filteredInside(const Point<Real>& p, const Real& h);
  Outcome filter(const Real& h, State<Real>& error);
  Outcome solve(const Real& h);
  // Sets `predicted_` to the residual that a linear system has at the point displaced by the error, which e_ gives:
  // r - (h mu D1 + h^2 mu^2 D2) e = D0 e.
  void residualBehind();

  const System<Real>& system_;
  const Scheme<Real>& scheme_;
  const ErrorNorm<Real>& norm_;
  Sizes sizes_;
  int threads_;
  Real mu_;
  NewtonMatrix<Real>& stages_;
  StageSolverKind kind_;
  Counters& counters_;
  std::optional<NewtonMatrix<Real>> own_;  // made when `stages_` cannot solve the real system
  bool scaled_;                            // whether any row is scaled
  Vec<Real> scales_;
  AtStart full_, lower_;  // through all stages, and with the degree that evaluateLower asks for
  Vec<Real> basis_;       // orthonormal Legendre polynomials at 0, s
  Vec<Real> defect_;      // K(0), n
  Vec<Real> predicted_;   // residualBehind, n
  Vec<Real> slip_;        // h mu (v0 - V(0)), nu
  State<Real> at_;        // u, v, x, d of the point where the residual is evaluated, unless that is the step's start
  State<Real> error_;     // of `evaluate`
  State<Real> beside_;    // of the other estimates
  const State<Real>* last_ = &error_;
  Mat<Real> e_;       // n x 1
  Mat<Real> inside_;  // residuals of a few points inside the step, n x kAtOnce
};

}  // namespace irk
