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

/// The next step after an accepted one.
struct NextStep {
  double h;
  double error;  ///< the error that the accepted step would have had with the next step's order
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
  /// Attempts a step of size h from `from` to `to`, which are different objects.
  [[nodiscard]] virtual AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) = 0;
  /// Resets all history: the next integration, over this length, is bitwise that of a new object.
  virtual void begin(double length) {
    static_cast<void>(length);
    forget();
  }
  /// Forgets the last solved step, which is a bad prediction after a failure of Newton's method or a change of mode.
  /// (A step with too large an error is a good prediction of a shorter one.)
  virtual void forget() = 0;
  /// After a restart from a consistent (a, k), which the first step has to follow.
  virtual void restart() { forget(); }
  /// Reports that the step of size h attempted last was accepted and that the controller asks for `h_next`. Returns the
  /// size of the next step, which differs from `h_next` if the order changes.
  virtual NextStep accepted(const AttemptResult& result, double h, double h_next) {
    static_cast<void>(h);
    return {h_next, result.error};
  }
  /// p of the estimate's leading error h^(p+1) in the next attempt.
  virtual int order() const = 0;
  /// The component of (u, v, x, z) with the largest error of the last solved step; -1 if not known.
  virtual Index worstComponent() const { return -1; }
  /// The estimated errors of the last solved step by component, where they are within the tolerance; null where the
  /// strategy does not keep them.
  virtual const State<Real>* errors() const { return nullptr; }
  /// The parts of the last solved step, in order: their starts and stages. Valid as long as `from` of the attempt is.
  virtual StepPieces<Real> pieces(const State<Real>& from) const = 0;
  /// Whether `pieces` has to return all pieces from now on; otherwise an estimate may drop pieces that it does not
  /// need.
  virtual void keepPieces(bool keep) { static_cast<void>(keep); }
};

/// The larger of `error` and `other`, where the controller expects the leading term h^(p+1) and `other` has the leading
/// term h^q. `other` is converted so that the controller's step is the right one for it.
double worse(double error, int p, double other, int q);

/// 1 / (2^q - 1) per component (u, v, x, z), by which the difference of one step and two half steps is multiplied. q is
/// the classical order for all components (paper) or, with `richardson`, the order that the component's index (from the
/// exponents of the error norm), the stage order and stiff accuracy guarantee. HW II, table VII.4.1; Hairer, Lubich &
/// Roche, LNM 1409.
template <class Real>
Vec<double> doublingFactors(const Scheme<Real>& scheme, const System<Real>& system, ErrorEstimate estimate);

/// What an error estimate needs. All references must outlive it.
template <class Real>
struct StepAttemptSetup {
  const System<Real>& system;
  /// One method; or, with variable order, members of a family by ascending stages, starting with member `start`.
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

/// A strategy of the axis `estimate`.
template <>
struct Strategy<ErrorEstimate> {
  ErrorEstimate id;
  std::string meaning;
  Needs needs = {};
  bool estimates = true;  ///< false: gives no error to control steps by
  /// Besides the error of a step, checks the switches in a step that goes on over them. The paper's estimates do not.
  bool looks_further = false;
  bool own_orders = false;       ///< divides each component's difference by its own order, see doublingFactors
  bool compares_orders = false;  ///< can estimate the error of another method of the family
  PerScalar<StepAttemptMaker> make;
};
template <>
Catalogue<ErrorEstimate>& catalogue<ErrorEstimate>();

/// The error estimate that the options name.
template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const StepAttemptSetup<Real>& setup) {
  const ErrorEstimate estimate = setup.options.step.estimate;
  return madeBy(catalogue<ErrorEstimate>()[estimate].make.template of<Real>(), estimate, setup);
}

}  // namespace irk
