#include "experiments/ensembles/ensemble_run.h"

#include <memory>
#include <mutex>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/runs/setup.h"
#include "irk/scene_file.h"

namespace irk {
namespace {

void refuse(const std::string& what, const std::string& instead) {
  throw Misuse("an ensemble with " + what + ": " + instead);
}

void requireSpec(const RunSpec& spec, const Grid& grid) {
  if (spec.options.threads > 1) refuse("threads", "--jobs says how many members are integrated at a time");
  if (spec.reference != ReferenceUse::kNone || spec.reference_times > 1) refuse("references", "it has no errors");
  if (spec.constraints != ConstraintUse::kAll && !grid.starts().empty()) {
    refuse("--start and constraints 'independent'", "they are chosen at the scene's own start");
  }
}

}  // namespace

Ensemble::Ensemble(RunSpec spec, Grid grid) : spec_(std::move(spec)), grid_(std::move(grid)) {
  requireSpec(spec_, grid_);
  requireValues();
  names_ = sceneOf<double>(this->spec(0)).names;
  prepare(this->spec(0))->startFrom(start(0));
}

RunSpec Ensemble::spec(std::size_t i) const {
  RunSpec spec = spec_;
  const auto values = grid_.at(i);
  for (std::size_t k = 0; k < grid_.parameters().size(); ++k) spec.settings[grid_.parameters()[k].name] = values[k];
  return spec;
}

Settings Ensemble::start(std::size_t i) const {
  Settings start;
  const auto values = grid_.at(i);
  const std::size_t first = grid_.parameters().size();
  for (std::size_t k = 0; k < grid_.starts().size(); ++k) start[grid_.starts()[k].name] = values[first + k];
  return start;
}

// Each value of each axis, so that no long computation ends at a mistyped value.
void Ensemble::requireValues() const {
  const SceneEntry& entry = findScene(spec_.scene);
  RunSpec spec = this->spec(0);
  const auto require = [&] { static_cast<void>(completedSettings(entry.id, entry.parameters, settingsAtStep(spec))); };
  require();
  for (const GridAxis& axis : grid_.parameters()) {
    const std::string first = spec.settings[axis.name];
    for (const std::string& value : axis.values) {
      spec.settings[axis.name] = value;
      require();
    }
    spec.settings[axis.name] = first;
  }
  for (const GridAxis& axis : grid_.starts()) {
    for (const std::string& value : axis.values) parseNumber("--start " + axis.name, value, kAnyNumber);
  }
}

namespace {

/// What a thread has made last, and for which combination of parameters.
struct Prepared {
  std::unique_ptr<PreparedRun> run;
  std::size_t parameters = 0;
};

RunRecord executeMember(const Ensemble& ensemble, std::size_t i, const Watch& watch, Prepared& prepared) {
  const std::size_t parameters = ensemble.grid().parametersOf(i);
  if (!prepared.run || prepared.parameters != parameters) {
    prepared.run = nullptr;
    prepared = {prepare(ensemble.spec(i)), parameters};
  }
  if (!ensemble.grid().starts().empty()) prepared.run->startFrom(ensemble.start(i));
  return prepared.run->execute(watch);
}

}  // namespace

double runEnsemble(const Ensemble& ensemble, int jobs, const std::atomic<bool>& stop, const MemberDone& done) {
  Watch watch;
  watch.stop = &stop;
  std::mutex mutex;
  ParallelLoop loop;
  double cpu = 0;
#pragma omp parallel num_threads(jobs) reduction(+ : cpu)
  {
    const double begin = threadSeconds();
    Prepared prepared;
#pragma omp for schedule(dynamic, 1) nowait
    for (std::size_t i = 0; i < ensemble.grid().size(); ++i) {
      loop.turn(i, [&] {
        if (stop) return;
        const auto record = asRow(ensemble.spec(i), [&] { return executeMember(ensemble, i, watch, prepared); });
        const std::lock_guard lock(mutex);
        done(i, record);
      });
    }
    cpu += threadSeconds() - begin;
  }
  loop.rethrow();
  return cpu;
}

}  // namespace irk
