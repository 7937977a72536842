// Shared by the SUNDIALS integrators: owners of its C objects, set-up, counters, messages.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#if SUNDIALS_VERSION_MAJOR >= 7
#include <sundials/sundials_context.hpp>
#endif

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "irk/peer.h"

namespace irk::sundials {

template <auto Free>
struct Freer {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
template <class Handle, auto Free>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Freer<Free>>;

/// Owns the context, vectors of n numbers, the matrix with its solver, and the library's messages.
class Workspace {
 public:
  explicit Workspace(Index n);

  SUNContext context() { return context_; }
  N_Vector y() { return y_.get(); }
  double* values() { return N_VGetArrayPointer(y_.get()); }
  SUNMatrix matrix() { return matrix_.get(); }
  SUNLinearSolver solver() { return solver_.get(); }
  /// Makes another vector of n numbers; the Workspace owns it.
  N_Vector add(const Vec<double>& values);
  std::string& message() { return message_; }
  const std::string& message() const { return message_; }

  /// Makes matrix and solver for a pattern: dense if it is full; banded if at least half of the band is filled; else
  /// sparse, factorized by KLU. Returns false if the present matrix already suits the pattern.
  bool choose(const std::shared_ptr<const PeerPattern>& pattern);
  /// Writes a Jacobian to `to`, a matrix of the chosen kind. Returns false if the Jacobian has entries outside the
  /// pattern of that matrix.
  bool fill(const PeerJacobian& J, SUNMatrix to) const;

 private:
  ::sundials::Context context_;
  Owner<N_Vector, N_VDestroy> y_;
  std::vector<Owner<N_Vector, N_VDestroy>> more_;
  std::shared_ptr<const PeerPattern> pattern_;
  Owner<SUNMatrix, SUNMatDestroy> matrix_;
  Owner<SUNLinearSolver, SUNLinSolFree> solver_;
  std::string message_;
};

/// What a function of roots returns after `count` values g at t: an error if any of them is not finite. SUNDIALS would
/// look for the root for ever.
int statusOfRoots(double t, const double* g, Index count);

/// The outcome of an integrator's return value; the three integrators agree on the values used here.
Outcome outcomeOf(int flag);

/// Throws std::runtime_error with the call's text if `flag` reports a failed set-up call.
void require(int flag, const char* call);
#define IRK_SUNDIALS(call) ::irk::sundials::require(call, #call)

/// The error handler of version 6: stores the text in the std::string `to`. Since version 7 handlers belong to the
/// context.
void keepMessage(int code, const char* module, const char* function, char* text, void* to);
#if SUNDIALS_VERSION_MAJOR < 7
#define IRK_SUNDIALS_ERROR_HANDLER(prefix) static constexpr auto setErrHandlerFn = prefix##SetErrHandlerFn;
#else
#define IRK_SUNDIALS_ERROR_HANDLER(prefix)
#endif

/// The functions that CVODE, ARKODE and IDA all have, under the same name after their prefix.
#define IRK_SUNDIALS_API(prefix, JacFn, RootFn)                                \
  using Jacobian = JacFn;                                                      \
  using Roots = RootFn;                                                        \
  IRK_SUNDIALS_ERROR_HANDLER(prefix)                                           \
  static constexpr auto setUserData = prefix##SetUserData;                     \
  static constexpr auto svTolerances = prefix##SVtolerances;                   \
  static constexpr auto setLinearSolver = prefix##SetLinearSolver;             \
  static constexpr auto setJacFn = prefix##SetJacFn;                           \
  static constexpr auto setInitStep = prefix##SetInitStep;                     \
  static constexpr auto setMaxStep = prefix##SetMaxStep;                       \
  static constexpr auto setStopTime = prefix##SetStopTime;                     \
  static constexpr auto rootInit = prefix##RootInit;                           \
  static constexpr auto setRootDirection = prefix##SetRootDirection;           \
  static constexpr auto setNoInactiveRootWarn = prefix##SetNoInactiveRootWarn; \
  static constexpr auto getRootInfo = prefix##GetRootInfo;                     \
  static constexpr auto getNumLinSolvSetups = prefix##GetNumLinSolvSetups;     \
  static constexpr auto getNumNonlinSolvIters = prefix##GetNumNonlinSolvIters; \
  static constexpr auto getNumErrTestFails = prefix##GetNumErrTestFails;       \
  static constexpr auto getNumStepSolveFails = prefix##GetNumStepSolveFails;   \
  struct Free {                                                                \
    void operator()(void* memory) const { prefix##Free(&memory); }             \
  };

/// What a callback returns: after a positive number the integrator tries a smaller step, after a negative one it ends.
constexpr int statusOf(Evaluated evaluated) { return static_cast<int>(evaluated); }
/// Return values and tasks; they are equal in all three integrators.
constexpr int kOneStep = 2, kRootReturn = 2;

/// Owns an integrator's memory and implements what does not depend on the form of the equation.
template <class Api>
class Solver {
 public:
  /// `jacobian` and `roots` are the callbacks; they get `self` as user data.
  Solver(const PeerSetup& setup, void* self, typename Api::Jacobian jacobian, typename Api::Roots roots)
      : setup_(setup),
        self_(self),
        jacobian_(jacobian),
        roots_callback_(roots),
        roots_(static_cast<std::size_t>(setup.problem.layout().switches)),
        workspace_(setup.problem.layout().n),
        atol_(workspace_.add(setup.atol)) {}

