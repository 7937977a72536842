// SUNDIALS CVODE with BDF of orders 1 to 5, set up as its manual recommends for stiff systems: modified Newton with the
// exact Jacobian and the solver that suits its pattern (dense, banded, KLU), rtol and a vector of atol, no step beyond
// the end. All other options keep their defaults. Hindmarsh et al., ACM TOMS 31 (2005).
#include <cvode/cvode.h>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/sundials_ode.h"

namespace irk {
namespace {

struct Cvode {
  IRK_SUNDIALS_API(CVode, CVLsJacFn, CVRootFn)
  static constexpr bool kRemembers = false;
  static void* create(SUNContext context, CVRhsFn rates, N_Vector y) {
    void* const memory = CVodeCreate(CV_BDF, context);
    IRK_SUNDIALS(CVodeInit(memory, rates, 0, y));
    return memory;
  }
  static void set(void*) {}
  static int reInit(void* memory, CVRhsFn, double t, N_Vector y) { return CVodeReInit(memory, t, y); }
  static int advance(void* memory, double t_end, N_Vector y, double* t) {
    return CVode(memory, t_end, y, t, sundials::kOneStep);
  }
};

}  // namespace

std::unique_ptr<Peer> makeCvode(const PeerSetup& setup) { return std::make_unique<sundials::OdePeer<Cvode>>(setup); }

}  // namespace irk
