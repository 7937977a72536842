#include "core/newton/newton_matrix.h"

#include "core/linear/block_form.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Dense Newton matrices of up to this many unknowns, s n, are allocated in advance.
constexpr Index kEagerSize = 300;

// The pattern can grow at any stage; all stages have to share one.
template <class Real, class PointOf>
void evaluateStages(Differentiator<Real>& differentiator, std::vector<Linearization<Real>>& at, Counters& counters,
                    const PointOf& point) {
  for (std::size_t i = 0; i < at.size();) {
    const auto before = differentiator.pattern();
    ++counters.jacobians;
    differentiator.evaluate(Level::kFormulated, point(static_cast<Index>(i)), at[i]);
    i = i > 0 && !sameShape(differentiator.pattern(), before) ? 0 : i + 1;
  }
}

}  // namespace

template <class Real>
SharedJacobian<Real>::SharedJacobian(const System<Real>& system, const Scheme<Real>& scheme,
                                     const IntegratorOptions& options, Counters& counters)
    : differentiator_(system, options.derivatives, options.jacobian, storageOf(options), Matrices::kAll, nullptr,
                      options.threads),
      at_(options.jacobian_point == JacobianPoint::kEachStage ? static_cast<std::size_t>(scheme.implicitStages()) : 1),
      point_(options.jacobian_point),
      middle_(point_ == JacobianPoint::kMiddle ? system.sizes() : Sizes{}),
      counters_(counters) {}

template <class Real>
void SharedJacobian<Real>::evaluate(StageEquations<Real>& eq, const Mat<Real>& W) {
  if (point_ == JacobianPoint::kEachStage) {
    eq.place(W);
    evaluateStages(differentiator_, at_, counters_, [&](Index i) { return eq.stage(W, eq.scheme().first + i); });
  } else {
    ++counters_.jacobians;
    const auto point = [&] {
      if (point_ == JacobianPoint::kPredicted) return eq.predicted(W);
      return point_ == JacobianPoint::kMiddle ? eq.middle(middle_) : eq.start();
    };
    differentiator_.evaluate(Level::kFormulated, point(), at_.front());
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
void SharedJacobian<Real>::forgetPattern() {
  stale_ = true;
  differentiator_.forgetPattern();
}

template <class Real>
const std::shared_ptr<const SparseAnalysis>& SharedJacobian<Real>::analysis(
    const std::shared_ptr<const Pattern>& pattern) {
  if (analysed_ == pattern) return analysis_;
  analysed_ = pattern;
  analysis_.reset();
  if (!pattern->full) {
    analysis_ = std::make_shared<const SparseAnalysis>(pattern->column_start, pattern->row);
  }
  return analysis_;
}

template <class Real>
NewtonMatrix<Real>::NewtonMatrix(SharedJacobian<Real>& shared, StageSolverKind kind, StageSolverSetup<Real> setup,
                                 Counters& counters, SolverOf of)
    : shared_(shared), kind_(kind), setup_(std::move(setup)), counters_(counters), of_(of) {
  setup_.form = makeBlockForm(kind, setup_.A);
  if (shared_.differentiator().pattern()) adopt(shared_.differentiator().pattern());
}

template <class Real>
void NewtonMatrix<Real>::adopt(const std::shared_ptr<const Pattern>& pattern) {
  setup_.pattern = pattern;
  setup_.analysis = shared_.analysis(setup_.pattern);
  solver_ = std::make_unique<CountedStageSolver<Real>>(makeStageSolver(kind_, setup_), counters_, of_);
}

template <class Real>
void NewtonMatrix<Real>::reserve() {
  const auto& pattern = shared_.at().front().pattern;
  if (!pattern || sameShape(pattern, setup_.pattern)) return;
  if (!pattern->full || setup_.A.rows() * pattern->n <= kEagerSize) adopt(pattern);
}

template <class Real>
Outcome NewtonMatrix<Real>::prepare(const Real& h) {
  if (version_ == shared_.version() && h_ == h) return Outcome::kSuccess;
  const auto& pattern = shared_.at().front().pattern;
  if (!sameShape(pattern, setup_.pattern)) adopt(pattern);
  const Outcome outcome = solver_->factorize(shared_.at(), h);
  version_ = outcome == Outcome::kSuccess ? shared_.version() : 0;
  h_ = h;
  return outcome;
}

template <class Real>
StagewiseMatrix<Real>::StagewiseMatrix(SharedJacobian<Real>& shared, StageSolverSetup<Real> setup, Counters& counters)
    : shared_(shared), setup_(std::move(setup)), counters_(counters), at_(static_cast<std::size_t>(setup_.A.rows())) {
  reserve();
}

template <class Real>
void StagewiseMatrix<Real>::reserve() {
  const auto& pattern = shared_.differentiator().pattern();
  if (!pattern || sameShape(pattern, setup_.pattern)) return;
  if (pattern->full && setup_.A.rows() * pattern->n > kEagerSize) return;
  at_.assign(at_.size(), Linearization<Real>(pattern));
  adopt(pattern);
}

template <class Real>
void StagewiseMatrix<Real>::adopt(const std::shared_ptr<const Pattern>& pattern) {
  setup_.pattern = pattern;
  const StageSolverKind kind = setup_.pattern->full ? StageSolverKind::kCoupledDense : StageSolverKind::kCoupledSparse;
  solver_ = std::make_unique<CountedStageSolver<Real>>(makeStageSolver(kind, setup_), counters_);
}

template <class Real>
Outcome StagewiseMatrix<Real>::prepare(const StageEquations<Real>& eq, const Mat<Real>& W) {
  evaluateStages(shared_.differentiator(), at_, counters_, [&](Index i) { return eq.stage(W, eq.scheme().first + i); });
  if (!sameShape(at_.front().pattern, setup_.pattern)) adopt(at_.front().pattern);
  return solver_->factorize(at_, eq.h());
}

IRK_INSTANTIATE_CLASS(SharedJacobian)
IRK_INSTANTIATE_CLASS(NewtonMatrix)
IRK_INSTANTIATE_CLASS(StagewiseMatrix)

}  // namespace irk