  Workspace& workspace() { return workspace_; }
  const Workspace& workspace() const { return workspace_; }

  /// Takes ownership of new memory.
  void own(void* memory) {
    memory_.reset(memory);
#if SUNDIALS_VERSION_MAJOR < 7
    IRK_SUNDIALS(Api::setErrHandlerFn(memory, keepMessage, &workspace_.message()));
#endif
    IRK_SUNDIALS(Api::setUserData(memory, self_));
    IRK_SUNDIALS(Api::svTolerances(memory, setup_.rtol, atol_));
    IRK_SUNDIALS(Api::setInitStep(memory, setup_.h));
    IRK_SUNDIALS(Api::setMaxStep(memory, setup_.h_max));
    workspace_.choose(setup_.problem.pattern());
    setLinearSolver();
    if (!setup_.locate || roots_.empty()) return;
    std::vector<int> rising(roots_.size(), 1);
    IRK_SUNDIALS(Api::rootInit(memory, static_cast<int>(rising.size()), roots_callback_));
    IRK_SUNDIALS(Api::setRootDirection(memory, rising.data()));
    IRK_SUNDIALS(Api::setNoInactiveRootWarn(memory));
  }
  void* memory() const { return memory_.get(); }

  /// Writes the Jacobian that `evaluate` writes into its argument; for the callback.
  template <class Evaluate>
  int fill(SUNMatrix to, const Evaluate& evaluate) {
    const Evaluated evaluated = evaluate(J_);
    if (evaluated != Evaluated::kDone) return statusOf(evaluated);
    outgrown_ = !workspace_.fill(J_, to);
    return statusOf(outgrown_ ? Evaluated::kStop : Evaluated::kDone);
  }

  /// Runs from t to t_end. `reInit(t)` starts anew from the values of y (and y'), `advance(t)` takes a step and
  /// `step(t)` describes it. If the pattern of the Jacobian grows, the integrator starts anew with another matrix.
  template <class ReInit, class Advance, class Step>
  Outcome run(double t, double t_end, const PeerAccepted& accepted, const ReInit& reInit, const Advance& advance,
              const Step& step) {
    begin(t, t_end, reInit);
    while (t < t_end) {
      const int flag = advance(&t);
      if (flag < 0 && outgrown_) {
        begin(t, t_end, reInit);
        continue;
      }
      if (flag < 0) return outcomeOf(flag);
      std::fill(roots_.begin(), roots_.end(), 0);
      if (flag == kRootReturn) IRK_SUNDIALS(Api::getRootInfo(memory(), roots_.data()));
      PeerStep done = step(t);
      done.roots = roots_.data();
      if (accepted(done) == PeerNext::kReturn) break;
    }
    return Outcome::kSuccess;
  }

  void count(Counters& counters) const {
    const auto read = [this](auto get) {
      long number = 0;
      get(memory(), &number);
      return number;
    };
    counters.factorizations += read(Api::getNumLinSolvSetups);
    counters.newton_iterations += read(Api::getNumNonlinSolvIters);
    counters.solves += read(Api::getNumNonlinSolvIters);
    counters.steps_rejected_error += read(Api::getNumErrTestFails);
    counters.steps_rejected_newton += read(Api::getNumStepSolveFails);
  }

 private:
  void setLinearSolver() {
    IRK_SUNDIALS(Api::setLinearSolver(memory(), workspace_.solver(), workspace_.matrix()));
    IRK_SUNDIALS(Api::setJacFn(memory(), jacobian_));
  }
  template <class ReInit>
  void begin(double t, double t_end, const ReInit& reInit) {
    outgrown_ = false;
    IRK_SUNDIALS(reInit(t));
    if (workspace_.choose(setup_.problem.pattern())) setLinearSolver();
    IRK_SUNDIALS(Api::setStopTime(memory(), t_end));
  }

  PeerSetup setup_;
  void* self_;
  typename Api::Jacobian jacobian_;
  typename Api::Roots roots_callback_;
  std::vector<int> roots_;
  Workspace workspace_;
  N_Vector atol_;
  std::unique_ptr<void, typename Api::Free> memory_;
  PeerJacobian J_;
  bool outgrown_ = false;
};

}  // namespace irk::sundials
