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

struct Arkode {
  IRK_SUNDIALS_API(ARKStep, ARKLsJacFn, ARKRootFn)
  // After the first interpolation, which needs right-hand sides, ARKODE evaluates them in every later step.
  static constexpr bool kRemembers = true;
  static void* create(SUNContext context, ARKRhsFn rates, N_Vector y) {
    return ARKStepCreate(nullptr, rates, 0, y, context);
  }
  static void set(void* memory) {
    IRK_SUNDIALS(ARKStepSetOrder(memory, kOrder));
    IRK_SUNDIALS(ARKStepSetInterpolantDegree(memory, kOrder));
    IRK_SUNDIALS(ARKStepSetDeduceImplicitRhs(memory, SUNTRUE));
    IRK_SUNDIALS(ARKStepSetMaxNonlinIters(memory, kArkodeIterations));
  }
  static int reInit(void* memory, ARKRhsFn rates, double t, N_Vector y) {
    return ARKStepReInit(memory, nullptr, rates, t, y);
  }
  static int advance(void* memory, double t_end, N_Vector y, double* t) {
    return ARKStepEvolve(memory, t_end, y, t, sundials::kOneStep);
  }
};

}  // namespace

std::unique_ptr<Peer> makeArkode(const PeerSetup& setup) { return std::make_unique<sundials::OdePeer<Arkode>>(setup); }

}  // namespace irk
