#include "core/integration/stiff_rest.h"

#include "irk/multiprecision.h"

namespace irk {
namespace {

// Components with |h lambda| of some thousands and more are not damped by a method with |R(infinity)| = 1.
constexpr double kPart = 0.01;
// z = d lambda multiplies each filtered e by 1 / (1 - z). The sum of e_k with these factors is e (z / (1 - z))^2.
constexpr int kFilters = 3;
constexpr double kFactors[kFilters] = {1, -2, 1};

template <class Real>
StageSolverSetup<Real> oneStage(const System<Real>& system) {
  return {Mat<Real>::Constant(1, 1, Real(1)), nullptr, system.rowPowers(), system.sizes()};
}

}  // namespace

template <class Real>
StiffRest<Real>::StiffRest(const System<Real>& system, const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
                           const ErrorNorm<Real>& norm, Counters& counters)
    : system_(system),
      norm_(norm),
      sizes_(system.sizes()),
      matrix_(jacobian, options.solver, oneStage(system), counters),
      at_(sizes_),
      change_(sizes_),
      rest_(sizes_),
      slip_(sizes_.nu),
      e_(sizes_.n(), 1) {}

// Computes the change of (u, v, x) by an implicit Euler step of size d from `at_`, driven by the difference from the
// rates in at_.w.
template <class Real>
bool StiffRest<Real>::filter(const Real& d) {
  at_.u += slip_;
  system_.evaluate(Level::kFormulated, pointOf(at_), VecView<Real>(e_.data(), e_.rows()));
  at_.u -= slip_;
  if (!e_.allFinite()) return false;
  matrix_.solve(e_);
  change_.v = -d * e_.col(0).head(sizes_.nu);
  change_.u = slip_ + d * change_.v;
  change_.x = -d * e_.col(0).segment(sizes_.nu, sizes_.nx);
  return true;
}

template <class Real>
double StiffRest<Real>::error(const StepPiece<Real>& last, const State<Real>& end) {
  const StagePolynomial<Real>& stages = *last.stages;
  const Real d = Real(kPart) * stages.h;
  if (!stages.valid || matrix_.prepare(d) != Outcome::kSuccess) return 0;
  const Scheme<Real>& scheme = *stages.scheme;
  at_ = end;
  at_.w.noalias() = stages.W * scheme.end;
  weights_.noalias() = scheme.A_transposed * scheme.end;
  slip_ = d * (end.v - last.from->v - stages.h * (stages.W.topRows(sizes_.nu) * weights_));
  rest_ = State<Real>(sizes_);
  for (const double factor : kFactors) {
    if (!filter(d)) return 0;
    rest_.u += Real(factor) * change_.u;
    rest_.v += Real(factor) * change_.v;
    rest_.x += Real(factor) * change_.x;
    at_.u += change_.u;
    at_.v += change_.v;
    at_.x += change_.x;
    slip_ += d * change_.v;
  }
  return norm_.magnitude(rest_, static_cast<double>(stages.h));
}

template <class Real>
Index StiffRest<Real>::worstComponent() const {
  return norm_.worst(rest_, State<Real>(sizes_), 1, Vec<double>::Ones(sizes_.components()));
}

IRK_INSTANTIATE_CLASS(StiffRest)

}  // namespace irk
