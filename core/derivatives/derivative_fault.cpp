#include "core/derivatives/derivative_fault.h"

#include <cmath>
#include <sstream>

#include "core/derivatives/point_buffers.h"
#include "core/system/component_name.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Components are moved by this part of 1 + their magnitude. Any place beside a single point where a derivative does not
// exist will do.
constexpr double kBeside = 1e-3;

/// Derivatives of all rows along (a, k, z) = (1, ..., 1) near a state: not finite where any of a row's is not, since
/// NaN and infinity do not cancel.
template <class Real>
class NearState {
 public:
  NearState(const System<Real>& system, const State<Real>& state)
      : system_(system), state_(state), buffers_(system.sizes()) {}

  /// The components of (u, v, x), in this order.
  Index components() const { return 2 * state_.u.size() + state_.x.size(); }
  const Real& value(Index i) const { return componentOf(state_, i); }

  /// The first row with a derivative that is not finite; -1 if there is none.
  Index faultyRow() {
    evaluate(0, 0);
    for (Index i = 0; i < buffers_.r.size(); ++i) {
      if (!isFinite(i)) return i;
    }
    return -1;
  }
  /// Whether the derivative of this row is finite if the components first <= i < last are moved.
  bool isFiniteBeside(Index row, Index first, Index last) {
    evaluate(first, last);
    return isFinite(row);
  }

 private:
  bool isFinite(Index row) const { return std::isfinite(static_cast<double>(buffers_.r[row].d[0])); }
  void evaluate(Index first, Index last) {
    buffers_.copy(pointOf(state_));
    for (Index i = 0; i < buffers_.w.size(); ++i) buffers_.w[i].d[0] = Real(1);
    using std::abs;
    for (Index i = first; i < last; ++i) {
      componentOf(buffers_, i) += Dual<Real>(Real(kBeside) * (Real(1) + Real(abs(value(i)))));
    }
    system_.evaluate(Level::kAcceleration, buffers_.at(Dual<Real>(state_.t)), buffers_.residual());
  }

  const System<Real>& system_;
  const State<Real>& state_;
  PointBuffers<Dual<Real>> buffers_;
};

// The component whose move alone makes the row's derivative finite, by halving the range; -1 if there is none.
template <class Real>
Index componentToBlame(NearState<Real>& near, Index row) {
  Index first = 0, last = near.components();
  if (!near.isFiniteBeside(row, first, last)) return -1;
  while (last - first > 1) {
    const Index middle = first + (last - first) / 2;
    if (near.isFiniteBeside(row, first, middle)) {
      last = middle;
    } else if (near.isFiniteBeside(row, middle, last)) {
      first = middle;
    } else {
      return -1;  // several have to move together
    }
  }
  return first;
}

}  // namespace

template <class Real>
std::string derivativeFault(const System<Real>& system, DerivativeSource source, const State<Real>& state) {
  NearState<Real> near(system, state);
  const Index row = source == DerivativeSource::kAutomatic ? near.faultyRow() : -1;
  if (row < 0) return "dr/d(a, k, z) is not finite, though r is: r may be undefined next to this point";
  std::ostringstream text;
  text << "row " << row << ": dr/d(a, k, z) is not finite, though r is";
  const Index component = componentToBlame(near, row);
  if (component >= 0) {
    text << "; it is finite beside " << componentName(system.sizes(), component) << " = "
         << static_cast<double>(near.value(component));
  }
  text << "; the likely cause is a derivative 0/0 at this point, as of sqrt(x) at x = 0; derivatives "
          "'difference_central' may pass";
  return text.str();
}

template std::string derivativeFault(const System<double>&, DerivativeSource, const State<double>&);
template std::string derivativeFault(const System<BigFloat>&, DerivativeSource, const State<BigFloat>&);

}  // namespace irk
