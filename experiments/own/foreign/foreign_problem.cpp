#include "experiments/own/foreign/foreign_problem.h"

#include <algorithm>
#include <limits>

#include "experiments/own/foreign/guarded.h"
#include "irk/misuse.h"
#include "irk/problem.h"

namespace irk::own {

template <int kIndex>
void ForeignProblem<kIndex>::switchingAt(const double* point, const double* d, double* g) const {
  const PointLayout& at = model->layout();
  const auto guard = model->lock();
  const int status = model->functions().switching(model->self(), point[0], at.yOf(point), at.wOf(point), d, g);
  if (status != 0) std::fill_n(g, model->sizes().switches, std::numeric_limits<double>::quiet_NaN());
}

template <int kIndex>
std::vector<double> ForeignProblem<kIndex>::times() const {
  if (model->timesCount() == 0) return {};
  GuardedNumbers times("irk_scene_times", "times", static_cast<std::size_t>(model->timesCount()));
  const auto guard = model->lock();
  model->functions().times(model->self(), times.data());
  times.requireWritten();
  return {times.values().begin(), times.values().end()};
}

template <int kIndex>
std::string ForeignProblem<kIndex>::switchName(Index i) const {
  if (!model->functions().switch_name) return std::to_string(i);
  GuardedText name("irk_scene_switch_name", std::to_string(i));
  const auto guard = model->lock();
  model->functions().switch_name(model->self(), static_cast<int>(i), name.data());
  return name.text();
}

// Switches are rare: what the function writes is checked each time.
template <int kIndex>
void ForeignProblem<kIndex>::discreteAfter(Index i, const double* point, Few<double>& d, Change* change,
                                           const char* name) const {
  const PointLayout& at = model->layout();
  GuardedNumbers next(name, "d", d.size(), {d.data(), d.size()});
  const auto guard = model->lock();
  change(model->self(), static_cast<int>(i), point[0], at.yOf(point), at.wOf(point), next.data());
  next.requireInside();
  std::copy(next.values().begin(), next.values().end(), d.begin());
}

template <int kIndex>
void ForeignProblem<kIndex>::moveTo(Jump* jump, const char* name, Index i, const Point<double>& p, double* u, double* v,
                                    double* x) const {
  const auto point = packed(model->layout(), p);
  const auto d = valuesOf(p.d);
  const auto count = static_cast<std::size_t>(model->layout().y);
  GuardedNumbers y(name, "y", count, {model->layout().yOf(point.data()), count});
  const auto guard = model->lock();
  jump(model->self(), static_cast<int>(i), point[0], y.data(), d.data());
  y.requireInside();
  const double* from = y.data();
  std::copy_n(from, p.u.size(), u);
  std::copy_n(from + p.u.size(), p.v.size(), v);
  std::copy_n(from + 2 * p.u.size(), p.x.size(), x);
}

template <int kIndex>
void ForeignProblem<kIndex>::jumpAtTime(Index i, const Point<double>& p, double* u, double* v, double* x) const {
  auto* const function = model->functions().jump_at_time;
  if (function) moveTo(function, "irk_scene_jump_at_time", i, p, u, v, x);
}

template <int kIndex>
bool ForeignProblem<kIndex>::completeStep(const Point<double>& p, double* u, double* v, double* x, double* d) const {
  const auto point = packed(model->layout(), p);
  Few<double> y(model->layout().yOf(point.data()), model->layout().wOf(point.data()));
  const auto guard = model->lock();
  if (!model->functions().complete_step(model->self(), point[0], y.data(), d)) return false;
  std::copy_n(y.data(), p.u.size(), u);
  std::copy_n(y.data() + p.u.size(), p.v.size(), v);
  std::copy_n(y.data() + 2 * p.u.size(), p.x.size(), x);
  return true;
}

template <int kIndex>
void JumpingForeignProblem<kIndex>::jump(Index i, const Point<double>& p, double* u, double* v, double* x) const {
  this->moveTo(this->model->functions().jump, "irk_scene_jump", i, p, u, v, x);
}

namespace {

template <class P>
std::shared_ptr<const System<double>> systemOf(const P& problem, const SystemOptions& options) {
  const auto& kinks = problem.model->kinks();
  auto system = std::make_shared<const ProblemSystem<P, double>>(problem, options, kinks);
  if (options.formulation == Formulation::kFirstOrder) return firstOrderForm<double>(system, MassFactors::kEachPoint);
  if (options.formulation == Formulation::kFirstOrderPerStep) {
    return firstOrderForm<double>(system, MassFactors::kEachStep);
  }
  return system;
}

template <int kIndex>
std::shared_ptr<const System<double>> systemOfIndex(const std::shared_ptr<const ForeignModel>& model,
                                                    const SystemOptions& options) {
  if (model->functions().jump) return systemOf(JumpingForeignProblem<kIndex>{{model}}, options);
  return systemOf(ForeignProblem<kIndex>{model}, options);
}

}  // namespace

std::shared_ptr<const System<double>> makeForeignSystem(const std::shared_ptr<const ForeignModel>& model,
                                                        const SystemOptions& options) {
  if (options.formulation == Formulation::kGgl && model->sizes().constraints > 0) {
    throw Misuse(
        "formulation 'ggl': it needs derivatives of g that a scene in a shared library does not give; index3, index2, "
        "index2_projected and index1 are possible");
  }
  return model->algebraicIndex() == 2 ? systemOfIndex<2>(model, options) : systemOfIndex<1>(model, options);
}

}  // namespace irk::own
