// Newton methods that stop on the residual: the paper's with its fallbacks, and full Newton.
#include <algorithm>
#include <cmath>

#include "core/newton/newton.h"
#include "core/newton/newton_base.h"
#include "core/options/fixed_steps.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

/// Whether an increment at round-off ends the iteration although the residual has not shrunk by the required factor.
enum class AtRoundOff { kEnd, kGoOn };

/// Paper, section 3. eps(i) = |R|_2; converged when eps(i) <= tol eps(0). By default an increment at round-off ends the
/// iteration as well, since the residual then cannot shrink further.
///
/// Fixed steps have no tolerance that says what tol is good for: what the rule leaves would be a part of the error that
/// they show. From eps(i) <= tol eps(0) on their iteration therefore goes on to round-off: until an increment is at
/// round-off, or two iterations together shrink eps by less than the paper asks for (contractivity_limit).
template <class Real>
class ResidualNewton : public NewtonBase<Real> {
 public:
  ResidualNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme,
                 AtRoundOff at_round_off = AtRoundOff::kEnd)
      : NewtonBase<Real>(options, sizes, scheme),
        at_round_off_(at_round_off),
        to_round_off_(hasFixedSteps(options.step) && at_round_off == AtRoundOff::kEnd) {}

 protected:
  enum Jacobian { kKept, kStagewise };

  NewtonResult iterate(NewtonContext<Real>& c, Mat<Real>& W, Jacobian jacobian) {
    const NewtonOptions& o = this->options_.newton;
    NewtonResult result;
    if (!this->residual(c, W)) return fail(result, Outcome::kNotFinite);
    const double eps0 = residualNorm();
    double eps = eps0, before_previous = eps0;
    if (eps0 == 0) return result;
    bool reached = false;
    const double contracts = std::max(NewtonOptions{}.contractivity_limit, o.contractivity_limit);
    const int limit = o.max_iterations * (to_round_off_ ? kFixedStepFactor.whole() : 1);
    for (int i = 1; i <= limit; ++i) {
      ++result.iterations;
      ++c.counters.newton_iterations;
      result.outcome = jacobian == kStagewise ? c.stagewise->prepare(c.eq, W) : c.matrix.prepare(c.eq.h());
      if (result.outcome != Outcome::kSuccess) return result;
      const double norm = jacobian == kStagewise ? this->update(c, *c.stagewise, W) : this->update(c, c.matrix, W);
      if (!std::isfinite(norm) || !this->residual(c, W)) return fail(result, Outcome::kNotFinite);
      const double previous = eps;
      eps = residualNorm();
      const double theta = eps / previous;
      if (!reached) result.theta = theta;
      const bool stagnates = reached && eps >= contracts * contracts * before_previous;
      reached = reached || eps <= o.residual_tolerance * eps0;
      if (eps == 0 || stagnates || (reached && !to_round_off_)) return result;
      before_previous = previous;
      if (at_round_off_ == AtRoundOff::kEnd) {
        if (norm <= kRoundOffUnits * this->round_off_) return result;
        if (theta >= kSlowContraction && norm <= kStagnationUnits * this->round_off_) return result;
      }
      if (reached) continue;
      // Paper (3.4). Full Newton is the last resort and may use all iterations.
      const bool slow = jacobian == kKept && theta > o.contractivity_limit && i > o.contractivity_after;
      if (slow || i == o.max_iterations) return fail(result, Outcome::kNewtonFailed);
    }
    return fail(result, Outcome::kNewtonFailed);
  }

 private:
  double residualNorm() const { return static_cast<double>(Real(this->R_.norm())); }
  static NewtonResult fail(NewtonResult result, Outcome outcome) {
    result.outcome = outcome;
    return result;
  }

  AtRoundOff at_round_off_;
  bool to_round_off_;
};

/// Tries the kept Jacobian, then a new one, then Jacobians of all stages if these are the last resort.
template <class Real>
class ModifiedNewton : public ResidualNewton<Real> {
  using Base = ResidualNewton<Real>;

