#include "experiments/ensembles/ensemble_run.h"

#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/base/number_text.h"
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

/// Hands out members to threads and collects their records.
class Work {
 public:
  Work(const Ensemble& ensemble, const std::atomic<bool>& stop, const MemberDone& done)
      : ensemble_(ensemble), done_(done), stop_(stop) {
    watch_.stop = &stop;
  }

  // One thread's part.
  void take() {
    const double begin = threadSeconds();
    try {
      Prepared prepared;
      while (const auto i = next()) {
        const RunRecord record = orRefused(ensemble_.spec(*i), [&] { return execute(*i, prepared); });
        const std::lock_guard lock(mutex_);
        done_(*i, record);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      next_ = ensemble_.grid().size();
    }
    const std::lock_guard lock(mutex_);
    cpu_ += threadSeconds() - begin;
  }
  double finish() const {
    if (error_) std::rethrow_exception(error_);
    return cpu_;
  }

 private:
  /// What a thread has made last, and for which combination of parameters.
  struct Prepared {
    std::unique_ptr<PreparedRun> run;
    std::size_t parameters = 0;
  };

  std::optional<std::size_t> next() {
    const std::size_t i = stop_ ? ensemble_.grid().size() : next_++;
    return i < ensemble_.grid().size() ? std::optional(i) : std::nullopt;
  }
  RunRecord execute(std::size_t i, Prepared& prepared) const {
    const std::size_t parameters = ensemble_.grid().parametersOf(i);
    if (!prepared.run || prepared.parameters != parameters) {
      prepared.run = nullptr;
      prepared = {prepare(ensemble_.spec(i)), parameters};
    }
    if (!ensemble_.grid().starts().empty()) prepared.run->startFrom(ensemble_.start(i));
    return prepared.run->execute(watch_);
  }

  const Ensemble& ensemble_;
  const MemberDone& done_;
  const std::atomic<bool>& stop_;
  Watch watch_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
  double cpu_ = 0;
};

}  // namespace

double runEnsemble(const Ensemble& ensemble, int jobs, const std::atomic<bool>& stop, const MemberDone& done) {
  Work work(ensemble, stop, done);
  std::vector<std::thread> others;
  for (int i = 1; i < jobs; ++i) others.emplace_back([&work] { work.take(); });
  work.take();
  for (std::thread& other : others) other.join();
  return work.finish();
}

}  // namespace irk
