// SUNDIALS ARKODE with its diagonally implicit Runge-Kutta method of order 5, set up as its manual recommends for
// stiff systems: modified Newton with the exact Jacobian and the solver that suits its pattern (dense, banded, KLU),
// rtol and a vector of atol, no step beyond the end, stage derivatives deduced from Newton's result instead of
// evaluated. All other options keep their defaults. Reynolds et al., ACM TOMS 49 (2023).
#include <arkode/arkode_arkstep.h>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/sundials_ode.h"

namespace irk {
namespace {

constexpr int kOrder = 5;
// With the default of 3 iterations, Newton's method halves the steps of stiff problems more often than the error
// does.
constexpr int kArkodeIterations = 10;

// Since version 7.1 what all steppers of ARKODE have in common is named after ARKODE.
#if SUNDIALS_VERSION_MAJOR > 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR >= 1)
#define IRK_ARKODE_API IRK_SUNDIALS_API(ARKode, ARKLsJacFn, ARKRootFn)
#define IRK_ARKODE(function) ARKode##function
#else
#define IRK_ARKODE_API IRK_SUNDIALS_API(ARKStep, ARKLsJacFn, ARKRootFn)
#define IRK_ARKODE(function) ARKStep##function
#endif

struct Arkode {
  IRK_ARKODE_API
  // After the first interpolation, which needs right-hand sides, ARKODE evaluates them in every later step.
  static constexpr bool kRemembers = true;
  static void* create(SUNContext context, ARKRhsFn rates, N_Vector y) {
    return ARKStepCreate(nullptr, rates, 0, y, context);
  }
  static void set(void* memory) {
    IRK_SUNDIALS(IRK_ARKODE(SetOrder)(memory, kOrder));
    IRK_SUNDIALS(IRK_ARKODE(SetInterpolantDegree)(memory, kOrder));
    IRK_SUNDIALS(IRK_ARKODE(SetDeduceImplicitRhs)(memory, SUNTRUE));
    IRK_SUNDIALS(IRK_ARKODE(SetMaxNonlinIters)(memory, kArkodeIterations));
  }
  static int reInit(void* memory, ARKRhsFn rates, double t, N_Vector y) {
    return ARKStepReInit(memory, nullptr, rates, t, y);
  }
  static int advance(void* memory, double t_end, N_Vector y, double* t) {
    return IRK_ARKODE(Evolve)(memory, t_end, y, t, sundials::kOneStep);
  }
};

}  // namespace

std::unique_ptr<Peer> makeArkode(const PeerSetup& setup) { return std::make_unique<sundials::OdePeer<Arkode>>(setup); }

}  // namespace irk
