// Newton's method for the stage equations: the strategies of the axis `newton`.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/newton/newton_matrix.h"
#include "core/options/catalogue.h"
#include "core/stages/error_norm.h"

namespace irk {

/// Whether a solve may replace a stale shared Jacobian. The half steps of an attempt keep the Jacobian of its start
/// unless they fail with it.
enum class JacobianUse { kRefreshIfStale, kKeep };

struct NewtonResult {
  Outcome outcome = Outcome::kSuccess;
  int iterations = 0;
  double theta = 0;  ///< contraction: of increments, the last (simplified) or first (broyden), or residuals
  /// The last increment, in tolerances, if round-off of the residual ended the iteration before the increment was as
  /// small as required; else 0.
  double round_off = 0;
};

/// What a Newton strategy needs. All references must outlive it; `eq` has begun the step.
template <class Real>
struct NewtonContext {
  StageEquations<Real>& eq;
  NewtonMatrix<Real>& matrix;
  StagewiseMatrix<Real>* stagewise;  ///< null for a strategy without `uses_stage_matrices`
  const ErrorNorm<Real>& norm;
  Counters& counters;
  JacobianUse use;
};

/// Solves the stage equations. Owns scratch; one object per stepper.
template <class Real>
class Newton {
 public:
  virtual ~Newton() = default;
  /// W (n x s) holds the start values on entry and the solution on return (unspecified after a failure). The columns of
  /// explicit stages do not change.
  [[nodiscard]] virtual NewtonResult solve(NewtonContext<Real>& context, Mat<Real>& W) = 0;
  /// Forgets the contraction, which does not hold for the next step after a start, a failure or a change of mode.
  virtual void forget() {}
};

template <class Real>
using NewtonMaker =
    std::function<std::unique_ptr<Newton<Real>>(const IntegratorOptions&, const Sizes&, const Scheme<Real>&)>;

/// A strategy of the axis `newton`.
template <>
struct Strategy<NewtonKind> {
  NewtonKind id;
  std::string meaning;
  Needs needs = {};
  bool keeps_jacobian = true;        ///< uses one SharedJacobian for all stages
  bool uses_stage_matrices = false;  ///< uses the StagewiseMatrix
  PerScalar<NewtonMaker> make;
};
template <>
Catalogue<NewtonKind>& catalogue<NewtonKind>();

/// Fixed steps have no tolerance: Newton's method then iterates to round-off.
template <class Real>
std::unique_ptr<Newton<Real>> makeNewton(const IntegratorOptions& options, const Sizes& sizes,
                                         const Scheme<Real>& scheme);

}  // namespace irk
