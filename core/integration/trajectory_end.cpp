// How an integration ends: its result, with counters and what is said of it.
#include <sstream>
#include <string>
#include <utility>

#include "core/derivatives/constraint_check.h"
#include "core/derivatives/first_order.h"
#include "core/integration/end_check.h"
#include "core/integration/trajectory.h"
#include "core/system/component_name.h"
#include "core/system/counting.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
Solution<Real> Trajectory<Real>::solution(Outcome outcome, std::string detail) const {
  Counters counters = counters_;
  counters.mass_factorizations += massFactorizations(uncounted(system_));
  State<Real> scene = system_.toScene(state_);
  // Their rows z_i = 0 are solved with all others, which leaves round-off (up to 5e-32).
  for (const Index i : constrainedIn(system_).leftOut()) scene.w.tail(scene.z().size())[i] = Real(0);
  return {outcome, std::move(detail), std::move(scene), counters};
}

template <class Real>
Solution<Real> Trajectory<Real>::success() {
  if (controller_) {
    norm_.update(state_);
    const EndCheck end = finish(system_, options_, norm_, state_, counters_);
    if (end.outcome != Outcome::kSuccess) return solution(end.outcome, end.detail);
  }
  if (options_.multipliers == Multipliers::kConsistent && system_.sizes().nz > 0) addNote(start_.applyAtEnd(state_));
  addNote(roundOffRemark(round_off_));
  if (controller_) addNote(amounts_.remark());
  return solution(Outcome::kSuccess, note_);
}

template <class Real>
Solution<Real> Trajectory<Real>::failed(Outcome outcome, double h, const std::string& what) const {
  if (!start_detail_.empty()) return solution(outcome, start_detail_);
  if (positions_ && positions_->explains(outcome, state_)) return solution(Outcome::kSingular, positions_->found());
  std::ostringstream text;
  text.precision(6);
  text << what << " at t = " << sceneTime(system_, state_.t) << ", h = " << h;
  if (blamed_ >= 0) text << ", " << switches_.describe(blamed_);
  const std::string below = controller_ ? amounts_.belowZero() : "";
  if (!below.empty()) text << "; " << below;
  return solution(outcome, text.str());
}

template <class Real>
std::string Trajectory<Real>::rejections() const {
  const Counters& c = counters_;
  std::string text = "(" + std::to_string(c.steps_accepted) + " accepted, rejected by the error " +
                     std::to_string(c.steps_rejected_error) + ", by Newton " + std::to_string(c.steps_rejected_newton);
  if (last_rejection_) text += std::string(", the last by ") + last_rejection_;
  if (c.located_events > 0) text += ", switches " + std::to_string(c.located_events);
  const Index worst = solved_ ? attempt_->worstComponent() : -1;
  if (worst >= 0) text += "; largest error in " + componentName(system_.sizes(), worst);
  return text + ")";
}

#define IRK_TRAJECTORY_END(Real)                                                               \
  template Solution<Real> Trajectory<Real>::solution(Outcome, std::string) const;              \
  template Solution<Real> Trajectory<Real>::success();                                         \
  template Solution<Real> Trajectory<Real>::failed(Outcome, double, const std::string&) const; \
  template std::string Trajectory<Real>::rejections() const;
IRK_TRAJECTORY_END(double)
IRK_TRAJECTORY_END(BigFloat)
#undef IRK_TRAJECTORY_END

}  // namespace irk
