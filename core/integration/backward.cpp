#include "core/integration/backward.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/derivatives/constraint_check.h"
#include "core/derivatives/first_order.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

namespace irk {
namespace {

template <class Real>
class InsideBackward final : public InsideStep<Real> {
 public:
  explicit InsideBackward(InsideStep<Real>& forward) : forward_(forward) {}
  State<Real> at(const Real& t) override { return reversed(forward_.at(opposite(t))); }

 private:
  InsideStep<Real>& forward_;
};

}  // namespace

template <class Real>
bool liesBefore(const Real& t_end, const Real& t) {
  using std::isfinite;
  return isfinite(t_end) && t_end < t;
}

template <class Real>
std::shared_ptr<const System<Real>> reversedSystem(std::shared_ptr<const System<Real>> system) {
  requireTimes(system->times());
  const auto* first_order = dynamic_cast<const FirstOrderForm<Real>*>(system.get());
  if (first_order) return first_order->backward();
  return std::make_shared<const ReversedSystem<Real>>(std::move(system));
}

// A jump may leave the state as it is where it has just happened, as v = 0 does: it is tried at a state nearby.
template <class Real>
void requireNoJumps(const System<Real>& reversed_system, const State<Real>& start, const Real& t_end) {
  if (!notFinite(start).empty()) return;
  const System<Real>& system = constrainedIn(reversed_system);
  const std::vector<Real> times = system.times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] <= opposite(start.t) || times[i] >= opposite(t_end)) continue;
    State<Real> state = system.fromScene(reversed(start));
    state.t = times[i];
    for (auto* part : {&state.u, &state.v, &state.x}) part->array() += Real(1);
    system.jumpAtTime(static_cast<Index>(i), state);
  }
}

template <class Real>
Monitor<Real> reversed(const Monitor<Real>& callers) {
  Monitor<Real> monitor;
  monitor.inside = callers.inside;
  monitor.interrupt = callers.interrupt;
  if (!callers.accepted) return monitor;
  monitor.accepted = [&callers](const StepRecord<Real>& step) {
    const State<Real> state = reversed(step.state);
    std::optional<InsideBackward<Real>> inside;
    if (step.inside) inside.emplace(*step.inside);
    callers.accepted({opposite(step.t), -step.h, step.error, step.newton_iterations, state, inside ? &*inside : nullptr,
                      step.errors});
  };
  return monitor;
}

#define IRK_BACKWARD(Real)                                                                          \
  template bool liesBefore(const Real&, const Real&);                                               \
  template std::shared_ptr<const System<Real>> reversedSystem(std::shared_ptr<const System<Real>>); \
  template void requireNoJumps(const System<Real>&, const State<Real>&, const Real&);               \
  template Monitor<Real> reversed(const Monitor<Real>&);
IRK_BACKWARD(double)
IRK_BACKWARD(BigFloat)
#undef IRK_BACKWARD

}  // namespace irk
