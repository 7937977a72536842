#include "core/system/switches.h"

#include <cmath>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
SwitchingFunctions<Real>::SwitchingFunctions(const System<Real>& system)
    : system_(system),
      g_(Vec<Real>::Constant(system.sizes().switches, Real(-1))),
      moved_g_(g_.size()),
      moved_(none() ? Sizes{} : system.sizes()) {}

template <class Real>
SwitchReport SwitchingFunctions<Real>::evaluate(const Point<Real>& p) {
  using std::isfinite;  // for double; other scalars are found by their namespace
  if (none()) return {};
  system_.switching(p, VecView<Real>(g_.data(), g_.size()));
  for (Index i = 0; i < g_.size(); ++i) {
    if (!isfinite(g_[i])) return {Outcome::kNotFinite, 0, i};
  }
  return {};
}

template <class Real>
Index SwitchingFunctions<Real>::due() const {
  for (Index i = 0; i < g_.size(); ++i) {
    if (g_[i] > Real(0)) return i;
  }
  return -1;
}

template <class Real>
Real SwitchingFunctions<Real>::roundOff(const State<Real>& state, Index i) {
  using std::abs;
  using std::isfinite;
  Real largest(0);
  for (const bool alternating : {false, true}) {
    moved_ = state;
    int sign = 1;
    for (auto* part : {&moved_.u, &moved_.v, &moved_.x, &moved_.w}) {
      for (Real& y : *part) {
        y += Real(sign * kLastDigits.value) * Eigen::NumTraits<Real>::epsilon() * abs(y);
        if (alternating) sign = -sign;
      }
    }
    system_.switching(pointOf(moved_), VecView<Real>(moved_g_.data(), moved_g_.size()));
    const Real change = abs(Real(moved_g_[i] - g_[i]));
    if (isfinite(change) && change > largest) largest = change;
  }
  return largest;
}

template <class Real>
Index Switches<Real>::dueAt(const State<Real>& state) {
  const Vec<Real>& g = this->g();
  for (Index i = 0; i < g.size(); ++i) {
    if (!(g[i] > Real(0))) continue;
    const bool again = executed_at_ == state.t && executed_[static_cast<std::size_t>(i)];
    if (!again || g[i] > this->roundOff(state, i)) return i;
  }
  return -1;
}

template <class Real>
SwitchReport Switches<Real>::settle(State<Real>& state, Jumps jumps, const std::function<void(Index)>& done) {
  SwitchReport report;
  while (true) {
    const SwitchReport at = this->evaluate(state);
    if (at.outcome != Outcome::kSuccess) return at;
    const Index i = dueAt(state);
    if (i < 0) return report;
    report.index = i;
    if (report.count == kSwitchRounds.whole() * this->g().size()) {
      report.outcome = Outcome::kChattering;
      return report;
    }
    if (executed_at_ != state.t) executed_.assign(executed_.size(), false);
    executed_at_ = state.t;
    executed_[static_cast<std::size_t>(i)] = true;
    this->system_.onSwitch(i, state);
    if (jumps == Jumps::kDone) this->system_.jump(i, state);
    ++report.count;
    if (done) done(i);
  }
}

template <class Real>
std::string SwitchingFunctions<Real>::describe(Index i) const {
  return i < 0 ? std::string() : "switching function '" + system_.switchName(i) + "'";
}

IRK_INSTANTIATE_CLASS(SwitchingFunctions)
IRK_INSTANTIATE_CLASS(Switches)

}  // namespace irk
