// Watches an integration for motions below the tolerance, which its error control does not see.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/integration/growth.h"
#include "irk/monitor.h"
#include "irk/options.h"

namespace irk {

// Watches an integration for motions that rest though errors grow in them: they are nearer to their rest than the
// tolerance. Such a deviation grows in truth, but a step longer than its time constant damps it: stiffly accurate
// methods damp all fast motions, growing ones as well. A rest may become unstable after the motion has come to it: what
// grows then is what the decay has left, so that the decay has to be followed, too, as far as numbers have digits.
template <class Real>
class UnstableRest {
 public:
  UnstableRest(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale, const Real& t_start,
               const Real& t_end)
      : growth_(system, DerivativeSource::kAutomatic),
        same_unknowns_(system.sizes() == system.sceneSizes()),
        tolerances_(tolerances),
        scale_(scale),
        length_(static_cast<double>(Real(t_end - t_start))),
        t_end_(t_end) {}

  // An integration begins.
  void begin() {
    found_ = rests_ = decays_ = vanished_ = false;
    look_in_ = 0;
    resolved_ = grown_ = since_look_ = rests_for_ = 0;
    fastest_ = std::numeric_limits<double>::infinity();
  }
  void look(const StepRecord<Real>& step) {
    if (!same_unknowns_ || step.h < 0 || step.state.u.size() + step.state.x.size() == 0) return;
    setTolerances(step.state);
    const double before = std::exchange(fastest_, fastestIn(step.state));
    const bool rests = step.h * std::max(before, fastest_) < 1;
    const bool comes_to_rest = !std::exchange(rests_, rests) && rests;
    const double left = static_cast<double>(Real(t_end_ - step.t));
    since_look_ += step.h;
    rests_for_ = rests ? rests_for_ + step.h : 0;
    if (!rests && grown_ == 0) vanished_ = false;  // something else moves it
    // Once in N steps, the eigenvalues of N components take about a tenth of the time of a bar; those of a few take as
    // long as a step and are computed in every tenth one (judged by 2700 runs of systems with unstable rests: no
    // outcome differs). A motion that rests takes few, long steps, in which it may become unstable: there it is once in
    // N, and no more than a twentieth of the interval is passed over. A start may lie near a rest, and steps may leave
    // a rest as soon as they no longer resolve its growth.
    const double unseen = std::min(since_look_, rests_for_);
    const int parts = rests ? partsOf(unseen) : 1;
    if (--look_in_ > 0 && !(resolved_ * step.h > 1) && !comes_to_rest && parts == 1) return;
    look_in_ = rests ? tolerance_.size() : std::max<Index>(tolerance_.size(), 10);
    for (int part = parts; part-- > 1 && !found_;) {  // the state at rest is that of the end
      const double back = unseen * part / parts;
      within_ = step.state;
      within_.t -= back;
      judge(within_, step.h, true, left + back, since_look_ / parts);
    }
    judge(step.state, step.h, rests, left, since_look_ / parts);
    since_look_ = 0;
  }
  // Whether this integration has found one that was not followed. From the next integration on it is.
  bool found() const { return found_; }
  bool follows() const { return follows_; }
  // The length of the next step with which a deviation from a rest can be followed.
  double limit() const { return limit_; }
  double t() const { return t_; }
  // Whether the deviation has fallen below round-off in a decay, and has left the rest afterwards or could have done
  // so.
  bool vanished() const {
    if (!vanished_ || grown_ == 0) return false;
    return !rests_ || grown_ > std::log((tolerance_.array() / round_off_.array()).minCoeff());
  }
  // From the next integration on decays are not followed; false if they were not.
  bool leaveDecays() { return std::exchange(through_decays_, false); }

 private:
  // The parts of the interval in which a motion that rests is looked at.
  static constexpr int kParts = 20;

