// Implicit integrators of the GNU Scientific Library, called through its driver. The manual prescribes the driver for
// rk4imp and msbdf, because it passes the tolerance on to Newton's method. Control of rtol |y| + atol with an atol
// per component; exact Jacobian and df/dt. GSL reports neither Newton iterations nor factorizations.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>

#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/explicit_ode.h"

namespace irk {
namespace {

// The first guess of HW I (II.4): the solution changes by a hundredth of its size.
double firstStep(const Vec<double>& y, const Vec<double>& f, double length) {
  const double d0 = y.norm(), d1 = f.norm();
  return d0 > 1e-5 && d1 > 1e-5 ? std::min(0.01 * d0 / d1, length) : 1e-6 * length;
}

struct FreeDriver {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

class Gsl final : public Peer {
 public:
  Gsl(const PeerSetup& setup, const gsl_odeiv2_step_type* type)
      : ode_(setup.system),
        given_h_(setup.h),
        h_max_(setup.h_max),
        y_(ode_.size()),
        f_(ode_.size()),
        dfdt_(ode_.size()),
        dfdy_(ode_.size(), ode_.size()),
        system_{rates, jacobian, static_cast<std::size_t>(ode_.size()), this} {
    // GSL's own handler would end the program; every call here checks the returned status instead.
    gsl_set_error_handler_off();
    // atol_i + rtol |y_i|
    driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&system_, type, 1, 1, setup.rtol, 1, 0, setup.atol.data()));
  }

  StartReport start(State<double>& state, double t_end, StartCheck) override {
    y_ = state.x;
    t_end_ = t_end;
    ode_.setDiscrete(state.d);
    ode_.resetCounts();
    if (!ode_.rates(state.t, y_.data(), f_.data())) {
      return {Outcome::kNotFinite, "the right-hand side at the start"};
    }
    h_ = given_h_ > 0 ? given_h_ : firstStep(y_, f_, t_end - state.t);
    gsl_odeiv2_driver_reset(driver_.get());
    driver_->e->failed_steps = 0;
    return {};
  }

  Outcome step(State<double>& state) override {
    h_ = std::min(h_, h_max_);
    status_ = gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &system_, &state.t, t_end_, &h_, y_.data());
    if (status_ != GSL_SUCCESS) return Outcome::kStepTooSmall;
    if (!y_.allFinite()) return Outcome::kNotFinite;
    state.x = y_;
    return Outcome::kSuccess;
  }

  void setDiscrete(const Vec<double>& d) override { ode_.setDiscrete(d); }
  void count(Counters& counters) const override {
    ode_.count(counters);
    counters.steps_rejected_error += static_cast<std::int64_t>(driver_->e->failed_steps);
  }
  std::string message() const override { return gsl_strerror(status_); }

 private:
  // GSL_FAILURE makes GSL try a smaller step.
  static int rates(double t, const double* y, double* f, void* self) {
    return static_cast<Gsl*>(self)->ode_.rates(t, y, f) ? GSL_SUCCESS : GSL_FAILURE;
  }
  static int jacobian(double t, const double* y, double* dfdy, double* dfdt, void* self) {
    auto& gsl = *static_cast<Gsl*>(self);
    const bool done = gsl.ode_.jacobian(t, y, gsl.dfdy_, gsl.dfdt_);
    const Index n = gsl.ode_.size();
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(dfdy, n, n) = gsl.dfdy_;
    VecView<double>(dfdt, n) = gsl.dfdt_;
    return done ? GSL_SUCCESS : GSL_FAILURE;
  }

  ExplicitOde ode_;
  double given_h_, h_max_;
  Vec<double> y_, f_, dfdt_;
  Mat<double> dfdy_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, FreeDriver> driver_;
  double h_ = 0, t_end_ = 0;
  int status_ = GSL_SUCCESS;
};

}  // namespace

std::unique_ptr<Peer> makeGslRk4imp(const PeerSetup& setup) {
  return std::make_unique<Gsl>(setup, gsl_odeiv2_step_rk4imp);
}
std::unique_ptr<Peer> makeGslMsbdf(const PeerSetup& setup) {
  return std::make_unique<Gsl>(setup, gsl_odeiv2_step_msbdf);
}
std::unique_ptr<Peer> makeGslBsimp(const PeerSetup& setup) {
  return std::make_unique<Gsl>(setup, gsl_odeiv2_step_bsimp);
}

}  // namespace irk
