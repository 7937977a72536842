// Shared by CVODE and ARKODE: y' = f(t, y), where y is the state's x.
#pragma once

#include <algorithm>

#include "experiments/runs/peers/explicit_ode.h"
#include "experiments/runs/peers/sundials.h"

namespace irk::sundials {

/// Right-hand side, Jacobian and switching functions as callbacks. Their user data is an OdeCallbacks*.
struct OdeCallbacks {
  ExplicitOde ode;
  Vec<double> dfdt;

  explicit OdeCallbacks(const System<double>& system) : ode(system), dfdt(ode.size()) {}

  static int rates(double t, N_Vector y, N_Vector f, void* self) {
    const bool done = static_cast<OdeCallbacks*>(self)->ode.rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    return done ? 0 : kTrySmallerStep;
  }
  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector) {
    auto& [ode, dfdt] = *static_cast<OdeCallbacks*>(self);
    Eigen::Map<Mat<double>> dfdy(SUNDenseMatrix_Data(J), ode.size(), ode.size());
    return ode.jacobian(t, N_VGetArrayPointer(y), dfdy, dfdt) ? 0 : kTrySmallerStep;
  }
  static int roots(double t, N_Vector y, double* g, void* self) {
    static_cast<OdeCallbacks*>(self)->ode.switching(t, N_VGetArrayPointer(y), g);
    return 0;
  }
};

/// Api has the functions of IRK_SUNDIALS_API and create(context, y), set(memory), reInit(memory, t, y),
/// advance(memory, t_end, y, t). kRemembers: reInit does not reset everything, so a new integration needs new memory.
template <class Api>
class OdePeer final : public Peer {
 public:
  explicit OdePeer(const PeerSetup& setup)
      : setup_(setup), callbacks_(setup.system), workspace_(callbacks_.ode.size()), atol_(workspace_.add(setup.atol)) {
    createMemory();
  }

  StartReport start(State<double>& state, double t_end, StartCheck check) override {
    if (Api::kRemembers && check == StartCheck::kConstraints) createMemory();
    std::copy(state.x.begin(), state.x.end(), workspace_.values());
    callbacks_.ode.setDiscrete(state.d);
    callbacks_.ode.resetCounts();
    IRK_SUNDIALS(Api::reInit(solver_.memory(), state.t, workspace_.y()));
    solver_.begin(t_end);
    return {};
  }

  Outcome step(State<double>& state) override {
    double t = 0;
    const int flag = Api::advance(solver_.memory(), solver_.end(), workspace_.y(), &t);
    if (flag >= 0) {
      state.t = t;
      state.x = ConstVec<double>(workspace_.values(), state.x.size());
    }
    return solver_.finish(flag);
  }

  bool foundRoot(Index i) const override { return solver_.foundRoot(i); }
  void setDiscrete(const Vec<double>& d) override { callbacks_.ode.setDiscrete(d); }
  void count(Counters& counters) const override {
    callbacks_.ode.count(counters);
    solver_.count(counters);
  }
  std::string message() const override { return workspace_.message(); }

 private:
  void createMemory() {
    void* const memory = Api::create(workspace_.context(), workspace_.y());
    solver_.setUp(memory, setup_, atol_, workspace_, &callbacks_, OdeCallbacks::jacobian, OdeCallbacks::roots);
    Api::set(memory);
  }

  PeerSetup setup_;
  OdeCallbacks callbacks_;
  Workspace workspace_;
  N_Vector atol_;
  Solver<Api> solver_;
};

}  // namespace irk::sundials
