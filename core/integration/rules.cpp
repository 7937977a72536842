#include "core/integration/rules.h"

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/threads.h"
#include "core/control/controller.h"
#include "core/control/order_controller.h"
#include "core/derivatives/differentiator.h"
#include "core/derivatives/first_order.h"
#include "core/estimates/step_attempt.h"
#include "core/newton/newton.h"
#include "core/options/fixed_steps.h"
#include "core/steps/modes.h"

namespace irk {
namespace {

/// A strategy that an option names.
struct Chosen {
  std::string_view axis, id;
  const Needs& needs;
};

std::string text(std::string_view axis, std::string_view id) {
  return std::string(axis) + " '" + std::string(id) + "'";
}
std::string text(const Chosen& strategy) { return text(strategy.axis, strategy.id); }

/// The facts that the rules use.
struct Facts {
  explicit Facts(const IntegratorOptions& o)
      : options(o),
        newton(catalogue<NewtonKind>()[o.newton.kind]),
        solver(catalogue<StageSolverKind>()[o.solver]),
        estimate(catalogue<ErrorEstimate>()[o.step.estimate]),
        control(catalogue<StepControl>()[o.step.control]),
        order(catalogue<OrderControl>()[o.order]),
        predictor(catalogue<Predictor>()[o.predictor]),
        jacobian(catalogue<JacobianTerms>()[o.jacobian]),
        chosen{{{"newton", newton.id.id, newton.needs},
                {"solver", solver.id.id, solver.needs},
                {"estimate", estimate.id.id, estimate.needs},
                {"control", control.id.id, control.needs},
                {"order", order.id.id, order.needs},
                {"predictor", predictor.id.id, predictor.needs},
                {"jacobian", jacobian.id.id, jacobian.needs}}} {}

  /// The first strategy with this need; null if there is none.
  const Chosen* whoNeeds(bool Needs::*need) const {
    for (const Chosen& one : chosen) {
      if (one.needs.*need) return &one;
    }
    return nullptr;
  }

  const IntegratorOptions& options;
  const Strategy<NewtonKind>& newton;
  const Strategy<StageSolverKind>& solver;
  const Strategy<ErrorEstimate>& estimate;
  const Strategy<StepControl>& control;
  const Strategy<OrderControl>& order;
  const Strategy<Predictor>& predictor;
  const Strategy<JacobianTerms>& jacobian;
  std::array<Chosen, 7> chosen;
  // Of the method.
  std::string method;
  bool invertible = true, determines_algebraic = true, has_weights = false;
  int stage_order = 1;
  std::size_t members = 1, start = 0;
  // Of the system.
  Index algebraic = 0;
  bool second_order = true, one_thread = false, multiprecision = false;
  std::string not_made;  // a strategy that does not exist in its scalar

  bool eachStage() const { return options.jacobian_point == JacobianPoint::kEachStage; }
};

/// One rule: whether a combination breaks it, and the message with both ids and the reason.
struct Rule {
  bool (*broken)(const Facts&);
  std::string (*message)(const Facts&);
};

void require(std::span<const Rule> rules, const Facts& facts) {
  for (const Rule& rule : rules) {
    if (rule.broken(facts)) throw Misuse("illegal combination: " + rule.message(facts));
  }
}

std::string instead(const Chosen* strategy) {
  return strategy->needs.instead.empty() ? "" : "; use " + std::string(strategy->needs.instead);
}

constexpr Rule kOptions[] = {
    {[](const Facts& f) {
       const Storage asked = f.options.storage, own = f.solver.storage;
       return own != Storage::kAutomatic && asked != Storage::kAutomatic && asked != own;
     },
     [](const Facts& f) {
       return text("solver", f.solver.id.id) + " with " + text("storage", idOf(f.options.storage));
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::estimate) && !f.estimate.estimates; },
     [](const Facts& f) {
       return text(*f.whoNeeds(&Needs::estimate)) + " with " + text("estimate", f.estimate.id.id) +
              ": a step controller needs an error estimate";
     }},
};

constexpr Rule kSystemsAndMethods[] = {
    {[](const Facts& f) { return f.start >= f.members || (f.members != 1 && !f.order.make); },
     [](const Facts& f) {
       return text("order", f.order.id.id) + " with " + std::to_string(f.members) + " methods, starting with number " +
              std::to_string(f.start) + ": several need order 'variable'";
     }},
    {[](const Facts& f) { return f.algebraic > 0 && !f.determines_algebraic; },
     [](const Facts& f) {
       return text("method", f.method) + " with a system of " + std::to_string(f.algebraic) +
              " algebraic unknowns: A is singular, the stages do not determine them";
     }},
    {[](const Facts& f) { return !f.solver.coupled && (f.eachStage() || f.whoNeeds(&Needs::coupled_solver)); },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::coupled_solver);
       return (who ? text(*who) : "jacobian_point 'each_stage'") + " with " + text("solver", f.solver.id.id) +
              ": stage-wise derivatives do not decouple; use solver 'coupled_dense' or 'coupled_sparse'";
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::kept_jacobian) && !f.newton.keeps_jacobian; },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::kept_jacobian);
       return text("newton", f.newton.id.id) + " with " + text(*who) + ": the " + std::string(who->axis) +
              " filters with the kept Jacobian, and '" + std::string(f.newton.id.id) + "' keeps none" + instead(who);
     }},
    {[](const Facts& f) { return f.options.threads > 1 && f.one_thread; },
     [](const Facts& f) {
       return "threads = " + std::to_string(f.options.threads) +
              " with formulation 'first_order': it keeps factors, one thread at a time";
     }},
    {[](const Facts& f) {
       return f.whoNeeds(&Needs::embedded_estimate) && (!f.estimate.compares_orders || f.eachStage());
     },
     [](const Facts& f) {
       return text(*f.whoNeeds(&Needs::embedded_estimate)) + " with " +
              (f.eachStage() ? "jacobian_point 'each_stage'" : text("estimate", f.estimate.id.id)) +
              ": orders are compared by the embedded estimate with one Jacobian; use estimate 'embedded' and another "
              "jacobian_point";
     }},
    {[](const Facts& f) { return f.options.jacobian != JacobianTerms::kFull && !f.second_order; },
     [](const Facts& f) {
       return text("jacobian", idOf(f.options.jacobian)) +
              " with formulation 'ggl' or 'first_order': its accelerations are no unknowns of their own";
     }},
    {[](const Facts& f) { return f.multiprecision && storageOf(f.options) == Storage::kSparse; },
     [](const Facts&) { return std::string("storage 'sparse' in multiprecision: KLU is for double"); }},
    {[](const Facts& f) { return !f.not_made.empty(); },
     [](const Facts& f) {
       return f.not_made + (f.multiprecision ? " in multiprecision" : " in double") +
              ": it is not made for this scalar";
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::invertible_matrix) && !f.invertible; },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::invertible_matrix);
       return text(*who) + " with " + text("method", f.method) + ": its A is singular" + instead(who);
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::embedded_weights) && !f.has_weights; },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::embedded_weights);
       return text(*who) + " with " + text("method", f.method) +
              ": it has no embedded weights, a block 'b_hat' of a tableau file" + instead(who);
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::embedded_weights) && !f.determines_algebraic; },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::embedded_weights);
       return text(*who) + " with " + text("method", f.method) +
              ": its A is singular, also without an explicit first stage" + instead(who);
     }},
    {[](const Facts& f) { return f.whoNeeds(&Needs::stage_order) && f.stage_order < 1; },
     [](const Facts& f) {
       const Chosen* const who = f.whoNeeds(&Needs::stage_order);
       return text(*who) + " with " + text("method", f.method) +
              ": its stage order is 0, so that step and estimate miss the same forces where these change with time" +
              instead(who);
     }},
};

