#include "experiments/ensembles/ensemble_run.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/text.h"
#include "core/ensemble/lane_rules.h"
#include "experiments/base/clock.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/setup.h"
#include "irk/integrator.h"
#include "irk/scene_file.h"
#include "irk/scene_lanes.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

void refuse(const std::string& what, const std::string& instead) {
  throw Misuse("an ensemble with " + what + ": " + instead);
}

void requireSpec(const RunSpec& spec) {
  if (findPeer(spec.method)) refuse("method '" + spec.method + "'", "it has Runge-Kutta methods only");
  if (!spec.scalar.isDouble()) refuse("scalar '" + idOf(spec.scalar) + "'", "it is in double");
  if (spec.options.threads > 1) refuse("threads", "--jobs says how many members are integrated at a time");
  if (spec.time_limit > 0) refuse("time_limit", "use max_steps");
  if (spec.reference != ReferenceUse::kNone || spec.reference_times > 1) refuse("references", "it has no errors");
  if (spec.constraints != ConstraintUse::kAll) refuse("constraints 'independent'", "leave them out in the scene");
  if (spec.formulation == Formulation::kFirstOrder || spec.formulation == Formulation::kFirstOrderPerStep) {
    refuse("formulation 'first_order'", "its systems cannot be shared by threads");
  }
}

}  // namespace

EnsembleScene::EnsembleScene(const RunSpec& spec, Grid grid, double t_end)
    : spec_(spec),
      entry_(findScene(spec.scene)),
      system_options_{spec.formulation, spec.scaling, spec.discontinuity},
      grid_(std::move(grid)),
      t_end_(t_end) {
  requireSpec(spec);
  static_cast<void>(everyValue());
  first_ = sceneOf(0);
  const State<double>& start = first_.start;
  const Index known = 2 * start.u.size() + start.x.size();
  const std::vector<std::string> names(first_.names.begin(), first_.names.begin() + known);
  for (const GridAxis& axis : grid_.starts()) {
    const auto at = std::find(names.begin(), names.end(), axis.name);
    if (at == names.end()) throw Misuse("--start: " + unknownName("component of u, v, x", axis.name, names));
    start_components_.push_back(at - names.begin());
    for (const std::string& value : axis.values) parseNumber("--start " + axis.name, value, kAnyNumber);
  }
  if (grid_.parameters().empty()) system_ = first_.system(system_options_);
}

Settings EnsembleScene::settingsOf(std::size_t i) const {
  Settings settings = spec_.settings;
  const auto values = grid_.at(i);
  for (std::size_t k = 0; k < grid_.parameters().size(); ++k) settings[grid_.parameters()[k].name] = values[k];
  return completedSettings(entry_.id, entry_.parameters, settings);
}

Scene<double> EnsembleScene::sceneOf(std::size_t i) const { return makeScene<double>(entry_, settingsOf(i)); }

void EnsembleScene::setStart(std::size_t i, State<double>& start) const {
  const auto values = grid_.at(i);
  const Index nu = start.u.size();
  for (std::size_t k = 0; k < start_components_.size(); ++k) {
    const Index at = start_components_[k];
    double& y = at < nu ? start.u[at] : at < 2 * nu ? start.v[at - nu] : start.x[at - 2 * nu];
    y = parseNumber("--start", values[grid_.parameters().size() + k], kAnyNumber);
  }
}

EnsembleMember EnsembleScene::member(std::size_t i) const {
  const auto make = [&](const Scene<double>& scene, std::shared_ptr<const System<double>> system) {
    EnsembleMember member{std::move(system), scene.start, std::isnan(t_end_) ? scene.t_end : t_end_};
    requireInTables(scene, member.t_end);
    member.scale = toleranceScale(scene, spec_, member.system->sizes());
    setStart(i, member.start);
    return member;
  };
  if (system_) return make(first_, system_);
  const Scene<double> scene = sceneOf(i);
  return make(scene, scene.system(system_options_));
}

