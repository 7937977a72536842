#include "core/integration/memory_check.h"

#include <cmath>
#include <sstream>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

namespace irk {
namespace {

// Sets `state` to one at time t whose u, v, x differ from those of the start by up to 1 + their magnitude times `by`.
template <class Real>
void move(const State<Real>& start, const Real& t, double by, State<Real>& state) {
  using std::abs;
  state.t = t;
  const auto moveFrom = [by](const Vec<Real>& from, Vec<Real>& to) {
    for (Index i = 0; i < to.size(); ++i) to[i] = from[i] + Real(by) * (Real(1) + Real(abs(from[i])));
  };
  moveFrom(start.u, state.u);
  moveFrom(start.v, state.v);
  moveFrom(start.x, state.x);
}

template <class Real>
void requireSame(const auto& first, const auto& again, const auto& magnitude, const auto& time) {
  using std::abs;
  for (Index i = 0; i < first.size(); ++i) {
    const double difference = static_cast<double>(Real(abs(Real(again[i] - first[i]))));
    const bool finite = std::isfinite(difference);
    if (!finite || difference <= kEightDigits * static_cast<double>(magnitude[i])) continue;
    std::ostringstream text;
    text << "row " << i << " of the residual (from 0 on) at t = " << time() << " is " << static_cast<double>(first[i])
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
  State<Real> elsewhere = here;
  enum Column { kHere, kMoved, kFarther, kAgain, kMagnitude, kColumns };
  Mat<Real> r(users.sizes().n(), kColumns);
  r.col(kMagnitude).setZero();
  const auto evaluate = [&](const State<Real>& at, Column to) {
    users.evaluate(Level::kFormulated, pointOf(at), VecView<Real>(r.col(to).data(), r.rows()));
    for (Index i = 0; i < r.rows(); ++i) {
      const Real size = abs(r(i, to));
      if (std::isfinite(static_cast<double>(size)) && size > r(i, kMagnitude)) r(i, kMagnitude) = size;
    }
  };
  const auto evaluateMoved = [&](Column to) {
    move(here, t_end, 0.01, elsewhere);
    evaluate(elsewhere, to);
  };
  const auto requireAsBefore = [&](Column first, const Real& t) {
    requireSame<Real>(r.col(first), r.col(kAgain), r.col(kMagnitude), [&] { return sceneTime(users, t); });
  };
  evaluate(here, kHere);
  evaluateMoved(kMoved);
  move(here, middle, 0.02, elsewhere);
  evaluate(elsewhere, kFarther);
  evaluateMoved(kAgain);
  requireAsBefore(kMoved, t_end);
  evaluate(here, kAgain);
  requireAsBefore(kHere, here.t);
}

template void requireNoMemory(const System<double>&, const State<double>&, const double&);
template void requireNoMemory(const System<BigFloat>&, const State<BigFloat>&, const BigFloat&);

}  // namespace irk
