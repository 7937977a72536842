#include "core/options/option_fields.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>

#include "core/options/fixed_steps.h"
#include "core/options/guards.h"

namespace irk {
namespace {

constexpr std::int64_t kMaxAttempts = 1'000'000'000'000;
constexpr std::int64_t kMaxNewtonIterations = 1000, kMaxThreads = 1024, kMaxLooks = 1000;

using Options = IntegratorOptions;
constexpr std::size_t kNested = 3;  // tolerances, newton, step
constexpr std::size_t kOptions = memberCount<IntegratorOptions>() - kNested + memberCount<Tolerances>() +
                                 memberCount<NewtonOptions>() + memberCount<StepOptions>();

// Returns the reason why an option has no effect beside the others; empty if it has an effect.
using Unused = std::string_view (*)(const Options&);

OptionField axis(auto member, std::string meaning, Unused unused = nullptr) {
  auto field = axisField<Options>(std::move(meaning), member);
  if (unused) field.unused = unused;
  return field;
}

OptionField number(std::string name, auto member, const Range& range, std::string meaning, Unused unused = nullptr) {
  auto field = numberField<Options>(std::move(name), std::move(meaning), range, member);
  if (unused) field.unused = unused;
  return field;
}

// In the text of a run ';' separates fields: the name of a switch must not contain it.
OptionField stopField() {
  return {.name = "stop_at",
          .meaning = "The integration ends as a success right behind this switch, or behind the k-th of this name.",
          .form = "NAME or NAME:k, a switch of the scene",
          .get = [](const Options& o) { return o.stop_at; },
          .set =
              [](Options& o, std::string_view text) {
                if (text.find_first_of(";\n") != text.npos) {
                  throw Misuse("stop_at = '" + std::string(text) + "': ';' is not allowed here");
                }
                o.stop_at = text;
              }};
}

bool isModified(const Options& o) {
  static constexpr std::string_view kIds[] = {"modified", "modified_only", "paper_rule", "modified_each_step",
                                              "modified_step_change"};
  return std::find(std::begin(kIds), std::end(kIds), o.newton.kind.id) != std::end(kIds);
}
bool reusesByStep(const Options& o) {
  return o.newton.kind.id == "broyden_each_step" || o.newton.kind.id == "broyden_step_change";
}
bool stopsByResidual(const Options& o) { return isModified(o) || o.newton.kind == NewtonKind::kFull; }
bool isPaperControl(const Options& o) {
  return o.step.control == StepControl::kPaper || o.step.control.id == "paper_no_gamma";
}
std::string_view noTolerance(const Options& o) { return hasFixedSteps(o.step) ? "fixed steps have no tolerance" : ""; }
std::string_view noEstimate(const Options& o) {
  const bool asked = o.step.estimate != ErrorEstimate::kNone;
  return hasFixedSteps(o.step) && asked ? "fixed steps have no error estimate" : "";
}
std::string_view noChosenStep(const Options& o) { return hasFixedSteps(o.step) ? "fixed steps all have one size" : ""; }
std::string_view noLooks(const Options& o) {
  if (hasFixedSteps(o.step)) return "fixed steps have no error estimate";
  return has(o.guards, Guard::kDefect) ? "" : "the guard of the defect is left out";
}
std::string_view ofIncrementTest(const Options& o) {
  return stopsByResidual(o) ? "it belongs to newton 'simplified', 'broyden' and its variants" : "";
}
std::string_view ofContraction(const Options& o) {
  return reusesByStep(o) ? "the Jacobian is kept by rule, whatever the contraction is" : ofIncrementTest(o);
}
std::string_view ofKappa(const Options& o) {
  return hasFixedSteps(o.step) ? "with fixed steps Newton's method iterates to round-off" : ofIncrementTest(o);
}
std::string_view ofResidualTest(const Options& o) {
  return stopsByResidual(o) ? "" : "it belongs to newton 'modified', its variants, and 'full'";
}
std::string_view ofModifiedNewton(const Options& o) {
  return isModified(o) ? "" : "it belongs to newton 'modified' and its variants";
}
std::string_view ofPaperControl(const Options& o) {
  return isPaperControl(o) ? "" : "it belongs to control 'paper' and 'paper_no_gamma'";
}
std::string_view ofPaperControls(const Options& o) {
  const bool used = isPaperControl(o) || o.step.control == StepControl::kHotint;
  return used ? "" : "it belongs to control 'paper', 'paper_no_gamma' and 'hotint'";
}

}  // namespace

#define IRK_MEMBER(path) \
  [](auto& o) -> auto& { return o.path; }

std::span<const OptionField> optionFields() {
  static const auto fields = std::to_array<OptionField>({
      axis(IRK_MEMBER(derivatives), "How the derivatives in Jacobians are computed."),
      axis(IRK_MEMBER(newton.kind), "Newton's method: when it stops and when its matrix is renewed."),
      axis(IRK_MEMBER(solver), "How the linear systems of all stages are solved."),
      axis(IRK_MEMBER(storage), "How the solvers schur and eigen store their matrices."),
      axis(IRK_MEMBER(predictor), "Start values of the stages."),
      axis(IRK_MEMBER(step.estimate), "How the error of a step is estimated.", noEstimate),
      axis(IRK_MEMBER(step.control), "How the step size is chosen."),
      axis(IRK_MEMBER(order), "Whether the number of stages stays the same or follows the cost."),
      axis(IRK_MEMBER(summation), "How the increments of steps are added up."),
      axis(IRK_MEMBER(multipliers), "Accelerations and multipliers at the end of the integration."),
      axis(IRK_MEMBER(tolerances.norm), "The norm of errors.", noTolerance),
      axis(IRK_MEMBER(jacobian), "Which terms of the Jacobian are left out."),
      axis(IRK_MEMBER(jacobian_point), "Where in a step the Jacobian is evaluated."),
      axis(IRK_MEMBER(guards), "What is checked of a step besides its error estimate.", noEstimate),
      number("residual_tolerance", IRK_MEMBER(newton.residual_tolerance), Range::above(0).below(1),
             "Newton's method stops when the residual has fallen to this part of its first value.", ofResidualTest),
      number("contractivity_limit", IRK_MEMBER(newton.contractivity_limit), Range::above(0).to(1),
             "The Jacobian is computed anew when an iteration leaves more than this part of the residual.",
             ofModifiedNewton),
      number("contractivity_after", IRK_MEMBER(newton.contractivity_after), Range::integers(0, kMaxNewtonIterations),
             "Iterations before contractivity_limit applies.", ofModifiedNewton),
      number("max_iterations", IRK_MEMBER(newton.max_iterations), Range::integers(1, kMaxNewtonIterations),
             "Newton's method fails after this many iterations."),
      number("keep_jacobian_below", IRK_MEMBER(newton.keep_jacobian_below), Range::from(0).below(1),
             "The Jacobian is kept for the next step while Newton's method contracts by less than this factor (unless "
             "it is 0, a dense one of 40 unknowns and more by less than 0.1).",
             ofContraction),
      number("kappa", IRK_MEMBER(newton.kappa), Range::from(0),
             "Newton's method stops when its error falls below this part of the tolerance; 0 = by the estimate, "
             "round-off and the number of steps.",
             ofKappa),
      number("looks", IRK_MEMBER(step.looks), Range::integers(1, kMaxLooks),
             "Points over the interval at which the defect between the stages is looked at.", noLooks),
      number("h", IRK_MEMBER(step.h), Range::from(0),
             "The constant step of control fixed, else the first step; 0 = by the scale of the solution."),
      number("h_min", IRK_MEMBER(step.h_min), Range::from(0),
             "The integration fails below this step size; 0 = at round-off.", noChosenStep),
      number("h_max", IRK_MEMBER(step.h_max), Range::above(0), "The largest step size.", noChosenStep),
      number("s_min", IRK_MEMBER(step.s_min), Range::above(1),
             "Safety factor of the paper's step control, equation (6.1).", ofPaperControl),
      number("change_at_least", IRK_MEMBER(step.change_at_least), Range::above(1),
             "The step size is kept unless it would change by this factor.", ofPaperControls),
      number("growth_at_most", IRK_MEMBER(step.growth_at_most), Range::above(1),
             "The step size grows at most by this factor.", ofPaperControls),
      number("rtol", IRK_MEMBER(tolerances.rtol), Range::from(0),
             "Tolerance of a step's error relative to the solution.", noTolerance),
      number("atol", IRK_MEMBER(tolerances.atol), Range::above(0),
             "Tolerance of a step's error relative to the scale of the component.", noTolerance),
      number("max_steps", IRK_MEMBER(step.max_steps), Range::integers(1, kMaxAttempts),
             "The integration fails after this many attempted steps."),
      stopField(),
      number("steady", IRK_MEMBER(steady), Range::from(0),
             "The integration ends as a success where all rates are below this part of the components; 0 = at t_end."),
      number("threads", IRK_MEMBER(threads), Range::integers(1, kMaxThreads),
             "Threads inside one integration; the numbers do not depend on it. Below 100 unknowns one is taken."),
  });
  static_assert(std::tuple_size_v<decltype(fields)> == kOptions, "an option has no line in the table above");
  return fields;
}
#undef IRK_MEMBER

void validate(const IntegratorOptions& o) {
  IntegratorOptions known;  // setting an unknown id in it throws
  for (const auto& field : optionFields()) {
    if (field.isNumeric()) requireInRange(field.name, field.number(o), field.range);
    if (field.kind == FieldKind::kAxis) field.set(known, field.get(o));
  }
  if (hasFixedSteps(o.step) && o.step.h == 0)
    throw Misuse("illegal combination: control 'fixed' with h = 0: fixed steps need h > 0");
}

}  // namespace irk
