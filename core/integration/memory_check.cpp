#include "core/integration/memory_check.h"

#include <array>
#include <cmath>
#include <sstream>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

namespace irk {
namespace {

// A state at time t whose u, v, x differ from those of the start by up to 1 + their magnitude times `by`.
template <class Real>
State<Real> moved(const State<Real>& start, const Real& t, double by) {
  using std::abs;
  State<Real> state = start;
  state.t = t;
  for (auto* part : {&state.u, &state.v, &state.x}) {
    for (Real& value : *part) value += Real(by) * (Real(1) + Real(abs(value)));
  }
  return state;
}

template <class Real>
void requireSame(const Vec<Real>& first, const Vec<Real>& again, const Vec<Real>& magnitude, double t) {
  using std::abs;
  for (Index i = 0; i < first.size(); ++i) {
    const double difference = static_cast<double>(Real(abs(Real(again[i] - first[i]))));
    const bool finite = std::isfinite(difference);
    if (!finite || difference <= kEightDigits * static_cast<double>(magnitude[i])) continue;
    std::ostringstream text;
    text << "row " << i << " of the residual (from 0 on) at t = " << t << " is " << static_cast<double>(first[i])
         << ", and after evaluations elsewhere " << static_cast<double>(again[i])
         << " at the same point: a residual depends on its arguments only and keeps no history";
    throw Misuse(text.str());
  }
}

}  // namespace

// The times differ by half the interval, so that a memory of the last part of it, as of a delay, shows.
template <class Real>
void requireNoMemory(const System<Real>& system, const State<Real>& start, const Real& t_end) {
  using std::abs;
  // The first-order form keeps factors, and its last digits depend on the point before.
  const System<Real>& users = constrainedIn(system);
  const Real middle = start.t + (t_end - start.t) / Real(2);
  const State<Real> here = users.fromScene(start);
  requireState("System::fromScene", here, users.sizes());
  const std::array<State<Real>, 3> points{here, moved(here, t_end, 0.01), moved(here, middle, 0.02)};
  std::array<Vec<Real>, 3> first;
  Vec<Real> again(users.sizes().n()), magnitude = Vec<Real>::Zero(again.size());
  const auto evaluate = [&](const State<Real>& at, Vec<Real>& r) {
    users.evaluate(Level::kFormulated, pointOf(at), VecView<Real>(r.data(), r.size()));
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    first[k].resize(again.size());
    evaluate(points[k], first[k]);
    for (Index i = 0; i < again.size(); ++i) {
      if (std::isfinite(static_cast<double>(first[k][i])) && abs(first[k][i]) > magnitude[i]) {
        magnitude[i] = abs(first[k][i]);
      }
    }
  }
  for (const std::size_t k : {std::size_t{1}, std::size_t{0}}) {
    evaluate(points[k], again);
    requireSame(first[k], again, magnitude, sceneTime(users, points[k].t));
  }
}

template void requireNoMemory(const System<double>&, const State<double>&, const double&);
template void requireNoMemory(const System<BigFloat>&, const State<BigFloat>&, const BigFloat&);

}  // namespace irk
