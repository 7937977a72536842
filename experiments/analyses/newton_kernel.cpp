#include "experiments/analyses/newton_kernel.h"

#include <algorithm>

#include "core/stages/scheme.h"
#include "experiments/runs/setup.h"

namespace irk {
namespace {

/// A system with a residual of no cost, for timing the rest of a Newton iteration alone.
class FreeSystem final : public System<double> {
 public:
  explicit FreeSystem(const System<double>& inner) : inner_(inner) {}
  Sizes sizes() const override { return inner_.sizes(); }
  void evaluate(Level, const Point<double>&, VecView<double> r) const override { r.setZero(); }
  void evaluate(Level, const Point<Dual<double>>&, VecView<Dual<double>> r) const override { r.setZero(); }
  void evaluateStages(const StagePoints<double>& at, Index first, Index last, double* r) const override {
    const Index n = at.sizes.n();
    std::fill(r + first * n, r + last * n, 0.0);
  }
  const std::vector<int>& rowPowers() const override { return inner_.rowPowers(); }
  const ErrorPowers& errorPowers() const override { return inner_.errorPowers(); }
  State<double> fromScene(const State<double>& s) const override { return inner_.fromScene(s); }
  State<double> toScene(const State<double>& s) const override { return inner_.toScene(s); }

 private:
  const System<double>& inner_;
};

// Limit of halvings of a step until it is solved.
constexpr int kMaxTrials = 20;
// An estimate with which the controller accepts.
constexpr double kGoodError = 0.3;
// A limit that no contraction exceeds.
constexpr double kAlways = 1e300;

bool doublesSteps(ErrorEstimate estimate) {
  return estimate != ErrorEstimate::kEmbedded && estimate != ErrorEstimate::kNone;
}

// A for one stage whose time is that of the filter, whatever the filter's mu is.
Mat<double> filterMatrix(const Scheme<double>& scheme) {
  return Mat<double>::Constant(1, 1, 1 / static_cast<double>(scheme.s));
}

// Steps keep their first Jacobian and its factors, whose time would otherwise hide the rest of a step.
IntegratorOptions withoutNewJacobians(IntegratorOptions options) {
  options.newton.keep_jacobian_below = kAlways;
  return options;
}

}  // namespace

NewtonKernel::NewtonKernel(const RunSpec& spec, double h) : NewtonKernel(makeSetup<double>(spec), spec, h) {}

NewtonKernel::NewtonKernel(const Setup<double>& setup, const RunSpec& spec, double h)
    : system_(setup.system),
      free_(std::make_unique<FreeSystem>(*system_)),
      counted_(*system_, counters_, spec.options.threads),
      start_(system_->fromScene(setup.scene.start)),
      h_(h),
      differentiator_(*system_, spec.options.derivatives, JacobianTerms::kFull, storageOf(spec.options)),
      at_(1),
      schemes_(setup.methods),
      scheme_(schemes_[setup.methods.start]),
      options_(withoutNewJacobians(spec.options)),
      equations_(*system_, scheme_, spec.options.summation, spec.options.threads),
      free_equations_(*free_, scheme_, spec.options.summation, 1),
      kind_(spec.options.solver),
      setup_{scheme_.implicitA(), nullptr, system_->rowPowers(), system_->sizes(), spec.options.threads},
      filter_setup_{filterMatrix(scheme_), nullptr, system_->rowPowers(), system_->sizes()},
      norm_(*system_, spec.options.tolerances, setup.scale),
      controller_(makeController(spec.options.step, scheme_.tableau.order)),
      doubles_(doublesSteps(spec.options.step.estimate)),
      shared_(counted_, scheme_, options_, counters_),
      attempt_(makeStepAttempt<double>({counted_, schemes_, setup.methods.start, options_, shared_, norm_, counters_})),
      row_weights_(system_->sizes().n()),
      t_(scheme_.s) {
  setup_.form = makeBlockForm(kind_, setup_.A);
  filter_setup_.form = makeBlockForm(kind_, filter_setup_.A);
  countResiduals(spec);
  jacobian();
  makeSolver();
  begin();
}

void NewtonKernel::makeSolver() {
  const auto& pattern = at_.front().pattern;
  if (!pattern->full) {
    setup_.analysis = std::make_shared<const SparseAnalysis>(pattern->column_start, pattern->row);
    filter_setup_.analysis = setup_.analysis;
  }
  setup_.pattern = filter_setup_.pattern = pattern;
  solver_ = std::make_unique<CountedStageSolver<double>>(makeStageSolver<double>(kind_, setup_), counters_);
  filter_.reset();
  rhs_ = ones_ = Mat<double>::Ones(system_->sizes().n(), scheme_.implicitStages());
}

void NewtonKernel::moveTo(const State<double>& scene_state) {
  start_ = system_->fromScene(scene_state);
  jacobian();
  begin();
}

// Computes everything that follows from the state and h.
void NewtonKernel::begin() {
  W_ = W0_ = R_ = start_.w.replicate(1, scheme_.s);
  t_.setConstant(start_.t);
  U_ = start_.u.replicate(1, scheme_.s);
  V_ = start_.v.replicate(1, scheme_.s);
  X_ = start_.x.replicate(1, scheme_.s);
  middle_ = end_ = start_;
  norm_.update(start_);
  norm_.rowWeights(h_, row_weights_);
  equations_.begin(start_, h_);
  free_equations_.begin(start_, h_);
  solvable_h_ = h_;
  shared_.markStale();
  if (!attempts()) return;
  const StepPieces<double> solved = attempt_->pieces(middle_);
  W0_ = solved.at[solved.count - 1].stages->W;
}

void NewtonKernel::countResiduals(const RunSpec& spec) {
  Counters counters;
  const CountingSystem<double> counted(*system_, counters);
  Differentiator<double> counting(counted, spec.options.derivatives, JacobianTerms::kFull, storageOf(spec.options));
  counting.evaluate(Level::kFormulated, point(), at_.front());  // finds the pattern
  residuals_of_first_ = counters.residuals;
  counters = {};
  counting.evaluate(Level::kFormulated, point(), at_.front());
  residuals_per_jacobian_ = counters.residuals;
}

void NewtonKernel::residuals() {
  const StagePoints<double> at{system_->sizes(), t_.data(), U_.data(),      V_.data(),
                               X_.data(),        W_.data(), start_.d.data()};
  counted_.evaluateStages(at, scheme_.first, scheme_.s, R_.data());
}

void NewtonKernel::jacobian() { differentiator_.evaluate(Level::kFormulated, point(), at_.front()); }

void NewtonKernel::firstMatrices() {
  differentiator_.forgetPattern();
  jacobian();
  for (std::int64_t i = 0; i < steppers() && sparse(); ++i) {
    makeSolver();
    factorize();
  }
}

void NewtonKernel::factorize() {
  if (solver_->factorize(at_, h_) != Outcome::kSuccess) {
    throw Misuse("the Newton matrix cannot be factorized");
  }
}

void NewtonKernel::iteration() {
  W_ = W0_;
  static_cast<void>(equations_.residual(W_, R_));  // takes as long where it is not finite
  solver_->solve(R_.rightCols(scheme_.implicitStages()));
  moveBy(R_);
}

void NewtonKernel::solve() {
  rhs_ = ones_;
  solver_->solve(rhs_);
}

void NewtonKernel::factorizeFilter() {
  if (!filter_) {
    filter_ = std::make_unique<CountedStageSolver<double>>(makeStageSolver<double>(kind_, filter_setup_), counters_,
                                                           SolverOf::kFilter);
  }
  if (filter_->factorize(at_, h_) != Outcome::kSuccess) throw Misuse("the filter cannot be factorized");
}

void NewtonKernel::solveFilter() {
  one_rhs_ = ones_.leftCols(1);
  filter_->solve(one_rhs_);
}

void NewtonKernel::update() {
  W_ = W0_;
  static_cast<void>(free_equations_.residual(W_, R_));
  moveBy(R_);
}

void NewtonKernel::moveBy(const Mat<double>& increment) {
  W_ -= increment;
  decided_ = norm_.increment(increment, scheme_.first, row_weights_);
}

std::optional<Counters> NewtonKernel::attempts() {
  for (int trial = 0; trial < kMaxTrials; ++trial, solvable_h_ /= 2) {
    counters_ = {};
    // So that all calls do the same: steps of an integration of a hundred of them.
    attempt_->begin(100 * solvable_h_);
    if (attempt_->attempt(start_, solvable_h_, middle_).outcome != Outcome::kSuccess) continue;
    if (attempt_->attempt(middle_, solvable_h_, end_).outcome == Outcome::kSuccess) return counters_;
  }
  return {};
}

void NewtonKernel::step() {
  norm_.update(start_);
  if (controller_) decided_ = controller_->decide(kGoodError, h_).h;
}

}  // namespace irk
