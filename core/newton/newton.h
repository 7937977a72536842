// Newton's method for the stage equations: the strategies of the axis `newton`.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/newton/newton_matrix.h"
#include "core/options/catalogue.h"
#include "core/stages/error_norm.h"

namespace irk {

/// Whether a solve may replace the shared Jacobian when that is stale: the half steps of an attempt
/// keep the one of its start, unless they fail with it.
enum class JacobianUse { kRefreshIfStale, kKeep };

struct NewtonResult {
  Outcome outcome = Outcome::kSuccess;
  int iterations = 0;
  double theta = 0;  ///< contraction: of increments, the last (simplified) or first (broyden), or residuals
  /// The last increment, in tolerances, where round-off of the residual ends the iteration before the
  /// increment is as small as was asked for; else 0.
  double round_off = 0;
};

/// What a Newton strategy works with. All references outlive it; the step has been begun in `eq`.
template <class Real>
struct NewtonContext {
  StageEquations<Real>& eq;
  NewtonMatrix<Real>& matrix;
  StagewiseMatrix<Real>& stagewise;
  const ErrorNorm<Real>& norm;
  Counters& counters;
  JacobianUse use;
};

/// Owns scratch; one per stepper.
template <class Real>
class Newton {
 public:
  virtual ~Newton() = default;
  /// W (n x s): start values in, solution out (unspecified after a failure). The columns of explicit
  /// stages are not touched.
  [[nodiscard]] virtual NewtonResult solve(NewtonContext<Real>& context, Mat<Real>& W) = 0;
  /// Forgets the contraction, which says nothing about the next step after a start, a failure or a new mode.
  virtual void forget() {}
};

template <class Real>
using NewtonMaker =
    std::function<std::unique_ptr<Newton<Real>>(const IntegratorOptions&, const Sizes&, const Scheme<Real>&)>;

/// A Newton method.
template <>
struct Strategy<NewtonKind> {
  NewtonKind id;
  std::string meaning;
  Needs needs = {};
  bool keeps_jacobian = true;        ///< one for all stages, of the SharedJacobian
  bool uses_stage_matrices = false;  ///< the StagewiseMatrix
  PerScalar<NewtonMaker> make;
};
template <>
Catalogue<NewtonKind>& catalogue<NewtonKind>();

/// With fixed steps no tolerance is known: iterates to round-off.
template <class Real>
std::unique_ptr<Newton<Real>> makeNewton(const IntegratorOptions& options, const Sizes& sizes,
                                         const Scheme<Real>& scheme);

}  // namespace irk
