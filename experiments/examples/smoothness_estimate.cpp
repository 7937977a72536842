// An error estimate without a second solution: h times the highest Legendre coefficients of (a, k) in the polynomial
// through the stages. They show how well the step resolves the motion, not how accurate its end is: of a method of
// high order the steps are shorter than they need to be.
#include <irk/strategies.h>

namespace {

class SmoothnessEstimate final : public irk::StepAttempt<double> {
 public:
  explicit SmoothnessEstimate(const irk::StepAttemptSetup<double>& s)
      : stepper_(s.system, s.scheme(), s.options, s.jacobian, s.norm, s.counters) {}

  irk::AttemptResult attempt(const irk::State<double>& from, const double& h, irk::State<double>& to) override {
    irk::AttemptResult result{stepper_.attempt(stepper_.stages(), from, h, to)};
    if (result.outcome == irk::Outcome::kSuccess) result.error = stepper_.roughness();
    return result;
  }
  void forget() override { stepper_.forget(); }
  int order() const override { return stepper_.decay() - 1; }
  irk::StepPieces<double> pieces(const irk::State<double>& from) const override {
    return {{{{&from, &stepper_.stages()}, {nullptr, nullptr}}}, 1};
  }

 private:
  irk::Stepper<double> stepper_;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::ErrorEstimate>(
      {.id = {"smoothness"},
       .meaning = "the highest Legendre coefficients of the stages",
       .make = {[](const irk::StepAttemptSetup<double>& setup) { return std::make_unique<SmoothnessEstimate>(setup); },
                {}}});
}
