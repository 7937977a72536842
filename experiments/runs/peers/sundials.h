// Shared by the SUNDIALS integrators: owners of its C objects, set-up, counters, messages.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/runs/peers/peer.h"

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

/// Owns the context, vectors of n numbers, the dense matrix with its solver, and the library's messages.
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

 private:
  ::sundials::Context context_;
  Owner<N_Vector, N_VDestroy> y_;
  std::vector<Owner<N_Vector, N_VDestroy>> more_;
  Owner<SUNMatrix, SUNMatDestroy> matrix_;
  Owner<SUNLinearSolver, SUNLinSolFree> solver_;
  std::string message_;
};

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
#define IRK_SUNDIALS_API(prefix)                                               \
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

/// Returned by a callback that cannot be evaluated: the integrator then tries a smaller step.
constexpr int kTrySmallerStep = 1;
/// Return values and tasks; they are equal in all three integrators.
constexpr int kOneStep = 2, kRootReturn = 2;

/// Owns an integrator's memory and implements what does not depend on the form of the equation.
template <class Api>
class Solver {
 public:
  /// Takes ownership of `memory`. `jacobian` and `roots` are the callbacks; they get `self` as user data.
  template <class Jacobian, class Roots>
  void setUp(void* memory, const PeerSetup& setup, N_Vector atol, Workspace& workspace, void* self, Jacobian jacobian,
             Roots roots) {
    memory_.reset(memory);
#if SUNDIALS_VERSION_MAJOR < 7
    IRK_SUNDIALS(Api::setErrHandlerFn(memory, keepMessage, &workspace.message()));
#endif
    IRK_SUNDIALS(Api::setUserData(memory, self));
    IRK_SUNDIALS(Api::svTolerances(memory, setup.rtol, atol));
    IRK_SUNDIALS(Api::setLinearSolver(memory, workspace.solver(), workspace.matrix()));
    IRK_SUNDIALS(Api::setJacFn(memory, jacobian));
    IRK_SUNDIALS(Api::setInitStep(memory, setup.h));
    IRK_SUNDIALS(Api::setMaxStep(memory, setup.h_max));
    roots_.assign(static_cast<std::size_t>(setup.system.sizes().switches), 0);
    if (!setup.locate || roots_.empty()) return;
    std::vector<int> rising(roots_.size(), 1);
    IRK_SUNDIALS(Api::rootInit(memory, static_cast<int>(rising.size()), roots));
    IRK_SUNDIALS(Api::setRootDirection(memory, rising.data()));
    IRK_SUNDIALS(Api::setNoInactiveRootWarn(memory));
  }

  void* memory() const { return memory_.get(); }
  bool foundRoot(Index i) const { return roots_[static_cast<std::size_t>(i)] != 0; }

  /// Call after each (re)initialization.
  void begin(double t_end) {
    t_end_ = t_end;
    IRK_SUNDIALS(Api::setStopTime(memory(), t_end));
    roots_.assign(roots_.size(), 0);
  }
  double end() const { return t_end_; }

  /// Call after a step that returned `flag`.
  Outcome finish(int flag) {
    if (flag < 0) return outcomeOf(flag);
    roots_.assign(roots_.size(), 0);
    if (flag == kRootReturn) IRK_SUNDIALS(Api::getRootInfo(memory(), roots_.data()));
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
  std::unique_ptr<void, typename Api::Free> memory_;
  std::vector<int> roots_;
  double t_end_ = 0;
};

}  // namespace irk::sundials
