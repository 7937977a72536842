// Steps with the embedded estimate, by one method or by the members of a family: that with the least
// work per unit step.
#pragma once

#include <memory>
#include <vector>

#include "core/estimates/accumulation.h"
#include "core/estimates/embedded.h"
#include "core/estimates/step_attempt.h"

namespace irk {

/// Stages to begin with where nothing else is said: the more the smaller the tolerance, an odd number, whose
/// real eigenvalue serves the estimate, too. Over the suite's scenes the best fixed number is 3 to 9, in the
/// middle 5, at errors of 1e-4, 5 to 11, in the middle 7, at 1e-8, and 5 to 10, in the middle 8, at 1e-11.
Index firstStages(const Tolerances& tolerances);

/// Members of a family share the Jacobian; each keeps its own factors and scratch, which it allocates when it is first
/// used. After some accepted
/// steps the errors e_q of the member below and of two above are known or guessed: below, by the stages'
/// polynomial cut to its degree; above, by the same ratio again, as the coefficients of a smooth
/// solution decay. They give the steps h_q ~ e_q^(-1/(q+1)), and these Newton's contraction, which
/// grows with the step, its iterations and the work. The member with the most progress per work is
/// next; none is with a step for which Newton would contract badly (Hairer & Wanner, J. Comput.
/// Appl. Math. 111, 1999, decide by the contraction alone). A second failure of
/// Newton in a row leads to the member below, whose equations have less round-off; in the first step,
/// whose size is a guess, the thirteenth.
template <class Real>
class VariableOrder final : public StepAttempt<Real> {
 public:
  explicit VariableOrder(const StepAttemptSetup<Real>& setup);

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override;
  void begin() override;
  void forget() override;
  void restart() override {
    forget();
    continues_ = false;
    restarted_ = watches_start_ = vague_start_ = true;
  }
  NextStep accepted(const AttemptResult& result, double h, double h_next) override;
  int order() const override;
  Index worstComponent() const override { return member().estimate.worstComponent(); }
  StepPieces<Real> pieces(const State<Real>& from) const override {
    return {{{{&from, &member().stepper.stages()}, {nullptr, nullptr}}}, 1};
  }

 private:
  struct Member {
    Member(const StepAttemptSetup<Real>& setup, const Scheme<Real>& s)
        : scheme(s),
          stepper(setup.system, s, setup.options, setup.jacobian, setup.norm, setup.counters),
          estimate(setup.system, s, setup.options, setup.jacobian, stepper.matrix(), setup.norm, setup.counters),
          accumulates(s.tableau.order <= std::min(estimateOrder() + 1, kMaxAccumulating) || !dampsStiffErrors(s)),
          adds(s.tableau.order <= estimateOrder()),
          accumulation(stiffCaution(s), setup.options.tolerances) {}
    const Scheme<Real>& scheme;
    Stepper<Real> stepper;
    EmbeddedEstimate<Real> estimate;
    /// Its estimate is hardly larger than the error, and its steps are many; or errors do not decay.
    bool accumulates;
    bool adds;  ///< its estimate is of the order of the error
    Accumulation accumulation;
    static constexpr int kMaxAccumulating = 4;
    int epoch = 0;  ///< in which it last forgot
    int estimateOrder() const { return EmbeddedEstimate<Real>::order(scheme.tableau); }
  };
  /// What is known of every member without making it.
  struct Rank {
    double stages;
    int order;        ///< of its estimate
    double exigence;  ///< of its estimate, so that all members err alike
    double mu;        ///< EmbeddedEstimate::weight; NaN until it is asked for
  };
  void make(std::size_t i);
  double muOf(std::size_t i);
  Member& member() { return *members_[at_]; }
  const Member& member() const { return *members_[at_]; }
  const Rank& rank() const { return ranks_[at_]; }
  struct Plan {
    double h, error;
    double progress;  ///< h per work; 0: not to be taken
  };
  Plan plan(double estimate, const Rank& rank, const AttemptResult& now, double h, double trend) const;
  void changeTo(std::size_t next);
  void forget(Member& m);

  const StepAttemptSetup<Real> setup_;
  std::vector<Rank> ranks_;
  std::vector<std::unique_ptr<Member>> members_;  // null until first used
  const SharedJacobian<Real>& jacobian_;
  std::size_t start_, at_, past_at_;         // the member of past_
  const StagePolynomial<Real>* past_;        // of the last solved step
  int failures_ = 0;                         // of Newton, in a row
  bool solved_ = false;                      // a step
  std::shared_ptr<const Pattern> reserved_;  // that every member has seen
  int epoch_ = 0;                            // members that are not in use forget when they come to it
  bool again_ = true;                        // filter twice: after a start and a rejection
  std::int64_t steps_ = 0;                   // accepted
  double estimate_ = 0, sum_ = 0;            // of the last attempt; of all accepted steps
  bool watches_start_ = false;               // the first step after a restart
  bool restarted_ = false;                   // since the last step was taken over
  bool continues_ = false;                   // (a, k) at the start of a step are those of the same mode
  bool vague_start_ = false;                 // of the mode: a restart, which may not determine (a, k)
  int since_change_ = 0;                     // accepted steps
  double lower_error_;                       // of the member below, NaN if not known
  double unknowns_;
};

/// The entry `embedded` of the estimates.
Strategy<ErrorEstimate> embeddedEstimate();

/// How the order is chosen.
template <>
struct Strategy<OrderControl> {
  OrderControl id;
  std::string meaning;
  Needs needs = {};
  bool several_methods = false;  ///< takes the members of a family
};
template <>
Catalogue<OrderControl>& catalogue<OrderControl>();

}  // namespace irk
