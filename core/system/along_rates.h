// A state a little later, or earlier, to first order.
#pragma once

#include "irk/system.h"

namespace irk {

/// t, u, v and x of `state` after dt along the rates (v, a, k) of another state of the same sizes; w and d stay.
template <class Real>
State<Real> alongRates(State<Real> state, const State<Real>& rates, const Real& dt) {
  state.t += dt;
  state.u += dt * rates.v;
  state.v += dt * rates.a();
  state.x += dt * rates.k();
  return state;
}

}  // namespace irk
