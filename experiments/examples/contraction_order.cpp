// A controller of the order: more stages where Newton's method converges fast, fewer where it converges slowly or
// fails. Hairer & Wanner, J. Comput. Appl. Math. 111 (1999).
#include <irk/strategies.h>

namespace {

class ContractionOrder final : public irk::OrderController {
 public:
  explicit ContractionOrder(irk::OrderSetup setup) : setup_(std::move(setup)) {}

  void begin() override { steps_ = 0; }
  std::size_t afterFailure(std::size_t at, int failures, bool solved) override {
    return solved && failures > 1 && at > 0 ? at - 1 : at;
  }
  bool needsLower() const override { return false; }
  irk::OrderDecision decide(const irk::OrderFacts& facts) override {
    std::size_t next = facts.at;
    if (++steps_ % 10 == 0) {
      if (facts.theta < 0.002 && next + 1 < setup_.members.size()) ++next;
      if (facts.theta > 0.8 && next > 0) --next;
    }
    return {next, facts.h_next, facts.error};
  }

 private:
  irk::OrderSetup setup_;
  int steps_ = 0;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::OrderControl>(
      {.id = {"contraction"},
       .meaning = "by the contraction of Newton's method",
       .needs = {.embedded_estimate = true},
       .make = [](const irk::OrderSetup& setup) { return std::make_unique<ContractionOrder>(setup); }});
}
