// What an integration to a t_end before its start needs: the reversed system (core/system/reversed.h), and the caller's
// view of it.
#pragma once

#include <memory>

#include "core/system/reversed.h"
#include "irk/monitor.h"

namespace irk {

/// Whether t_end is finite and lies before t.
template <class Real>
bool liesBefore(const Real& t_end, const Real& t);

/// `system` over -t. Throws Misuse for one with switches or a discrete state.
template <class Real>
std::shared_ptr<const System<Real>> reversedSystem(std::shared_ptr<const System<Real>> system);

/// Throws Misuse if u, v or x jump at a declared time between `start`, in the scene's own time, and t_end.
template <class Real>
void requireNoJumps(const System<Real>& reversed_system, const State<Real>& start, const Real& t_end);

/// The callbacks of an integration of the reversed system: they call those of `callers` with times and states of the
/// scene. Step sizes are then negative. The result refers to `callers`.
template <class Real>
Monitor<Real> reversed(const Monitor<Real>& callers);

}  // namespace irk