  // Motions around 1 that had decayed moved by up to 70 eps.
  static double roundOff() { return 100 * static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon())); }
  int partsOf(double time) const { return static_cast<int>(std::ceil(std::min(1.0, time / length_) * kParts)); }
  // Looks at a state in, or at the end of, a step of size h; `passed`: the time since the last look.
  void judge(const State<Real>& state, double h, bool rests, double left, double passed) {
    double growth = growth_.rate(state, left), living = 0;
    const bool too_fast = growth * h > 1;
    resolved_ = too_fast ? 0 : growth;
    const bool stays = std::max(h, length_ / kParts) * fastest_ < 1;  // short steps seem to rest
    if (stays && growth == 0 && fastest_ > 0) decays_ = true;
    if (through_decays_ || ((too_fast || (follows_ && growth > 0)) && !rests)) {
      const auto motions = growth_.motions(state, left, tolerance_, round_off_, rests_for_);
      if (!rests) growth = motions ? motions->resting : 0;
      if (rests && motions) living = followDecay(*motions, passed);
    }
    if (growth > 0 && too_fast && !follows_) {
      found_ = follows_ = true;
      through_decays_ = decays_;
      t_ = static_cast<double>(state.t);
    }
    // Through a decay steps of low order have to be exact, too: one of order 2 with h |lambda| = 1/8 errs by 3e-4.
    const double least = through_decays_ && rests ? kParts / length_ : 0;
    const double fastest = std::max({(through_decays_ ? 8 : 2) * growth, 8 * living, least});
    if (follows_) limit_ = fastest > 0 ? 1 / fastest : std::numeric_limits<double>::infinity();
  }
  // Keeps account of what is left of a motion that rests; returns the largest |lambda| that has to be followed.
  double followDecay(const typename Growth<Real>::Motions& motions, double passed) {
    if (motions.resting == 0 && motions.living == 0) {
      vanished_ = true;
      grown_ = 0;
    }
    if (motions.vanished && grown_ == 0) vanished_ = true;
    grown_ += motions.faster * passed;
    return motions.living;
  }
  // Of u, v and x.
  void setTolerances(const State<Real>& s) {
    const Index nu = s.u.size(), nx = s.x.size();
    tolerance_.resize(2 * nu + nx);
    tolerance_ << s.u.template cast<double>(), s.v.template cast<double>(), s.x.template cast<double>();
    round_off_ = roundOff() * tolerance_.cwiseAbs();
    for (Index i = 0; i < tolerance_.size(); ++i) {
      tolerance_[i] = tolerances_.of(i < scale_.size() ? scale_[i] : 1, tolerance_[i]);
    }
  }
  // The largest component of (u, v, x)' in tolerances.
  double fastestIn(const State<Real>& s) {
    rates_.resize(tolerance_.size());
    rates_ << s.v.template cast<double>(), s.w.head(s.v.size() + s.x.size()).template cast<double>();
    return rates_.cwiseAbs().cwiseQuotient(tolerance_).maxCoeff();
  }

  Growth<Real> growth_;
  bool same_unknowns_;
  Tolerances tolerances_;
  Vec<double> scale_;
  double length_;
  Real t_end_;
  bool found_ = false, follows_ = false;
  bool through_decays_ = false;  // follows decays as well
  bool rests_ = false;           // nothing moved by a tolerance in the last step
  bool decays_ = false;          // this integration has come to a rest in which nothing grew
  bool vanished_ = false;        // nothing was left of the motion when it began to grow
  double grown_ = 0;             // the exponent by which it has grown since
  Index look_in_ = 0;            // steps until eigenvalues are computed again
  double since_look_ = 0;        // time
  double rests_for_ = 0;         // time
  double resolved_ = 0;          // the growth then, if the steps resolved it; else 0
  double fastest_ = 0;           // fastestIn at the end of the last step
  double limit_ = std::numeric_limits<double>::infinity(), t_ = 0;
  Vec<double> tolerance_, round_off_, rates_;
  State<Real> within_;
};

}  // namespace irk
