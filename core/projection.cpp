#include "core/projection.h"

#include "core/multiprecision.h"

namespace irk {

template <class Real>
VelocityProjection<Real>::VelocityProjection(const System<Real>& system, DerivativeSource source,
                                             Counters& counters)
    : system_(system),
      sizes_(system.sizes()),
      counters_(counters),
      differentiator_(system, source, JacobianTerms::kFull, Storage::kAutomatic,
                      Matrices::kOnlyD0),
      r_(sizes_.n()) {}

template <class Real>
Outcome VelocityProjection<Real>::apply(State<Real>& state) {
  const Index first = sizes_.nu + sizes_.nx;
  ++counters_.jacobians;
  differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
  system_.evaluate(Level::kVelocity, pointOf(state), VecView<Real>(r_.data(), r_.size()));
  r_.head(first).setZero();
  r_.tail(sizes_.nz - sizes_.constraints).setZero();
  const Outcome outcome = lu_.factorize(D_);
  if (outcome != Outcome::kSuccess) return outcome;
  lu_.solve(r_);
  if (!r_.allFinite()) return Outcome::kNotFinite;
  state.v -= r_.head(sizes_.nu);
  return Outcome::kSuccess;
}

IRK_INSTANTIATE_CLASS(VelocityProjection)

}  // namespace irk
