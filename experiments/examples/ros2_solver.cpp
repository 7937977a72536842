// A solver of one's own: ROS2, a Rosenbrock method of order 2 with an embedded solution of order 1. Verwer, Spee, Blom
// and Hundsdorfer, SIAM J. Sci. Comput. 20 (1999), 1456-1480.
//
//   irk solve van_der_pol --method ros2_solver.cpp --tol 1e-6
#include <irk/peer.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace {

using irk::Index;
using Vector = irk::Vec<double>;

class Ros2 final : public irk::Peer {
 public:
  explicit Ros2(const irk::PeerSetup& setup)
      : setup_(setup), n_(setup.problem.layout().n), f_(n_), dfdt_(n_), k1_(n_), k2_(n_), next_(n_) {}

  irk::Outcome integrate(const irk::PeerStart& start, double t_end, const irk::PeerAccepted& accepted) override {
    double t = start.t;
    Vector y = irk::ConstVec<double>(start.y, n_);
    double h = std::min(setup_.h > 0 ? setup_.h : 1e-6 * (t_end - t), setup_.h_max);
    while (t < t_end) {
      if (setup_.problem.stopped()) return irk::Outcome::kInterrupted;
      if (t + 0.1 * h == t) return irk::Outcome::kStepTooSmall;
      const bool last = h >= t_end - t;
      if (last) h = t_end - t;
      const double error = step(t, y, h);
      const double factor = std::clamp(0.9 / std::sqrt(std::max(error, 1e-10)), 0.2, 5.0);
      if (error > 1 || !std::isfinite(error)) {
        ++rejected_;
        h *= std::isfinite(error) ? factor : 0.2;
        continue;
      }
      t = last ? t_end : t + h;
      y = next_;
      h = std::min(h * factor, setup_.h_max);
      if (accepted({t, y.data()}) == irk::PeerNext::kReturn) break;
    }
    return irk::Outcome::kSuccess;
  }

  void count(irk::Counters& counters) const override { counters.steps_rejected_error += rejected_; }

 private:
  // Writes the end of the step to next_ and returns its error in units of the tolerance; NaN if there is none.
  double step(double t, const Vector& y, double h) {
    const double gamma = 1 + 1 / std::sqrt(2.0);
    auto& problem = setup_.problem;
    const auto done = [](irk::Evaluated result) { return result == irk::Evaluated::kDone; };
    if (!done(problem.rates(t, y.data(), f_.data()))) return NAN;
    if (!done(problem.jacobian(t, y.data(), nullptr, 0, jacobian_, dfdt_.data()))) return NAN;
    irk::Mat<double> matrix = irk::Mat<double>::Identity(n_, n_);
    jacobian_.forEach([&](Index i, Index j, double value) { matrix(i, j) -= gamma * h * value; });
    const Eigen::PartialPivLU<irk::Mat<double>> lu(matrix);
    k1_ = lu.solve(f_ + gamma * h * dfdt_);
    next_ = y + h * k1_;
    if (!done(problem.rates(t + h, next_.data(), f_.data()))) return NAN;
    k2_ = lu.solve(f_ - gamma * h * dfdt_ - 2 * k1_);
    next_ = y + h * (1.5 * k1_ + 0.5 * k2_);
    double sum = 0;
    for (Index i = 0; i < n_; ++i) {
      const double weight = setup_.atol[i] + setup_.rtol * std::max(std::abs(y[i]), std::abs(next_[i]));
      sum += std::pow(0.5 * h * (k1_[i] + k2_[i]) / weight, 2);
    }
    return std::sqrt(sum / static_cast<double>(n_));
  }

  irk::PeerSetup setup_;
  Index n_;
  Vector f_, dfdt_, k1_, k2_, next_;
  irk::PeerJacobian jacobian_;
  std::int64_t rejected_ = 0;
};

}  // namespace

IRK_REGISTER {
  irk::registerPeer({.id = "ros2", .title = "ROS2, a Rosenbrock method of order 2", .make = irk::makePeerOf<Ros2>});
}
