// The axes: interchangeable strategies with stable ids, and the options of an integration.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "irk/misuse.h"
#include "irk/strategy_id.h"
#include "irk/system_options.h"

namespace irk {

enum class DerivativeSource { kAutomatic, kCentral, kForward };

/// How D0, D1, D2 and the Newton matrices are kept.
enum class Storage {
  kAutomatic,  ///< sparse where the system is large and its pattern sparse enough; kSparseFrom in
               ///< core/derivatives/differentiator.h
  kDense,
  kSparse,
};

// The catalogue of each axis, with what the ids mean and need, stands beside its strategies: core/options/catalogue.h.
/// The terms that are left out of (D0, D1, D2), paper (4.4)-(4.8). The residual is linear in a, so the derivatives of
/// M a are left out by differentiating at a = 0.
struct JacobianTerms : StrategyId<JacobianTerms> {
  static const JacobianTerms kFull;
  static const JacobianTerms kNoMassVxz;          ///< (4.4): without d(M a)/d(v, x, z)
  static const JacobianTerms kNoConstraintXz;     ///< (4.5): without dG/d(x, z)
  static const JacobianTerms kNoMass;             ///< (4.8) and (4.4): without d(M a)/d(u, v, x, z)
  static const JacobianTerms kConstantStiffness;  ///< (4.7): dF2/du evaluated once
};
inline constexpr JacobianTerms JacobianTerms::kFull{{"full"}};
inline constexpr JacobianTerms JacobianTerms::kNoMassVxz{{"no_mass_vxz"}};
inline constexpr JacobianTerms JacobianTerms::kNoConstraintXz{{"no_constraint_xz"}};
inline constexpr JacobianTerms JacobianTerms::kNoMass{{"no_mass"}};
inline constexpr JacobianTerms JacobianTerms::kConstantStiffness{{"constant_stiffness"}};

struct NewtonKind : StrategyId<NewtonKind> {
  static const NewtonKind
      kSimplified;                   ///< one Jacobian over steps, stop on the increment in the error norm, HW II (IV.8)
  static const NewtonKind kBroyden;  ///< the same with rank-one corrections of the matrix, Deuflhard's QNERR
  static const NewtonKind kModified;  ///< the paper's: stop on the residual, its restart and fallback rules, section 3
  static const NewtonKind kFull;      ///< a new stage-wise Jacobian in every iteration, stop on the residual
};
inline constexpr NewtonKind NewtonKind::kSimplified{{"simplified"}};
inline constexpr NewtonKind NewtonKind::kBroyden{{"broyden"}};
inline constexpr NewtonKind NewtonKind::kModified{{"modified"}};
inline constexpr NewtonKind NewtonKind::kFull{{"full"}};

struct StageSolverKind : StrategyId<StageSolverKind> {
  static const StageSolverKind kSchur, kEigen, kCoupledDense, kCoupledSparse;
};
inline constexpr StageSolverKind StageSolverKind::kSchur{{"schur"}};
inline constexpr StageSolverKind StageSolverKind::kEigen{{"eigen"}};
inline constexpr StageSolverKind StageSolverKind::kCoupledDense{{"coupled_dense"}};
inline constexpr StageSolverKind StageSolverKind::kCoupledSparse{{"coupled_sparse"}};

struct Predictor : StrategyId<Predictor> {
  static const Predictor kExtrapolated;  ///< collocation polynomial of the step before
  static const Predictor kPrevious;      ///< the stages of the step before, stage by stage (paper)
  static const Predictor kAcceleration;  ///< every stage starts from (a, k, z) at the step's start
};
inline constexpr Predictor Predictor::kExtrapolated{{"extrapolated"}};
inline constexpr Predictor Predictor::kPrevious{{"previous"}};
inline constexpr Predictor Predictor::kAcceleration{{"acceleration"}};

struct ErrorEstimate : StrategyId<ErrorEstimate> {
  /// |V_h - V_{h/2}| / (2^q - 1), each component with its own order q; at least the effect of a switch in the step, and
  /// at least an estimate of the stages' order where the two half steps do not show order q
  static const ErrorEstimate kRichardson;
  static const ErrorEstimate kDoubling;  ///< paper (5.4): |V_h - V_{h/2}| / (2^p - 1), p the classical order, for all
  static const ErrorEstimate kDoublingScalar;  ///< HOTINT: the difference of the two solutions' norms, over 2^p - 1
  static const ErrorEstimate kEmbedded;  ///< one solve with a real system: an embedded method of order s, HW II (IV.8)
  static const ErrorEstimate kNone;
};
inline constexpr ErrorEstimate ErrorEstimate::kRichardson{{"richardson"}};
inline constexpr ErrorEstimate ErrorEstimate::kDoubling{{"doubling"}};
inline constexpr ErrorEstimate ErrorEstimate::kDoublingScalar{{"doubling_scalar"}};
inline constexpr ErrorEstimate ErrorEstimate::kEmbedded{{"embedded"}};
inline constexpr ErrorEstimate ErrorEstimate::kNone{{"none"}};

struct StepControl : StrategyId<StepControl> {
  static const StepControl kPaper;       ///< the paper's section 6
  static const StepControl kHotint;      ///< the later source: s_min 2, s_max 4, exponent 1/p, no gamma
  static const StepControl kPredictive;  ///< Gustafsson's, HW II (IV.8.25)
  static const StepControl kFixed;
};
inline constexpr StepControl StepControl::kPaper{{"paper"}};
inline constexpr StepControl StepControl::kHotint{{"hotint"}};
inline constexpr StepControl StepControl::kPredictive{{"predictive"}};
inline constexpr StepControl StepControl::kFixed{{"fixed"}};

struct OrderControl : StrategyId<OrderControl> {
  static const OrderControl kFixed;     ///< one method
  static const OrderControl kVariable;  ///< members of a family by work per unit step and Newton's contraction
};
inline constexpr OrderControl OrderControl::kFixed{{"fixed"}};
inline constexpr OrderControl OrderControl::kVariable{{"variable"}};

/// How a step's increments are added to u, v, x.
enum class Summation {
  kCompensated,  ///< the round-off of each addition is added to the next increment
  kPlain,
};
/// (a, k, z) at the end of an integration, of systems with algebraic unknowns.
enum class Multipliers {
  kStages,      ///< those of the last step: in index 2 of order s, with the error of Newton's method divided by h
  kConsistent,  ///< computed from (u, v, x) at the level of accelerations, and as accurate as these
};
enum class JacobianPoint {
  kStart,
  kMiddle,     ///< t0 + h/2, by Taylor's formula from the start
  kPredicted,  ///< an inner stage of the start values
  kEachStage,
};

enum class NormKind {
  kMixed,     ///< RMS of e_i / (atol scale_i + rtol |y_i|); accepted below 1
  kAbsolute,  ///< the paper's: 2-norm of e / atol over all components
};

/// One id of an axis, as the command line, study files and tables write it.
template <class E>
struct Named {
  E value;
  std::string_view id;
  std::string_view meaning;
};

/// All ids of an axis, the default first.
template <class E>
std::span<const Named<E>> named();

/// The value behind an id. Throws Misuse with the axis, the nearest id and all ids.
template <class E>
E parseId(std::string_view id);

template <class E>
std::string_view idOf(E value) {
  if constexpr (requires { value.id; }) return value.id;
  for (const auto& entry : named<E>()) {
    if (entry.value == value) return entry.id;
  }
  return "?";
}

/// The axis' name in options, files and messages: `newton`, `solver`, ...
template <class E>
std::string_view axisName();

// The legal values of all options, their meanings for users, and which ones have no effect beside others are in the
// table optionFields(), core/options/option_fields.cpp. A member that is added here needs its line there.

struct NewtonOptions {
  NewtonKind kind = NewtonKind::kSimplified;
  /// Paper (3.2): done when eps(i) <= tol eps(0). `modified` and `full`.
  double residual_tolerance = 1e-10;
  /// Paper (3.4): contractivity above which the Jacobian is recomputed, ...
  double contractivity_limit = 0.7;
  /// ... after more than this many iterations.
  int contractivity_after = 3;
  /// Paper, section 3: 25 iterations without convergence are a failure.
  int max_iterations = 25;
  /// 0 = max(10 eps/rtol, min(0.03, rtol^((s-1)/(s+1)))). HW II (IV.8.10) with the exponent
  /// that shrinks with s; from 1000 accepted steps on it falls with their number, down to 10 eps/rtol. `simplified`,
  /// `broyden`: done when eta |dw| <= kappa in the error norm.
  double kappa = 0;
  /// `simplified`, `broyden`: the Jacobian is kept for the next step while theta stays below this.
  double keep_jacobian_below = 1e-3;
};

struct StepOptions {
  StepControl control = StepControl::kPredictive;
  ErrorEstimate estimate = ErrorEstimate::kRichardson;
  /// Fixed control: the step, > 0 (the last one is shortened to end at t_end). Else the first step;
  /// 0 = chosen from the scale of the solution.
  double h = 0;
  /// 0 = 16 eps |t| or the smallest number.
  double h_min = 0;
  double h_max = 1e300;
  /// Attempted steps.
  std::int64_t max_steps = 1'000'000;
  /// Paper (6.1)-(6.3): s_min = 4, s_max = s_min^2; a step is kept unless it would change by
  /// `change_at_least`; growth at most `growth_at_most`.
  double s_min = 4;
  double change_at_least = 2;
  double growth_at_most = 5;
};

struct Tolerances {
  double rtol = 1e-6;
  double atol = 1e-6;  ///< times the component's scale
  NormKind norm = NormKind::kMixed;
};

/// All options of an integration.
struct IntegratorOptions {
  Tolerances tolerances;
  DerivativeSource derivatives = DerivativeSource::kAutomatic;
  JacobianPoint jacobian_point = JacobianPoint::kStart;
  JacobianTerms jacobian = JacobianTerms::kFull;
  NewtonOptions newton;
  StageSolverKind solver = StageSolverKind::kSchur;
  /// Of `schur` and `eigen`; the coupled solvers have their own.
  Storage storage = Storage::kAutomatic;
  /// Threads for the residuals of the stages and the factorizations of the blocks of one integration; the results do
  /// not depend on it. In a parallel region of the caller it has no effect: one thread.
  int threads = 1;
  Predictor predictor = Predictor::kExtrapolated;
  Summation summation = Summation::kCompensated;
  Multipliers multipliers = Multipliers::kConsistent;
  OrderControl order = OrderControl::kFixed;
  StepOptions step;
};

/// Throws Misuse naming field, value and range. Which options go together: core/integration/rules.h.
void validate(const IntegratorOptions& options);

}  // namespace irk
