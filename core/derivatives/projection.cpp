#include "core/derivatives/projection.h"

#include "irk/multiprecision.h"

namespace irk {

template <class Real>
VelocityProjection<Real>::VelocityProjection(const System<Real>& system, DerivativeSource source, Counters& counters)
    : system_(system),
      sizes_(system.sizes()),
      counters_(counters),
      differentiator_(system, source, JacobianTerms::kFull, Storage::kAutomatic, Matrices::kOnlyD0),
      r_(sizes_.n()) {}

// r_ = D0^-1 times the constraint rows at this level, all other rows zero.
template <class Real>
Outcome VelocityProjection<Real>::solve(Level level, const State<Real>& state) {
  const Index first = sizes_.nu + sizes_.nx;
  ++counters_.jacobians;
  differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
  system_.evaluate(level, pointOf(state), VecView<Real>(r_.data(), r_.size()));
  r_.head(first).setZero();
  r_.tail(sizes_.nz - sizes_.constraints).setZero();
  for (const Index i : system_.leftOut()) r_[first + i] = Real(0);
  ++counters_.mass_factorizations;
  const Outcome outcome = lu_.factorize(D_);
  if (outcome != Outcome::kSuccess) return outcome;
  lu_.solve(r_);
  return r_.allFinite() ? Outcome::kSuccess : Outcome::kNotFinite;
}

template <class Real>
Outcome VelocityProjection<Real>::apply(State<Real>& state) {
  const Outcome outcome = solve(Level::kVelocity, state);
  if (outcome == Outcome::kSuccess) state.v -= r_.head(sizes_.nu);
  return outcome;
}

template <class Real>
Outcome VelocityProjection<Real>::applyToPositions(State<Real>& state) {
  constexpr int kCorrections = 2;  // enough: g is small already, and convergence is quadratic
  for (int i = 0; i < kCorrections; ++i) {
    const Outcome outcome = solve(Level::kPosition, state);
    if (outcome != Outcome::kSuccess) return outcome;
    state.u -= r_.head(sizes_.nu);
  }
  return apply(state);
}

IRK_INSTANTIATE_CLASS(VelocityProjection)

}  // namespace irk
