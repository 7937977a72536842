#include "core/integration/stop_rule.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/number_text.h"
#include "core/base/text.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

constexpr std::int64_t kMostSwitches = 1'000'000'000;

// Removes `:k` from `name` and returns k; returns 1 if there is none.
std::int64_t takeCount(std::string& name) {
  const auto colon = name.rfind(':');
  if (colon == name.npos) return 1;
  const std::int64_t count = parseInteger("stop_at " + name, name.substr(colon + 1), Range::integers(1, kMostSwitches));
  name.resize(colon);
  return count;
}

// Whether |y_i'| <= steady max(|y_i|, scale_i) for all i.
bool hardlyChanges(const auto& rates, const auto& y, double steady, const Vec<double>& scale, Index place) {
  for (Index i = 0; i < y.size(); ++i) {
    const double magnitude = place + i < scale.size() ? scale[place + i] : 1;
    const double most = steady * std::max(std::abs(static_cast<double>(y[i])), magnitude);
    if (!(std::abs(static_cast<double>(rates[i])) <= most)) return false;
  }
  return true;
}

}  // namespace

template <class Real>
StopRule<Real>::StopRule(const System<Real>& system, const IntegratorOptions& options, const Vec<double>& scale)
    : stop_at_(options.stop_at), steady_(options.steady), scale_(scale) {
  if (stop_at_.empty()) return;
  const Discontinuity treatment = system.discontinuity();
  if (treatment.at_switch != AtSwitch::kEnd) {
    throw Misuse("illegal combination: stop_at '" + stop_at_ + "' with discontinuity '" + std::string(treatment.id) +
                 "': no step ends at a switch; use 'locate'");
  }
  std::string name = stop_at_;
  std::vector<std::string> known;
  for (Index i = 0; i < system.sizes().switches; ++i) known.push_back(system.switchName(i));
  if (known.empty()) throw Misuse("stop_at '" + stop_at_ + "': the scene has no switches");
  const auto isKnown = [&] { return std::find(known.begin(), known.end(), name) != known.end(); };
  count_ = isKnown() ? 1 : takeCount(name);
  for (const auto& one : known) waits_for_.push_back(one == name);
  if (!isKnown()) {
    throw Misuse("stop_at: " + unknownName("switch", name, known));
  }
}

template <class Real>
void StopRule<Real>::switched(Index i) {
  // -1: the step itself asked for the change (System::completeStep), no switching function became due.
  if (i >= 0 && waits_for_[static_cast<std::size_t>(i)]) ++come_;
}

template <class Real>
void StopRule<Real>::stepped(const State<Real>& state) {
  if (steady_ == 0) return;
  const Index nu = state.u.size();
  is_steady_ = hardlyChanges(state.v, state.u, steady_, scale_, 0) &&
               hardlyChanges(state.a(), state.v, steady_, scale_, nu) &&
               hardlyChanges(state.k(), state.x, steady_, scale_, 2 * nu);
}

template <class Real>
std::string StopRule<Real>::told() const {
  if (is_steady_) return "steady to " + numberText(steady_);
  return reached() ? "at the switch " + stop_at_ : "";
}

template <class Real>
std::string StopRule<Real>::missed() const {
  if (reached() || (!waitsForSwitch() && steady_ == 0)) return {};
  std::ostringstream text;
  text << "the end came before ";
  if (waitsForSwitch()) text << "the switch " << stop_at_ << ", which came " << come_ << " of " << count_ << " times";
  if (waitsForSwitch() && steady_ > 0) text << ", and before ";
  if (steady_ > 0) text << "the state was steady to " << steady_;
  return text.str();
}

IRK_INSTANTIATE_CLASS(StopRule)

}  // namespace irk
