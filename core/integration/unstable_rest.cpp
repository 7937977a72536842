#include "core/integration/unstable_rest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "irk/multiprecision.h"

namespace irk {

void LookTimes::begin() {
  rests_ = comes_to_rest_ = false;
  rests_for_ = since_look_ = resolved_ = 0;
  steps_left_ = 0;
  speed_ = std::numeric_limits<double>::infinity();
}

void LookTimes::step(double h, double speed) {
  const double before = std::exchange(speed_, speed);
  const bool rests = h * std::max(before, speed) < 1;
  comes_to_rest_ = !std::exchange(rests_, rests) && rests;
  rests_for_ = rests ? rests_for_ + h : 0;
  since_look_ += h;
}

bool LookTimes::moves(double h) const { return !(std::max(h, part()) * speed_ < 1); }

bool LookTimes::staysAtRest(double h) const { return speed_ > 0 && !moves(h); }

// Once in N steps, the eigenvalues of N components take about a tenth of the time of a bar; those of a few take as long
// as a step and are computed in every tenth one (judged by 2700 runs of systems with unstable rests: no outcome
// differs). A motion that rests takes few, long steps, in which it may become unstable: there it is once in N, and no
// part of the interval is passed over. A start may lie near a rest, and steps may leave a rest as soon as they no
// longer resolve its growth.
bool LookTimes::due(double h, Index components) {
  if (--steps_left_ > 0 && !comes_to_rest_ && parts() == 1 && !(resolved_ * h > 1)) return false;
  steps_left_ = rests_ ? components : std::max<Index>(components, 10);
  return true;
}

int LookTimes::parts() const {
  return rests_ ? static_cast<int>(std::ceil(std::min(1.0, unseen() / length_) * kParts)) : 1;
}

double LookTimes::unseen() const { return std::min(since_look_, rests_for_); }

template <class Real>
UnstableRest<Real>::UnstableRest(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale,
                                 const Real& t_start, const Real& t_end)
    : growth_(system, tolerances, scale),
      times_(static_cast<double>(Real(t_end - t_start))),
      watches_(system.sizes() == system.sceneSizes() &&
               2 * system.sizes().nu + system.sizes().nx <= Growth<Real>::kMost),
      t_end_(t_end) {}

template <class Real>
void UnstableRest<Real>::begin() {
  times_.begin();
  found_ = was_stable_ = vanished_ = left_ = false;
  grown_ = 0;
}

template <class Real>
void UnstableRest<Real>::look(const StepRecord<Real>& step) {
  if (!watches_ || step.h < 0 || step.state.u.size() + step.state.x.size() == 0) return;
  times_.step(step.h, growth_.speed(step.state));
  if (!times_.rests() && grown_ == 0) vanished_ = false;  // something else moves it
  if (vanished_ && grown_ > 0 && times_.moves(step.h)) left_ = true;
  if (!times_.due(step.h, growth_.components())) return;
  const double left = static_cast<double>(Real(t_end_ - step.t));
  const int parts = times_.parts();
  const double passed = times_.sinceLook() / parts;
  for (int part = parts; part-- > 1 && !found_;) {  // the state at rest is that of the end
    const double back = times_.unseen() * part / parts;
    within_ = step.state;
    within_.t -= back;
    judge(within_, step.h, left + back, passed);
  }
  judge(step.state, step.h, left, passed);
  times_.lookedAtAll();
}

// Looks at a state in, or at the end of, a step of size h; `left`: until the end, `passed`: since the last look.
template <class Real>
void UnstableRest<Real>::judge(const State<Real>& state, double h, double left, double passed) {
  double growth = growth_.rate(state, left), living = 0;
  const bool too_fast = growth * h > 1;
  times_.looked(growth, h);
  if (growth == 0 && times_.staysAtRest(h)) was_stable_ = true;
  if (times_.rests()) {
    if (follows_ == Follows::kGrowthAndDecays) {
      if (const auto motions = growth_.motions(state, left, times_.restsFor())) {
        keepAccount(*motions, passed);
        living = motions->living;
      }
    }
  } else if (growth > 0 && (too_fast || follows())) {  // only what rests beside the motion
    const auto motions = growth_.motions(state, left, 0);
    growth = motions ? motions->resting : 0;
  }
  const bool follows_too_little = follows_ == Follows::kGrowth && was_stable_ && !leaves_decays_;
  if (growth > 0 && (follows() ? follows_too_little : too_fast)) {
    found_ = true;
    follows_ = was_stable_ ? Follows::kGrowthAndDecays : Follows::kGrowth;
    t_ = static_cast<double>(state.t);
  }
  if (follows()) limitSteps(growth, living);
}

// Of what is left of a motion that rests.
template <class Real>
void UnstableRest<Real>::keepAccount(const typename Growth<Real>::Motions& motions, double passed) {
  if (motions.resting == 0 && motions.living == 0) {
    vanished_ = true;
    grown_ = 0;
  }
  if (motions.vanished && grown_ == 0) vanished_ = true;
  grown_ += motions.faster * passed;
}

// Growth alone takes steps of 1/2 of its time constant. Through a decay steps of low order have to be exact, too: one
// of order 2 with h |lambda| = 1/8 errs by 3e-4.
template <class Real>
void UnstableRest<Real>::limitSteps(double growth, double living) {
  double fastest = 2 * growth;
  if (follows_ == Follows::kGrowthAndDecays) {
    fastest = 8 * std::max(growth, living);
    if (times_.rests()) fastest = std::max(fastest, 1 / times_.part());
  }
  limit_ = fastest > 0 ? 1 / fastest : std::numeric_limits<double>::infinity();
}

template <class Real>
bool UnstableRest<Real>::leaveDecays() {
  if (follows_ != Follows::kGrowthAndDecays) return false;
  follows_ = Follows::kGrowth;
  leaves_decays_ = true;
  return true;
}

IRK_INSTANTIATE_CLASS(UnstableRest)

}  // namespace irk
