#include "core/system/switches.h"

#include <cmath>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {
template <class Real>
Switches<Real>::Switches(const System<Real>& system)
    : system_(system), g_(Vec<Real>::Constant(system.sizes().switches, Real(-1))) {}

template <class Real>
SwitchReport Switches<Real>::evaluate(const Point<Real>& p) {
  using std::isfinite;  // for double; other scalars are found by their namespace
  if (none()) return {};
  system_.switching(p, VecView<Real>(g_.data(), g_.size()));
  for (Index i = 0; i < g_.size(); ++i) {
    if (!isfinite(g_[i])) return {Outcome::kNotFinite, 0, i};
  }
  return {};
}

template <class Real>
Index Switches<Real>::due() const {
  for (Index i = 0; i < g_.size(); ++i) {
    if (g_[i] > Real(0)) return i;
  }
  return -1;
}

template <class Real>
SwitchReport Switches<Real>::settle(State<Real>& state, Jumps jumps, const std::function<void(Index)>& done) {
  SwitchReport report;
  while (true) {
    const SwitchReport at = evaluate(state);
    if (at.outcome != Outcome::kSuccess) return at;
    const Index i = due();
    if (i < 0) return report;
    report.index = i;
    if (report.count == kSwitchRounds.whole() * g_.size()) {
      report.outcome = Outcome::kChattering;
      return report;
    }
    system_.onSwitch(i, state);
    if (jumps == Jumps::kDone) system_.jump(i, state);
    ++report.count;
    if (done) done(i);
  }
}

template <class Real>
std::string Switches<Real>::describe(Index i) const {
  return i < 0 ? std::string() : "switching function '" + system_.switchName(i) + "'";
}

IRK_INSTANTIATE_CLASS(Switches)

}  // namespace irk
