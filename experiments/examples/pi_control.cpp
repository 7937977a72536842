// A PI step controller: HW II (IV.2.43b), h_next = h 0.9 error^(-0.7/q) last_error^(0.4/q), q = order + 1.
#include <irk/strategies.h>

#include <algorithm>
#include <cmath>

namespace {

class PiController final : public irk::StepController {
 public:
  explicit PiController(int order) : q_(order + 1) {}

  irk::StepDecision decide(double error, double h) override {
    const double e = std::max(error, 1e-10);
    if (e > 1) return {false, h * std::max(0.2, 0.9 * std::pow(e, -1 / q_))};
    const double factor = 0.9 * std::pow(e, -0.7 / q_) * std::pow(last_error_, 0.4 / q_);
    last_error_ = std::max(e, 1e-4);
    return {true, h * std::clamp(factor, 0.2, 5.0)};
  }
  double afterFailure(double h) override { return h / 2; }
  void forget() override { last_error_ = 1; }
  void changeOrder(int order, double, double) override { q_ = order + 1; }

 private:
  double q_;
  double last_error_ = 1;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::StepControl>(
      {.id = {"pi"},
       .meaning = "PI controller, HW II (IV.2.43b)",
       .needs = {.estimate = true},
       .make = [](const irk::StepOptions&, int order) { return std::make_unique<PiController>(order); }});
}
