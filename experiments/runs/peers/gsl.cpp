// Implicit integrators of the GNU Scientific Library, called through its driver. The manual prescribes the driver for
// rk4imp and msbdf, because it passes the tolerance on to Newton's method. Control of rtol |y| + atol with an atol
// per component; exact Jacobian and df/dt; always dense. GSL reports neither Newton iterations nor factorizations.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>

#include "experiments/runs/peers/catalogue.h"

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
      : problem_(setup.problem),
        n_(problem_.layout().n),
        given_h_(setup.h),
        h_max_(setup.h_max),
        y_(n_),
        f_(n_),
        system_{rates, jacobian, static_cast<std::size_t>(n_), this} {
    // GSL's own handler would end the program; every call here checks the returned status instead.
    gsl_set_error_handler_off();
    // atol_i + rtol |y_i|
    driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&system_, type, 1, 1, setup.rtol, 1, 0, setup.atol.data()));
  }

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    y_ = ConstVec<double>(start.y, n_);
    double t = start.t;
    driver_->e->failed_steps = 0;
    message_ = "the right-hand side cannot be evaluated at the start";
    if (problem_.rates(t, y_.data(), f_.data()) != Evaluated::kDone) return Outcome::kNotFinite;
    double h = given_h_ > 0 ? given_h_ : firstStep(y_, f_, t_end - t);
    gsl_odeiv2_driver_reset(driver_.get());
    while (t < t_end) {
      h = std::min(h, h_max_);
      const int status =
          gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &system_, &t, t_end, &h, y_.data());
      message_ = gsl_strerror(status);
      if (status != GSL_SUCCESS) return Outcome::kStepTooSmall;
      if (!y_.allFinite()) return Outcome::kNotFinite;
      if (accepted({t, y_.data()}) == PeerNext::kReturn) break;
    }
    return Outcome::kSuccess;
  }

  void count(Counters& counters) const override {
    counters.steps_rejected_error += static_cast<std::int64_t>(driver_->e->failed_steps);
  }
  std::string message() const override { return message_; }

 private:
  // GSL_FAILURE makes GSL try a smaller step; any other failure ends its step.
  static int statusOf(Evaluated evaluated) {
    if (evaluated == Evaluated::kStop) return GSL_EBADFUNC;
    return evaluated == Evaluated::kDone ? GSL_SUCCESS : GSL_FAILURE;
  }
  static int rates(double t, const double* y, double* f, void* self) {
    return statusOf(static_cast<Gsl*>(self)->problem_.rates(t, y, f));
  }
  static int jacobian(double t, const double* y, double* dfdy, double* dfdt, void* self) {
    auto& gsl = *static_cast<Gsl*>(self);
    const Evaluated evaluated = gsl.problem_.jacobian(t, y, nullptr, 0, gsl.J_, dfdt);
    const Index n = gsl.n_;
    std::fill_n(dfdy, n * n, 0);
    gsl.J_.forEach([dfdy, n](Index i, Index j, double value) { dfdy[i * n + j] = value; });
    return statusOf(evaluated);
  }

  PeerProblem& problem_;
  Index n_;
  double given_h_, h_max_;
  Vec<double> y_, f_;
  PeerJacobian J_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, FreeDriver> driver_;
  std::string message_;
};

}  // namespace

bool hasGsl() { return true; }

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
