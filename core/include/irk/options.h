// The axes: interchangeable strategies with stable ids, and the options of an integration.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "irk/misuse.h"
#include "irk/strategy_id.h"
#include "irk/system_options.h"

namespace irk {

/// How D0, D1 and D2 are computed.
enum class DerivativeSource { kAutomatic, kCentral, kForward };

/// How D0, D1, D2 and the Newton matrices are stored.
enum class Storage {
  kAutomatic,  ///< sparse where the system is large and its pattern sparse enough; kSparseFrom in
               ///< core/derivatives/differentiator.h
  kDense,      ///< full matrices; their derivatives use coloured columns as well
  kSparse,     ///< compressed columns; scalar double only
};

// The catalogue of each axis stands beside its strategies; it says what the ids mean and need:
// core/options/catalogue.h.

/// The terms that are left out of (D0, D1, D2), paper (4.4)-(4.8). The residual is linear in a, so that derivatives of
/// M a are left out by differentiating at a = 0.
struct JacobianTerms : StrategyId<JacobianTerms> {
  static const JacobianTerms kFull;               ///< none is left out
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

/// Newton's method: when it stops and when its matrix is renewed.
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

/// How the linear systems of Newton's method are solved: s/2 complex systems of n unknowns by Schur or eigenvalue
/// decomposition of A, or one system of s n unknowns, dense or sparse.
struct StageSolverKind : StrategyId<StageSolverKind> {
  static const StageSolverKind kSchur, kEigen, kCoupledDense, kCoupledSparse;
};
inline constexpr StageSolverKind StageSolverKind::kSchur{{"schur"}};
inline constexpr StageSolverKind StageSolverKind::kEigen{{"eigen"}};
inline constexpr StageSolverKind StageSolverKind::kCoupledDense{{"coupled_dense"}};
inline constexpr StageSolverKind StageSolverKind::kCoupledSparse{{"coupled_sparse"}};

/// Where the start values of Newton's method come from.
struct Predictor : StrategyId<Predictor> {
  static const Predictor kExtrapolated;  ///< collocation polynomial of the step before
  static const Predictor kPrevious;      ///< the stages of the step before, stage by stage (paper)
  static const Predictor kAcceleration;  ///< every stage starts from (a, k, z) at the step's start
};
inline constexpr Predictor Predictor::kExtrapolated{{"extrapolated"}};
inline constexpr Predictor Predictor::kPrevious{{"previous"}};
inline constexpr Predictor Predictor::kAcceleration{{"acceleration"}};

/// How the error of a step is estimated. V_h: the result of one step h; V_{h/2}: that of two half steps.
struct ErrorEstimate : StrategyId<ErrorEstimate> {
  /// |V_h - V_{h/2}| / (2^q - 1), each component with its own order q. It is at least the effect of a switch in the
  /// step, and at least an estimate of the stages' order if the two half steps do not show order q.
  static const ErrorEstimate kRichardson;
  static const ErrorEstimate kDoubling;  ///< paper (5.4): |V_h - V_{h/2}| / (2^p - 1), p the classical order, for all
  /// HOTINT: the difference of the two solutions' norms, divided by 2^p - 1
  static const ErrorEstimate kDoublingScalar;
  static const ErrorEstimate kEmbedded;  ///< one solve with a real system: an embedded method of order s, HW II (IV.8)
  static const ErrorEstimate kNone;      ///< no estimate; fixed steps only
};
inline constexpr ErrorEstimate ErrorEstimate::kRichardson{{"richardson"}};
inline constexpr ErrorEstimate ErrorEstimate::kDoubling{{"doubling"}};
inline constexpr ErrorEstimate ErrorEstimate::kDoublingScalar{{"doubling_scalar"}};
inline constexpr ErrorEstimate ErrorEstimate::kEmbedded{{"embedded"}};
inline constexpr ErrorEstimate ErrorEstimate::kNone{{"none"}};

/// How step sizes are chosen.
struct StepControl : StrategyId<StepControl> {
  static const StepControl kPaper;  ///< the paper's section 6
  /// the paper's, as in the later HOTINT source: s_min 2, s_max 4, exponent 1/p, no gamma
  static const StepControl kHotint;
  static const StepControl kPredictive;  ///< Gustafsson's, HW II (IV.8.25)
  static const StepControl kFixed;       ///< constant steps of size StepOptions::h
};
inline constexpr StepControl StepControl::kPaper{{"paper"}};
inline constexpr StepControl StepControl::kHotint{{"hotint"}};
inline constexpr StepControl StepControl::kPredictive{{"predictive"}};
inline constexpr StepControl StepControl::kFixed{{"fixed"}};

/// Whether one method takes all steps.
struct OrderControl : StrategyId<OrderControl> {
  static const OrderControl kFixed;     ///< one method takes all steps
  static const OrderControl kVariable;  ///< members of a family, chosen by work per unit step and Newton's contraction
};
inline constexpr OrderControl OrderControl::kFixed{{"fixed"}};
inline constexpr OrderControl OrderControl::kVariable{{"variable"}};

/// How a step's increments are added to u, v, x.
enum class Summation {
  kCompensated,  ///< the round-off of each addition is added to the next increment
  kPlain,        ///< round-off accumulates
};
/// How (a, k, z) at the end of an integration are computed, for systems with algebraic unknowns.
enum class Multipliers {
  kStages,      ///< taken from the last step: in index 2 of order s, with the error of Newton's method divided by h
  kConsistent,  ///< computed from (u, v, x) at the level of accelerations, and as accurate as these
};
/// Where in a step the Jacobian is evaluated.
enum class JacobianPoint {
  kStart,      ///< at the step's start (paper)
  kMiddle,     ///< at t0 + h/2, by Taylor's formula from the start (HOTINT)
  kPredicted,  ///< at the start values of the stage nearest to t0 + 0.6 h
  kEachStage,  ///< at the start values of each stage; coupled solvers only
};

/// The norm of errors. An error of norm 1 is one tolerance. y: the state, e: its error. The norm of Newton's increments
/// is always the root mean square.
enum class NormKind {
  kMixed,     ///< RMS of e_i / (atol scale_i + rtol |y_i|); accepted below 1
  kAbsolute,  ///< the paper's: 2-norm of e / atol over all components
};

/// The guards of a step: what is checked of a solved step besides its error estimate. Each finds what the estimate
/// cannot see, and can be left out to show what it buys and costs (core/options/guards.h, study `guards`).
enum class Guards {
  kAll,
  kNone,
  kWithoutDefect,        ///< no looks between the stages
  kWithoutSmoothness,    ///< `richardson`: 2^p - 1 divides also where the half steps do not show the order p
  kWithoutRestart,       ///< the first step after a restart need not follow the rates at its start
  kWithoutSwitchEffect,  ///< `ignore`, `iterate`, `smooth`: a step over a switch is judged by its estimate alone
};

/// One id of an axis, as it is written on the command line, in study files and in tables.
template <class E>
struct Named {
  E value;
  std::string_view id;
  std::string_view meaning;
};

/// All ids of an axis, the default first. Valid until a strategy is registered for the axis.
template <class E>
std::span<const Named<E>> named();

/// The value with this id. Throws Misuse for an unknown id; the message names the axis, the nearest id and all ids.
template <class E>
E parseId(std::string_view id);

/// The id of a value; "?" if the axis has no such value.
template <class E>
std::string_view idOf(E value) {
  if constexpr (requires { value.id; }) return value.id;
  for (const auto& entry : named<E>()) {
    if (entry.value == value) return entry.id;
  }
  return "?";
}

/// The name of the axis in options, files and messages: `newton`, `solver`, ...
template <class E>
std::string_view axisName();

// The table optionFields() in core/options/option_fields.cpp holds the legal values of all options, their meanings for
// users, and which ones have no effect beside others. A new member needs a line there.

/// Options of Newton's method.
struct NewtonOptions {
  NewtonKind kind = NewtonKind::kSimplified;
  /// `modified`, `full`: converged when eps(i) <= residual_tolerance eps(0), with eps = |R|_2. Paper (3.2). Fixed
  /// steps then go on to round-off, but not with `paper_rule`.
  double residual_tolerance = 1e-10;
  /// `modified`: the Jacobian is recomputed when the contraction exceeds this limit, ... Paper (3.4).
  double contractivity_limit = 0.7;
  /// ... after more than this many iterations.
  int contractivity_after = 3;
  /// A solve fails after this many iterations (`simplified`, `broyden` with fixed steps: four times as many). Paper,
  /// section 3: 25.
  int max_iterations = 25;
  /// `simplified`, `broyden`: converged when eta |dw| <= kappa in the error norm, HW II (IV.8.10). 0 means 0.01
  /// (with the estimate `richardson` a tenth of it, in index 3 another tenth), but not below 10 eps/rtol; from 1000
  /// accepted steps on it falls with their number, down to 10 eps/rtol.
  double kappa = 0;
  /// `simplified`, `broyden`: the Jacobian is kept for the next step while theta stays below this. Unless it is 0, a
  /// dense one of 40 unknowns and more is kept while theta stays below 0.1.
  double keep_jacobian_below = 1e-3;
};

/// Options of the step size and the error estimate. Sizes and times have the unit of the problem's t.
struct StepOptions {
  StepControl control = StepControl::kPredictive;
  ErrorEstimate estimate = ErrorEstimate::kRichardson;
  /// With control `fixed` the size of all steps, > 0; the last step is shortened to end at t_end. Otherwise the size of
  /// the first step; 0 means a size chosen from the scale of the solution.
  double h = 0;
  /// The integration fails below this size. 0 means 16 eps |t|, or the smallest positive number.
  double h_min = 0;
  double h_max = 1e300;
  /// The defect of the solution between the stages is looked at in this many points over the whole interval, at least
  /// one in each step (core/estimates/defect.h): an input that lasts longer than 2 / looks of the interval is not
  /// missed. At most 1000.
  std::int64_t looks = 100;
  /// The integration fails after this many attempted steps.
  std::int64_t max_steps = 1'000'000;
  /// Controls `paper` and `hotint`, paper (6.1)-(6.3): s_max = s_min^2; a step is kept unless it would change by
  /// `change_at_least`; it grows by at most `growth_at_most`.
  double s_min = 4;
  double change_at_least = 2;
  double growth_at_most = 5;
};

/// The error of component i counts relative to atol scale_i + rtol |y_i|; see NormKind.
struct Tolerances {
  double rtol = 1e-6;
  double atol = 1e-6;  ///< multiplied by the component's scale
  NormKind norm = NormKind::kMixed;

