// A step with its error estimate: the strategies of the axis `estimate`.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "core/options/catalogue.h"
#include "core/stages/scheme_list.h"
#include "core/steps/stepper.h"

namespace irk {

/// What an accepted step means for the next one.
struct NextStep {
  double h;
  double error;  ///< that the accepted step would have had with the next step's order
};

/// A solved step inside an attempt.
template <class Real>
struct StepPiece {
  const State<Real>* from;
  const StagePolynomial<Real>* stages;
};

template <class Real>
struct StepPieces {
  std::array<StepPiece<Real>, 2> at;
  std::size_t count;
};

template <class Real>
class StepAttempt {
 public:
  virtual ~StepAttempt() = default;
  /// One step of size h from `from` to `to` (not aliased).
  [[nodiscard]] virtual AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) = 0;
  /// Resets all history: the next integration is bitwise that of a new object.
  virtual void begin() { forget(); }
  /// Forgets the last solved step, which is a bad prediction after a failure of Newton's method or a change of mode.
  /// (A step with too large an error is a good prediction of a shorter one.)
  virtual void forget() = 0;
  /// After a restart from a consistent (a, k): the first step has to follow them.
  virtual void restart() { forget(); }
  /// The step of size h that was attempted last is taken over, and the controller asks for h_next:
  /// the size of the next one, another where the order changes.
  virtual NextStep accepted(const AttemptResult& result, double h, double h_next) {
    static_cast<void>(h);
    return {h_next, result.error};
  }
  /// p of the estimate's leading error h^(p+1) in the next attempt.
  virtual int order() const = 0;
  /// The component of (u, v, x, z) with the largest error of the last solved step; -1 if not known.
  virtual Index worstComponent() const { return -1; }
  /// The parts of which the last solved step is made, in order: their starts and stages. Valid
  /// while `from` of the attempt is.
  virtual StepPieces<Real> pieces(const State<Real>& from) const = 0;
  /// Whether `pieces` has to give all pieces from now on; if not, an estimate may drop those that it does not need.
  virtual void keepPieces(bool keep) { static_cast<void>(keep); }
};

/// `error`, or a larger one whose leading term is h^q where the controller expects h^(p+1): so that its
/// step for h^(p+1) is the right one.
double worse(double error, int p, double other, int q);

/// 1 / (2^q - 1) per component (u, v, x, z): what the difference of one step and two halves is
/// multiplied by. q: the classical order for all (paper) or, with `richardson`, the component's
/// own: what its index (from the exponents of the error norm), the stage order and stiff accuracy
/// guarantee. HW II, table VII.4.1; Hairer, Lubich & Roche, LNM 1409.
template <class Real>
Vec<double> doublingFactors(const Scheme<Real>& scheme, const System<Real>& system, ErrorEstimate estimate);

/// What an estimate is made from. All references outlive it.
template <class Real>
struct StepAttemptSetup {
  const System<Real>& system;
  /// One or, with variable order, members of a family by ascending stages, of which `start` is the first.
  const SchemeList<Real>& schemes;
  std::size_t start;
  const IntegratorOptions& options;
  SharedJacobian<Real>& jacobian;
  const ErrorNorm<Real>& norm;
  Counters& counters;

  const Scheme<Real>& scheme() const { return schemes[start]; }
};
template <class Real>
using StepAttemptMaker = std::function<std::unique_ptr<StepAttempt<Real>>(const StepAttemptSetup<Real>&)>;

/// An error estimate.
template <>
struct Strategy<ErrorEstimate> {
  ErrorEstimate id;
  std::string meaning;
  Needs needs = {};
  bool estimates = true;  ///< false: there is no error to control steps by
  /// Beside the error of a step: looks at the switches in a step that goes on over them, and at stiff components at
  /// the end (core/integration/stiff_rest.h). The paper's estimates do not.
  bool looks_further = false;
  bool own_orders = false;       ///< divides each component's difference by its own order, see doublingFactors
  bool compares_orders = false;  ///< can estimate the error of another method of the family
  PerScalar<StepAttemptMaker> make;
};
template <>
Catalogue<ErrorEstimate>& catalogue<ErrorEstimate>();

/// The estimate of the options.
template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const StepAttemptSetup<Real>& setup) {
  return catalogue<ErrorEstimate>()[setup.options.step.estimate].make.template of<Real>()(setup);
}

}  // namespace irk