 public:
  ModifiedNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme,
                 bool full_at_last = true, AtRoundOff at_round_off = AtRoundOff::kEnd)
      : Base(options, sizes, scheme, at_round_off), full_at_last_(full_at_last) {}
  NewtonResult solve(NewtonContext<Real>& c, Mat<Real>& W) override {
    this->begin(c, W);
    auto& shared = c.matrix.shared();
    this->refresh(c, W);
    if (full_at_last_) c.stagewise->reserve();
    const bool had_old = !shared.evaluatedAt(c.eq.from().t);
    NewtonResult result = this->iterate(c, W, Base::kKept);
    if (result.outcome != Outcome::kSuccess && had_old) {
      ++c.counters.newton_restarts;
      W = this->W0_;
      shared.evaluate(c.eq, W);
      result = again(c, W, Base::kKept, result);
    }
    if (result.outcome != Outcome::kSuccess && full_at_last_) {
      ++c.counters.newton_restarts;
      W = this->W0_;
      result = again(c, W, Base::kStagewise, result);
    }
    if (result.outcome != Outcome::kSuccess) shared.markStale();
    return result;
  }

 private:
  NewtonResult again(NewtonContext<Real>& c, Mat<Real>& W, typename Base::Jacobian jacobian,
                     const NewtonResult& before) {
    NewtonResult result = this->iterate(c, W, jacobian);
    result.iterations += before.iterations;
    return result;
  }

  bool full_at_last_;
};

/// The modified method without its last resort: a step that it cannot solve fails.
template <class Real>
class ModifiedOnlyNewton final : public ModifiedNewton<Real> {
 public:
  ModifiedOnlyNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : ModifiedNewton<Real>(options, sizes, scheme, false) {}
};

/// The paper's stopping rule (3.2) to the letter: round-off does not end the iteration.
template <class Real>
class PaperRuleNewton final : public ModifiedNewton<Real> {
 public:
  PaperRuleNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : ModifiedNewton<Real>(options, sizes, scheme, true, AtRoundOff::kGoOn) {}
};

/// Full Newton: Jacobians of all stages, new in every iteration.
template <class Real>
class FullNewton final : public ResidualNewton<Real> {
  using Base = ResidualNewton<Real>;

 public:
  FullNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<Real>& scheme)
      : Base(options, sizes, scheme) {}
  NewtonResult solve(NewtonContext<Real>& c, Mat<Real>& W) override {
    this->begin(c, W);
    return this->iterate(c, W, Base::kStagewise);
  }
};

}  // namespace

Strategy<NewtonKind> modifiedNewton() {
  return {.id = NewtonKind::kModified,
          .meaning = "the paper's, with its restart and fallback rules",
          .uses_stage_matrices = true,
          .make = makes<NewtonMaker, ModifiedNewton>()};
}

Strategy<NewtonKind> modifiedOnlyNewton() {
  return {.id = {{"modified_only"}},
          .meaning = "the paper's without its last resort, full Newton: shows what that repairs",
          .make = makes<NewtonMaker, ModifiedOnlyNewton>()};
}

Strategy<NewtonKind> paperRuleNewton() {
  return {.id = {{"paper_rule"}},
          .meaning =
              "the paper's with its stopping rule (3.2) alone: round-off does not end the iteration, nor is it asked "
              "for in fixed steps",
          .uses_stage_matrices = true,
          .make = makes<NewtonMaker, PaperRuleNewton>()};
}

Strategy<NewtonKind> fullNewton() {
  return {.id = NewtonKind::kFull,
          .meaning = "a new stage-wise Jacobian in every iteration",
          .needs = {.coupled_solver = true},
          .keeps_jacobian = false,
          .uses_stage_matrices = true,
          .make = makes<NewtonMaker, FullNewton>()};
}

}  // namespace irk