template <class Real>
void describe(const Tableau<Real>& tableau, const Structure<Real>& structure, Facts& facts) {
  facts.method = tableau.id;
  facts.determines_algebraic = structure.allowsAlgebraic();
  facts.invertible = structure.regular && structure.first == 0;
  facts.stage_order = tableau.stage_order;
  facts.has_weights = tableau.b_hat.size() > 0;
}

template <class Real>
void describe(const System<Real>& system, Facts& facts) {
  facts.algebraic = system.sizes().nz;
  facts.second_order = system.secondOrder();
  facts.one_thread = dynamic_cast<const FirstOrderForm<Real>*>(&system) != nullptr;
  facts.multiprecision = !std::is_same_v<Real, double>;
  const auto isMade = [](const auto& strategy) { return bool(strategy.make.template of<Real>()); };
  if (!isMade(facts.newton)) facts.not_made = text("newton", facts.newton.id.id);
  if (!isMade(facts.solver)) facts.not_made = text("solver", facts.solver.id.id);
  if (!isMade(facts.estimate)) facts.not_made = text("estimate", facts.estimate.id.id);
  if (!isMade(facts.predictor)) facts.not_made = text("predictor", facts.predictor.id.id);
}

}  // namespace

void requireLegal(const IntegratorOptions& options) { require(kOptions, Facts(options)); }

template <class Real>
void requireLegal(const IntegratorOptions& options, const System<Real>& system, const SchemeList<Real>& schemes,
                  std::size_t start) {
  Facts facts(options);
  facts.members = schemes.size();
  facts.start = start;
  describe(system, facts);
  if (schemes.size() == 0) require(kSystemsAndMethods, facts);
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    describe(schemes.tableau(i), schemes.structure(i), facts);
    require(kSystemsAndMethods, facts);
  }
}

template <class Real>
IntegratorOptions legalOptions(IntegratorOptions options, const System<Real>& system, const SchemeList<Real>& schemes,
                               std::size_t start) {
  validate(options);
  requireLegal(options);
  if (hasFixedSteps(options.step)) {
    options.step.estimate = ErrorEstimate::kNone;
    options.tolerances = {1, 1, NormKind::kMixed};
    options.newton.kappa = std::numeric_limits<double>::min();
  }
  requireLegal(options, system, schemes, start);
  if (system.sizes().n() < kThreadsFrom) options.threads = 1;
  return options;
}

template void requireLegal(const IntegratorOptions&, const System<double>&, const SchemeList<double>&, std::size_t);
template void requireLegal(const IntegratorOptions&, const System<BigFloat>&, const SchemeList<BigFloat>&, std::size_t);
template IntegratorOptions legalOptions(IntegratorOptions, const System<double>&, const SchemeList<double>&,
                                        std::size_t);
template IntegratorOptions legalOptions(IntegratorOptions, const System<BigFloat>&, const SchemeList<BigFloat>&,
                                        std::size_t);

}  // namespace irk
