#include "core/jacobian.h"

#include "core/multiprecision.h"

namespace irk {

template <class Real>
SharedJacobian<Real>::SharedJacobian(const System<Real>& system, const Scheme<Real>& scheme,
                                     const IntegratorOptions& options, Counters& counters)
    : differentiator_(system, options.derivatives, options.jacobian),
      at_(options.jacobian_point == JacobianPoint::kEachStage
              ? static_cast<std::size_t>(scheme.implicitStages())
              : 1,
          Linearization<Real>(Pattern::dense(system.sizes().n()))),
      point_(options.jacobian_point),
      counters_(counters) {}

template <class Real>
void SharedJacobian<Real>::evaluate(StageEquations<Real>& eq, const Mat<Real>& W) {
  if (point_ == JacobianPoint::kEachStage) {
    eq.place(W);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      ++counters_.jacobians;
      const Index stage = eq.scheme().first + static_cast<Index>(i);
      differentiator_.evaluate(Level::kFormulated, eq.stage(W, stage), at_[i]);
    }
  } else {
    ++counters_.jacobians;
    const bool middle = point_ == JacobianPoint::kMiddle;
    differentiator_.evaluate(Level::kFormulated, middle ? eq.middle() : eq.start(), at_.front());
  }
  t_ = eq.from().t;
  ++version_;
  stale_ = false;
}

template <class Real>
void SharedJacobian<Real>::forget() {
  stale_ = true;
  differentiator_.forget();
}

template <class Real>
Outcome NewtonMatrix<Real>::prepare(const Real& h) {
  if (version_ == shared_.version() && h_ == h) return Outcome::kSuccess;
  const Outcome outcome = solver_->factorize(shared_.at(), h);
  version_ = outcome == Outcome::kSuccess ? shared_.version() : 0;
  h_ = h;
  return outcome;
}

namespace {
constexpr Index kEagerSize = 300;
}  // namespace

template <class Real>
StagewiseMatrix<Real>::StagewiseMatrix(SharedJacobian<Real>& shared, StageSolverSetup<Real> setup,
                                       NewtonKind newton, Counters& counters)
    : shared_(shared), setup_(std::move(setup)), counters_(counters) {
  const bool used = newton != NewtonKind::kSimplified;
  if (used && setup_.A.rows() * setup_.pattern->n <= kEagerSize) allocate();
}

template <class Real>
void StagewiseMatrix<Real>::allocate() {
  at_.assign(static_cast<std::size_t>(setup_.A.rows()), Linearization<Real>(setup_.pattern));
  solver_ = std::make_unique<CountingStageSolver<Real>>(
      makeStageSolver(StageSolverKind::kCoupledDense, setup_), counters_);
}

template <class Real>
Outcome StagewiseMatrix<Real>::prepare(const StageEquations<Real>& eq, const Mat<Real>& W) {
  const Index first = eq.scheme().first;
  if (!solver_) allocate();
  for (Index i = 0; i < eq.scheme().implicitStages(); ++i) {
    ++counters_.jacobians;
    shared_.differentiator().evaluate(Level::kFormulated, eq.stage(W, first + i),
                                      at_[static_cast<std::size_t>(i)]);
  }
  return solver_->factorize(at_, eq.h());
}

IRK_INSTANTIATE_CLASS(SharedJacobian)
IRK_INSTANTIATE_CLASS(NewtonMatrix)
IRK_INSTANTIATE_CLASS(StagewiseMatrix)

}  // namespace irk
