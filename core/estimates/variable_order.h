// Steps with the embedded estimate, by one method or by the members of a family.
#pragma once

#include <memory>
#include <vector>

#include "core/base/recycled.h"
#include "core/control/order_controller.h"
#include "core/estimates/defect.h"
#include "core/estimates/embedded.h"
#include "core/estimates/step_attempt.h"

namespace irk {

/// The number of stages to begin with if none is given. It grows as the tolerance shrinks. It is odd, because A then
/// has a real eigenvalue, which the estimate uses as well. Measured over the suite's scenes, the best fixed number is 3
/// to 9 (median 5) at errors of 1e-4, 5 to 11 (median 7) at 1e-8, and 5 to 10 (median 8) at 1e-11.
Index firstStages(const Tolerances& tolerances);

/// One method, or the members of a family, among which an OrderController chooses. Members share the Jacobian. Each
/// keeps its own factors and scratch, allocated at its first use. The estimate for the member below uses the stages'
/// polynomial cut to that member's degree.
template <class Real>
class VariableOrder final : public StepAttempt<Real> {
 public:
  explicit VariableOrder(const StepAttemptSetup<Real>& setup);

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override;
  void begin(double length) override;
  void forget() override;
  void restart() override {
    forget();
    restarted_ = watches_start_ = true;
  }
  NextStep accepted(const AttemptResult& result, double h, double h_next) override;
  int order() const override;
  Index worstComponent() const override { return member().estimate.worstComponent(); }
  const State<Real>* errors() const override {
    return &members_[past_at_]->estimate.errors();  // the order may have changed since
  }
  StepPieces<Real> pieces(const State<Real>& from) const override {
    return {{{{&from, past_}, {nullptr, nullptr}}}, 1};
  }

 private:
  struct Member : Recycled {
    Member(const StepAttemptSetup<Real>& setup, const Scheme<Real>& s)
        : scheme(s),
          stepper(setup.system, s, setup.options, setup.jacobian, setup.norm, setup.counters),
          estimate(setup.system, s, setup.options, stepper.matrix(), setup.norm, setup.counters),
          defect(estimate, s, setup.system.sizes(), Defect<Real>::Start::kLeaveOut, setup.options.step.looks) {}
    const Scheme<Real>& scheme;
    Stepper<Real> stepper;
    EmbeddedEstimate<Real> estimate;
    Defect<Real> defect;
    int epoch = 0;  ///< the epoch in which it last forgot
  };
  void make(std::size_t i);
  double muOf(std::size_t i);
  Member& member() { return *members_[at_]; }
  const Member& member() const { return *members_[at_]; }
  const OrderMember& rank() const { return ranks_[at_]; }
  void changeTo(std::size_t next);
  void forget(Member& m);

  const StepAttemptSetup<Real> setup_;
  std::vector<OrderMember> ranks_;                  // of every member, also of those not yet made
  std::vector<double> mus_;                         // EmbeddedEstimate::weight; NaN until it is asked for
  std::unique_ptr<OrderController> order_control_;  // null: one method
  std::vector<std::unique_ptr<Member>> members_;    // null until first used
  const SharedJacobian<Real>& jacobian_;
  std::size_t start_, at_, past_at_;         // past_at_: the member of past_
  const StagePolynomial<Real>* past_;        // stages of the last solved step
  int failures_ = 0;                         // of Newton, in a row
  bool solved_ = false;                      // this integration has solved a step
  std::shared_ptr<const Pattern> reserved_;  // the pattern that every member has reserved memory for
  int epoch_ = 0;                            // members not in use forget when they are next used
  bool again_ = true;                        // filter twice: after a start and a rejection
  double length_ = 0;                        // of the integration
  bool watches_start_ = false;               // in the first step after a restart
  bool restarted_ = false;                   // since the last accepted step
  double lower_error_;                       // estimate for the member below, NaN if not known
};

}  // namespace irk
