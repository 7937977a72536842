#include "core/ensemble/lane_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/base/constants.h"
#include "core/derivatives/consistent_start.h"
#include "core/estimates/embedded.h"
#include "core/integration/end_check.h"
#include "core/system/counting.h"
#include "irk/system_check.h"

namespace irk {
struct LaneRun::Tools {
  CountingSystem<double> system;
  ConsistentStart<double> consistent;
  ErrorNorm<double> norm;

  Tools(const EnsembleMember& member, const IntegratorOptions& options, Counters& counters)
      : system(*member.system, counters),
        consistent(system, options.derivatives, false, &counters, member.scale),
        norm(*member.system, options.tolerances, member.scale) {}
};

LaneRun::LaneRun(int order, const IntegratorOptions& options)
    : order_(order), options_(options), controller_(makeController(options.step, order)) {}

LaneRun::~LaneRun() = default;

Outcome LaneRun::begin(std::size_t index, EnsembleMember member) {
  index_ = index;
  tools_.reset();  // they refer to the system of the member before
  member_ = std::move(member);
  counters_ = {};
  detail_.clear();
  requireStart(*member_.system, member_.start, member_.t_end);
  start_ = member_.system->fromScene(member_.start);
  requireState("System::fromScene", start_, member_.system->sizes());
  const std::string not_finite = notFinite(member_.start);
  if (!not_finite.empty()) {
    detail_ = "at the start: " + not_finite;
    return Outcome::kNotFinite;
  }
  tools_ = std::make_unique<Tools>(member_, options_, counters_);
  const StartReport report = tools_->consistent.apply(start_);
  detail_ = report.detail;
  if (report.outcome != Outcome::kSuccess) return report.outcome;
  length_ = member_.t_end - start_.t;
  controller_ = makeController(options_.step, order_);
  stall_.begin(start_.t);
  last_steps_.begin();
  attempts_ = steps_ = 0;
  round_off_ = 0;
  look_ = 0;
  again_ = true;
  too_small_ = Outcome::kStepTooSmall;
  h_ = std::min(firstStep(), options_.step.h_max);
  return Outcome::kSuccess;
}

// HW I (II.4), first guess: the solution moves by a hundredth of its size (Integrator).
double LaneRun::firstStep() const {
  if (options_.step.h > 0) return std::min(options_.step.h, length_);
  const double y = start_.u.norm() + start_.v.norm() + start_.x.norm();
  const double dy = start_.v.norm() + start_.a().norm() + start_.k().norm();
  const double h = y > 1e-5 && dy > 1e-5 ? kFirstChange * y / dy : 1e-4 * length_;
  return std::min(h, kShrinkAtMost * length_);
}

// Below this size t + c_i h does not resolve the stages (16 eps t).
double LaneRun::smallest(double t) const {
  const double resolved = kSmallestStep * std::numeric_limits<double>::epsilon() * std::abs(t);
  return std::max({options_.step.h_min, resolved, std::numeric_limits<double>::min()});
}

Outcome LaneRun::plan(double t) {
  const std::int64_t left = options_.step.max_steps - attempts_;
  if (left == 0) return Outcome::kMaxSteps;
  if (h_ < smallest(t)) return too_small_;
  if (attempts_ > 0 && stall_.attempted(t, member_.t_end, left)) return Outcome::kStalled;
  ++attempts_;
  size_ = last_steps_.size(h_, member_.t_end - t, member_.t_end);
  return Outcome::kSuccess;
}

void LaneRun::failed(Outcome outcome) {
  ++counters_.steps_rejected_newton;
  too_small_ = outcome == Outcome::kNewtonFailed ? Outcome::kStepTooSmall : outcome;
  again_ = true;
  h_ = controller_->afterFailure(size_);
}

bool LaneRun::decide(double estimate, double error, double round_off) {
  again_ = !(estimate <= 1);
  const StepDecision decision = controller_->decide(error, size_);
  // A step that was cut short does not reduce the size of the next one.
  h_ = std::min(last_steps_.cut() && decision.accept ? std::max(h_, decision.h) : decision.h, options_.step.h_max);
  if (!decision.accept) {
    ++counters_.steps_rejected_error;
    too_small_ = Outcome::kStepTooSmall;
    return false;
  }
  ++counters_.steps_accepted;
  ++steps_;
  round_off_ = std::max(round_off_, round_off);
  return true;
}

double LaneRun::newTime(double t_by_lanes) {
  if (last_steps_.reachesEnd()) return member_.t_end;
  const double resolved =
      std::max(16 * std::numeric_limits<double>::epsilon() * std::abs(t_by_lanes), std::numeric_limits<double>::min());
  return t_by_lanes < member_.t_end && member_.t_end - t_by_lanes < resolved ? member_.t_end : t_by_lanes;
}

Solution<double> LaneRun::success(State<double> state) {
  const System<double>& system = *member_.system;
  tools_->norm.update(state);
  const EndCheck end = finish<double>(tools_->system, options_, tools_->norm, state, counters_);
  if (end.outcome != Outcome::kSuccess) return {end.outcome, end.detail, system.toScene(state), counters_};
  std::string note;
  if (options_.multipliers == Multipliers::kConsistent && system.sizes().nz > 0) {
    note = tools_->consistent.applyAtEnd(state);
  }
  const std::string remark = roundOffRemark(round_off_);
  note += (note.empty() || remark.empty() ? "" : "; ") + remark;
  return {Outcome::kSuccess, note, system.toScene(state), counters_};
}

Solution<double> LaneRun::failure(Outcome outcome, const State<double>& state) const {
  std::ostringstream text;
  text.precision(6);
  if (detail_.empty()) {
    text << "at t = " << state.t << ", h = " << h_ << " (" << counters_.steps_accepted
         << " accepted, rejected by the error " << counters_.steps_rejected_error << ", by Newton "
         << counters_.steps_rejected_newton << ")";
  }
  return {outcome, detail_ + text.str(), member_.system->toScene(state), counters_};
}

}  // namespace irk
