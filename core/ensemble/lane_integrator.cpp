#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/in_use.h"
#include "core/ensemble/lane_newton.h"
#include "core/ensemble/lane_rules.h"
#include "core/ensemble/lane_run.h"
#include "core/estimates/embedded.h"

namespace irk {

/// Steps all lanes in turn: one attempt of each, the decision of each, then new members for the lanes whose run has
/// ended.
class LaneIntegrator::Run {
 public:
  Run(const Tableau<double>& tableau, const IntegratorOptions& options)
      : options_(legalInLanes(options)), scheme_(checked(tableau)), points_(scheme_, options_.step.looks) {
    requireLaneMethod(scheme_);
    mu_ = EmbeddedEstimate<double>::weight(tableau);
    const int order = EmbeddedEstimate<double>::order(tableau);
    for (auto& run : runs_) run = std::make_unique<LaneRun>(order, options_);
  }

  void integrate(const Ensemble& ensemble, const Next& next, const Done& done, const std::function<Outcome()>& stop) {
    const InUse use(in_use_, "LaneIntegrator::integrate");
    if (!ensemble.member || !ensemble.lanes || !next || !done) {
      throw Misuse("LaneIntegrator::integrate: each of the functions `member`, `lanes`, `next` and `done` is needed");
    }
    ensemble_ = &ensemble;
    next_ = &next;
    done_ = &done;
    vectors_.reset();
    active_ = {};
    counters_ = {};
    for (std::size_t i = 0; i < kLanes; ++i) load(i);
    while (active_.any()) {
      const Outcome stopped = stop ? stop() : Outcome::kSuccess;
      if (stopped != Outcome::kSuccess) return forEachLane(active_, [&](std::size_t i) { end(i, stopped); });
      plan();
      if (active_.any()) attempt();
    }
  }

 private:
  static const Tableau<double>& checked(const Tableau<double>& tableau) {
    requireTableau(tableau);
    return tableau;
  }

  // Vectors whose sizes depend on those of the systems.
  struct Vectors {
    Vectors(const Scheme<double>& scheme, const System<double>& system, const IntegratorOptions& options, double mu)
        : form(system),
          from(form.sizes),
          to(form.sizes),
          norm(form.sizes, form.error_powers, options.tolerances),
          stages(scheme, form.sizes, form.row_powers, mu),
          newton(scheme, form.sizes, form.row_powers, options, mu),
          W(static_cast<std::size_t>(form.sizes.n() * scheme.s)) {}
    LaneForm form;
    LaneState from, to;
    LaneNorm norm;
    LaneStages stages;
    LaneNewton newton;
    std::vector<Lanes> W;
  };

  State<double> state(std::size_t i) const { return vectors_->from.get(i, vectors_->form.sizes); }

  // Loads the next member that can begin into lane i. A lane without a member keeps its numbers, which are not used.
  void load(std::size_t i) {
    active_.set(i, false);
    past_.set(i, false);
    while (const std::optional<std::size_t> index = (*next_)()) {
      LaneRun& run = *runs_[i];
      EnsembleMember member = ensemble_->member(*index);
      requireLaneMember(member, vectors_ ? &vectors_->form : nullptr);
      if (!vectors_) vectors_.emplace(scheme_, *member.system, options_, mu_);
      const Outcome outcome = run.begin(*index, std::move(member));
      if (outcome != Outcome::kSuccess) {
        (*done_)(*index, run.failure(outcome, run.start()));
      } else if (run.isOver(run.start().t)) {
        (*done_)(*index, run.success(run.start()));
      } else {
        return begin(i);
      }
    }
  }
  void begin(std::size_t i) {
    const LaneRun& run = *runs_[i];
    active_.set(i, true);
    changed_ = true;
    at_[i] = run.index();
    vectors_->from.set(i, run.start());
    vectors_->norm.setScale(i, run.member().scale);
    vectors_->newton.restart(i);
  }
  // Lanes without a member repeat the equations of a lane that has one.
  void assemble() {
    if (!changed_) return;
    changed_ = false;
    std::size_t first = 0;
    while (!active_[first]) ++first;
    std::array<std::size_t, kLanes> at = at_;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (!active_[i]) at[i] = at_[first];
    }
    system_ = ensemble_->lanes(at);
    requireLaneSystem(system_.get(), vectors_->form);
    vectors_->stages.use(*system_);
  }

  void end(std::size_t i, Outcome outcome) {
    LaneRun& run = *runs_[i];
    counters_.moveTo(i, run.counters());
    const std::size_t index = run.index();
    active_.set(i, false);
    (*done_)(index, outcome == Outcome::kSuccess ? run.success(state(i)) : run.failure(outcome, state(i)));
  }