  /// That of a component of this magnitude with the value y: atol scale + rtol |y|; atol with NormKind::kAbsolute.
  double of(double scale, double y) const {
    return norm == NormKind::kAbsolute ? atol : atol * scale + rtol * std::abs(y);
  }
};

/// All options of an integration.
struct IntegratorOptions {
  Tolerances tolerances;
  DerivativeSource derivatives = DerivativeSource::kAutomatic;
  JacobianPoint jacobian_point = JacobianPoint::kStart;
  JacobianTerms jacobian = JacobianTerms::kFull;
  NewtonOptions newton;
  StageSolverKind solver = StageSolverKind::kSchur;
  /// Storage of the solvers `schur` and `eigen`; the ids of the coupled solvers name theirs.
  Storage storage = Storage::kAutomatic;
  /// Number of threads among which one integration is divided: stages, their linear systems, directions of a Jacobian,
  /// parts of long vectors. Results do not depend on it. Below 100 unknowns and inside a parallel region of the caller
  /// one thread is used, whatever the number is.
  int threads = 1;
  Predictor predictor = Predictor::kExtrapolated;
  Summation summation = Summation::kCompensated;
  Multipliers multipliers = Multipliers::kConsistent;
  OrderControl order = OrderControl::kFixed;
  Guards guards = Guards::kAll;
  StepOptions step;
  /// The name of a switch, or NAME:k: the integration ends as a success right behind the first, or k-th, switch of this
  /// name, and as no_event if t_end comes first. Empty: it ends at t_end.
  std::string stop_at = {};
  /// > 0: the integration ends as a success at the first step's end with |y_i'| <= steady max(|y_i|, scale_i) for all
  /// u, v and x, and as no_event if t_end comes first. In 1 / unit of t. 0: it ends at t_end.
  double steady = 0;
};

/// Throws Misuse for an option out of range; the message names field, value and range. core/integration/rules.h checks
/// which options work together.
void validate(const IntegratorOptions& options);

}  // namespace irk
