// Newton methods that keep or renew their Jacobian by a fixed rule, whatever the contraction is. They measure what the
// reuse of Jacobians gains.
#include <optional>
#include <utility>

#include "core/newton/newton.h"
#include "irk/multiprecision.h"

namespace irk {

// The methods that are wrapped.
Strategy<NewtonKind> modifiedNewton();
Strategy<NewtonKind> broydenNewton();

namespace {

enum class Reuse {
  kNever,  ///< each attempted step begins with a new Jacobian
  /// each attempted step begins with a new Jacobian, unless its size differs from that of the attempt before
  kAcrossStepChange,
};

/// Decides by a rule whether another Newton method keeps its Jacobian. As usual, a solve that does not converge with a
/// kept Jacobian begins again with a new one. Half steps keep the Jacobian of their attempt.
template <class Real>
class ReuseByStep final : public Newton<Real> {
 public:
  ReuseByStep(std::unique_ptr<Newton<Real>> inner, Reuse reuse) : inner_(std::move(inner)), reuse_(reuse) {}

  NewtonResult solve(NewtonContext<Real>& context, Mat<Real>& W) override {
    if (context.use == JacobianUse::kKeep) return inner_->solve(context, W);
    NewtonContext<Real> own = context;
    const Real h = context.eq.h();
    const bool changed = last_h_ && *last_h_ != h;
    last_h_ = h;
    if (reuse_ == Reuse::kAcrossStepChange && changed) {
      own.use = JacobianUse::kKeep;
    } else {
      context.matrix.shared().markStale();
    }
    return inner_->solve(own, W);
  }
  // Keeps the last step size: after a switch there is no shared Jacobian, and a new one is evaluated anyway.
  void forget() override { inner_->forget(); }

 private:
  std::unique_ptr<Newton<Real>> inner_;
  Reuse reuse_;
  std::optional<Real> last_h_;
};

template <class Real>
NewtonMaker<Real> reusing(const NewtonMaker<Real>& inner, Reuse reuse) {
  return [inner, reuse](const IntegratorOptions& options, const Sizes& sizes,
                        const Scheme<Real>& scheme) -> std::unique_ptr<Newton<Real>> {
    return std::make_unique<ReuseByStep<Real>>(inner(options, sizes, scheme), reuse);
  };
}

Strategy<NewtonKind> withReuse(Strategy<NewtonKind> method, std::string_view id, Reuse reuse, std::string meaning) {
  method.id = {{id}};
  method.meaning = std::move(meaning);
  method.make = {reusing(method.make.in_double, reuse), reusing(method.make.in_big_float, reuse)};
  return method;
}

Strategy<NewtonKind> eachStep(Strategy<NewtonKind> method, std::string_view id, const std::string& whose) {
  return withReuse(std::move(method), id, Reuse::kNever, whose + " with a new Jacobian in every step");
}

Strategy<NewtonKind> atStepChange(Strategy<NewtonKind> method, std::string_view id, const std::string& whose) {
  return withReuse(std::move(method), id, Reuse::kAcrossStepChange,
                   whose + " with a Jacobian that is kept only where the step size changes");
}

}  // namespace

Strategy<NewtonKind> modifiedNewtonEachStep() { return eachStep(modifiedNewton(), "modified_each_step", "modified"); }
Strategy<NewtonKind> modifiedNewtonAtStepChange() {
  return atStepChange(modifiedNewton(), "modified_step_change", "modified");
}
Strategy<NewtonKind> broydenNewtonEachStep() { return eachStep(broydenNewton(), "broyden_each_step", "broyden"); }
Strategy<NewtonKind> broydenNewtonAtStepChange() {
  return atStepChange(broydenNewton(), "broyden_step_change", "broyden");
}

}  // namespace irk