  // Plans the next step of each lane; a lane whose run has ended gets another member.
  void plan() {
    forEachLane(active_, [this](std::size_t i) {
      while (active_[i]) {
        const Outcome outcome = runs_[i]->plan(vectors_->from.t[i]);
        if (outcome == Outcome::kSuccess) break;
        end(i, outcome);
        load(i);
      }
    });
    if (active_.any()) assemble();
  }

  void attempt() {
    auto& [form, from, to, norm, stages, newton, W] = *vectors_;
    const Lanes h = Lanes::each([this](std::size_t i) { return active_[i] ? runs_[i]->h() : 1.0; });
    norm.update(from, h);
    stages.begin(from, h);
    stages.predict(past_, W);
    const Lanes kappa =
        Lanes::each([&, &n = newton](std::size_t i) { return n.kappa(runs_[i]->stepsAccepted(), norm.index3()); });
    const LaneSolved solved = newton.solve(stages, norm, from, h, active_, kappa, W, counters_);
    stages.finish(W, to);
    stages.keep(solved.solved, W);
    past_ = solved.solved;
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const Lanes again = Lanes::each([&](std::size_t i) { return runs_[i]->filtersAgain() ? 1.0 : kNever; });
    LaneMatrix& matrix = newton.filterMatrix(solved.solved, counters_);
    const Lanes estimate = stages.estimate(W, norm, matrix, again, solved.solved, counters_);
    const Lanes error = withDefect(estimate, solved.solved, matrix);
    LaneMask accepted;
    forEachLane(active_, [&](std::size_t i) {
      LaneRun& run = *runs_[i];
      if (solved.solved[i] && std::isfinite(error[i])) {
        accepted.set(i, run.decide(estimate[i], error[i], solved.round_off[i]));
      } else {
        run.failed(solved.solved[i] ? Outcome::kNotFinite : solved.outcome[i]);
        past_.set(i, false);
      }
    });
    newton.forget(active_ & ~past_);
    commit(accepted);
  }

  // The larger one of the estimate and of the defect between the stages, in the lanes whose estimate is accepted.
  Lanes withDefect(const Lanes& estimate, const LaneMask& solved, LaneMatrix& matrix) {
    Lanes error = estimate;
    LaneMask open = solved & lessOrEqual(estimate, 1.0);
    for (std::int64_t look = 0; open.any(); ++look) {
      LanePoints at{};
      forEachLane(open, [&](std::size_t i) {
        if (look >= runs_[i]->looks(points_.period())) return open.set(i, false);
        at[i].emplace(points_[runs_[i]->nextLook()]);
      });
      if (!open.any()) break;
      const Lanes defect = vectors_->stages.defect(at, vectors_->W, vectors_->norm, matrix, open, look == 0, counters_);
      error = select(open, largest(error, defect), error);
    }
    return error;
  }

  void commit(const LaneMask& accepted) {
    LaneState &from = vectors_->from, &to = vectors_->to;
    from.t = select(accepted, to.t, from.t);
    assign(accepted, to.y.data(), from.y.data(), from.y.size());
    assign(accepted, to.w.data(), from.w.data(), from.w.size());
    assign(accepted, to.carry.data(), from.carry.data(), from.carry.size());
    forEachLane(accepted, [&](std::size_t i) {
      LaneRun& run = *runs_[i];
      from.t.set(i, run.newTime(from.t[i]));
      if (!run.isOver(from.t[i])) return;
      end(i, Outcome::kSuccess);
      load(i);
    });
  }

  std::atomic_flag in_use_;
  IntegratorOptions options_;
  Scheme<double> scheme_;
  MovingPoints<double> points_;
  double mu_ = 0;
  std::array<std::unique_ptr<LaneRun>, kLanes> runs_;
  const Ensemble* ensemble_ = nullptr;
  const Next* next_ = nullptr;
  const Done* done_ = nullptr;
  std::optional<Vectors> vectors_;
  std::shared_ptr<const System<Lanes>> system_;
  std::array<std::size_t, kLanes> at_{};  // the members of the lanes
  bool changed_ = false;                  // whether at_ has changed since system_ was made
  LaneMask active_, past_;                // lanes with a member; lanes whose last attempt was solved
  LaneCounters counters_;
};

LaneIntegrator::LaneIntegrator(const Tableau<double>& tableau, const IntegratorOptions& options)
    : run_(std::make_unique<Run>(tableau, options)) {}
LaneIntegrator::~LaneIntegrator() = default;
LaneIntegrator::LaneIntegrator(LaneIntegrator&&) noexcept = default;

void LaneIntegrator::integrate(const Ensemble& ensemble, const Next& next, const Done& done,
                               const std::function<Outcome()>& stop) {
  if (!run_) throw Misuse("LaneIntegrator::integrate: the object has been moved from");
  run_->integrate(ensemble, next, done, stop);
}

}  // namespace irk