// Settings in which each value of each axis occurs.
std::vector<Settings> EnsembleScene::everyValue() const {
  std::vector<Settings> all{settingsOf(0)};
  for (const GridAxis& axis : grid_.parameters()) {
    for (const std::string& value : axis.values) {
      Settings settings = all.front();
      settings[axis.name] = value;
      all.push_back(completedSettings(entry_.id, entry_.parameters, settings));
    }
  }
  return all;
}

Ensemble EnsembleScene::lanes() const {
  requireLanes(entry_, everyValue());
  requireLaneMember({first_.system(system_options_), first_.start}, nullptr);
  Ensemble ensemble;
  ensemble.member = [this](std::size_t i) { return member(i); };
  if (system_) {
    const std::vector<Settings> same(kLanes, settingsOf(0));
    ensemble.lanes = [system = makeLanes(entry_, same, system_options_)](const auto&) { return system; };
  } else {
    ensemble.lanes = [this](const std::array<std::size_t, kLanes>& at) {
      std::vector<Settings> settings;
      settings.reserve(at.size());
      for (const std::size_t i : at) settings.push_back(settingsOf(i));
      return makeLanes(entry_, settings, system_options_);
    };
  }
  return ensemble;
}

namespace {

/// Hands out members to threads and collects their results.
class Work {
 public:
  Work(const EnsembleScene& scene, const RunSpec& spec, const EnsembleOptions& options,
       const LaneIntegrator::Done& done)
      : scene_(scene), spec_(spec), options_(options), done_(done), tableau_(makeTableau<double>(spec.method)) {
    if (options.lanes) ensemble_ = scene.lanes();
  }

  // One thread's part.
  void take() {
    const double begin = threadSeconds();
    try {
      options_.lanes ? inLanes() : alone();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      next_ = scene_.grid().size();
    }
    const std::lock_guard lock(mutex_);
    cpu_ += threadSeconds() - begin;
  }
  double finish() const {
    if (error_) std::rethrow_exception(error_);
    return cpu_;
  }

 private:
  bool stopped() const { return options_.stop && *options_.stop; }
  Outcome stop() const { return stopped() ? Outcome::kInterrupted : Outcome::kSuccess; }
  std::optional<std::size_t> next() {
    const std::size_t i = stopped() ? scene_.grid().size() : next_++;
    return i < scene_.grid().size() ? std::optional(i) : std::nullopt;
  }
  void report(std::size_t i, Solution<double> solution) {
    const std::lock_guard lock(mutex_);
    done_(i, std::move(solution));
  }
  void inLanes() {
    LaneIntegrator integrator(tableau_, spec_.options);
    integrator.integrate(
        ensemble_, [this] { return next(); },
        [this](std::size_t i, Solution<double> solution) { report(i, std::move(solution)); },
        [this] { return stop(); });
  }
  void alone() {
    Monitor<double> monitor;
    monitor.interrupt = [this] { return stop(); };
    while (const auto i = next()) {
      const EnsembleMember member = scene_.member(*i);
      Integrator<double> integrator(member.system, tableau_, spec_.options, member.scale);
      report(*i, integrator.integrate(member.start, member.t_end, monitor));
    }
  }

  const EnsembleScene& scene_;
  const RunSpec& spec_;
  const EnsembleOptions& options_;
  const LaneIntegrator::Done& done_;
  Tableau<double> tableau_;
  Ensemble ensemble_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
  double cpu_ = 0;
};

}  // namespace

double runEnsemble(const EnsembleScene& scene, const RunSpec& spec, const EnsembleOptions& options,
                   const LaneIntegrator::Done& done) {
  refuseFamilyOfFixedOrder(spec);
  Work work(scene, spec, options, done);
  std::vector<std::thread> others;
  for (int i = 1; i < options.jobs; ++i) others.emplace_back([&work] { work.take(); });
  work.take();
  for (std::thread& other : others) other.join();
  return work.finish();
}

}  // namespace irk
