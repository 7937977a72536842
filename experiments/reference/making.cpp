#include "experiments/reference/making.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/base/clock.h"
#include "experiments/base/numbers.h"
#include "experiments/reference/agreement.h"
#include "experiments/reference/integration.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/setup.h"

namespace irk {
namespace {

using Specs = std::array<RunSpec, kReferenceRuns>;  // the best one last

// Values in double are not better than this, relative to the magnitude of the component.
constexpr double kDoubleRoundOff = 1e-14;

// Options of the runs in double. The second entry is tried if a run with the first one fails or if they disagree.
struct Strictness {
  double tolerance;  // of the coarser runs; the finer ones have a tenth of it
  double steps;      // at least this many over the whole interval; twice as many in the finer runs
};
constexpr Strictness kStrictnesses[] = {{1e-11, 100}, {1e-9, 1000}};

// Tolerance and step as `irk reference` uses them for these settings, or else for the default ones.
ReferenceCase caseOf(const ReferenceQuestion& question) {
  ReferenceCase best;
  for (const auto& known : findScene(question.scene).reference_cases) {
    RunSpec spec;
    findField("scene").set(spec, question.scene);
    findField("settings").set(spec, known.settings);
    if (resolved(spec).settings == question.settings) {
      best = known;
      break;
    }
    if (known.settings.empty()) best = known;
  }
  best.settings = settingsText(question.settings);
  return best;
}

Specs specsInFiftyDigits(const ReferenceQuestion& question, const ReferenceCase& of) {
  Specs specs;
  for (std::size_t i = 0; i < kReferenceRuns; ++i) {
    specs[i] = referenceRun({question.scene, of}, i);
    if (question.smooth) specs[i].discontinuity = Discontinuity::kSmooth;
  }
  return specs;
}

// All options are given explicitly, so that changed defaults change no reference.
Specs specsInDouble(const ReferenceQuestion& question, double length, const Strictness& strictness) {
  Specs specs;
  for (std::size_t i = 0; i < kReferenceRuns; ++i) {
    const bool fine = i >= 2, radau = i % 2 == 1;
    const std::string tolerance = numberText(strictness.tolerance * (fine ? 0.1 : 1));
    specs[i] = resolved(parseSpec(fmt::format(
        "scene={};settings={};configuration=default;method={};formulation=index2;scaling=on;discontinuity={};"
        "scalar=double;derivatives=automatic;newton=simplified;solver=schur;storage=automatic;"
        "predictor=extrapolated;estimate={};control=predictive;order=fixed;summation=compensated;"
        "multipliers=consistent;norm=mixed;jacobian=full;jacobian_point=start;h_max={};rtol={};atol={};t_end={}",
        question.scene, settingsText(question.settings), radau ? "radau_iia_7" : "lobatto_iiic_6",
        question.smooth ? "smooth" : "locate", radau ? "embedded" : "richardson",
        numberText(length / strictness.steps / (fine ? 2 : 1)), tolerance, tolerance, numberText(question.t_end))));
  }
  return specs;
}

class Making {
 public:
  Making(const ReferenceQuestion& question, const ReferenceLimits& limits, int jobs, const std::atomic<bool>* stop)
      : question_(question),
        limits_(limits),
        jobs_(jobs),
        stop_(stop),
        scene_(makeScene<double>(question.scene, question.settings)) {}

  ComputedReference made() {
    std::string fifty = whyNotInFiftyDigits();
    if (fifty.empty()) {
      const ReferenceCase of = caseOf(question_);
      fifty = attempt(specsInFiftyDigits(question_, of), of.tolerance * kFiner);
      if (done()) return result_;
    }
    std::string problem;
    for (const auto& strictness : kStrictnesses) {
      problem = attempt(specsInDouble(question_, question_.t_end - scene_.start.t, strictness), kDoubleRoundOff);
      if (problem.empty()) {
        result_.problem.clear();
        result_.in_double = fifty;
        return result_;
      }
      if (stopped()) return result_;
    }
    result_.problem = fmt::format("in 50 digits: {}; in double: {}", fifty, problem);
    return result_;
  }

 private:
  bool stopped() {
    result_.interrupted = stop_ && stop_->load(std::memory_order_relaxed);
    if (result_.interrupted) {
      result_.values.clear();
      result_.problem = "interrupted";
    }
    return result_.interrupted;
  }
  bool done() { return stopped() || !result_.values.empty() || !result_.problem.empty(); }

  std::string whyNotInFiftyDigits() const {
    if (!findScene(question_.scene).make_mp50) return "the scene has no 50-digit instance";
    const Index n = scene_.sizes().n();
    if (n <= limits_.most_unknowns) return "";
    return fmt::format("{} unknowns are too many, up to {} are computed in 50 digits", n, limits_.most_unknowns);
  }

  // Makes the four runs and keeps what they agree on. Returns why there is nothing to keep.
  std::string attempt(const Specs& specs, double least) {
    std::array<Integrated, kReferenceRuns> runs;
    CpuBudget budget(limits_.cpu_s);
    const std::vector<std::string> times{numberText(question_.t_end)};
    // The last runs take longest: start with them.
#pragma omp parallel for schedule(dynamic, 1) num_threads(jobs_)
    for (std::size_t turn = 0; turn < kReferenceRuns; ++turn) {
      const std::size_t i = kReferenceRuns - 1 - turn;
      runs[i] = integrated(specs[i], times, {.stop = stop_, .budget = &budget});
    }
    for (const auto& run : runs) {
      if (!run.failure.empty()) return run.failure;
    }
    return agree(specs, runs, least);
  }

  std::string agree(const Specs& specs, const std::array<Integrated, kReferenceRuns>& runs, double least) {
    result_.values.clear();
    result_.accuracy = 0;
    const auto names = namesOf();
    for (std::size_t j = 0; j < names.size(); ++j) {
      std::array<mp50, kReferenceRuns> values;
      for (std::size_t i = 0; i < kReferenceRuns; ++i) values[i] = runs[i].rows.front()[j];
      if (!std::all_of(values.begin(), values.end(), [](const mp50& x) { return isfinite(x); })) continue;
      const double size = std::max(std::abs(static_cast<double>(values.back())), scaleOf(j));
      const AgreedValue found = agreed(values, least * size);
      if (found.accuracy > limits_.disagreement * size) {
        result_.values.clear();
        return disagreementText(specs.back(), names[j], found.accuracy / size);
      }
      result_.accuracy = std::max(result_.accuracy, found.accuracy / size);
      result_.values.push_back({question_.scene, settingsText(question_.settings), numberText(question_.t_end),
                                names[j], found.value, found.accuracy, "four runs that agree"});
    }
    return result_.values.empty() ? "no component is finite" : "";
  }

  // In 50 digits this is the end; in double a stricter attempt may follow.
  std::string disagreementText(const RunSpec& spec, const std::string& component, double difference) {
    const auto text = fmt::format("the four runs disagree, {} by {:.0e}", component, difference);
    if (spec.scalar == ScalarKind::kMp50) result_.problem = "in 50 digits " + text;
    return text;
  }

  std::vector<std::string> namesOf() const {
    auto names = scene_.names;
    for (const auto& output : scene_.outputs) names.push_back(output.name);
    return names;
  }
  // As errors are measured (runs/run_errors.cpp).
  double scaleOf(std::size_t j) const {
    const auto i = static_cast<Index>(j);
    return j < scene_.names.size() && i < scene_.scale.size() ? scene_.scale[i] : 1;
  }

  const ReferenceQuestion& question_;
  const ReferenceLimits& limits_;
  int jobs_;
  const std::atomic<bool>* stop_;
  Scene<double> scene_;
  ComputedReference result_;
};

}  // namespace

ComputedReference makeReference(const ReferenceQuestion& question, const ReferenceLimits& limits, int jobs,
                                const std::atomic<bool>* stop) {
  const double start = wallSeconds();
  ComputedReference made;
  try {
    made = Making(question, limits, jobs, stop).made();
  } catch (const std::exception& error) {
    made.problem = error.what();
  }
  std::replace(made.problem.begin(), made.problem.end(), '\n', ' ');
  std::replace(made.in_double.begin(), made.in_double.end(), '\n', ' ');
  made.seconds = wallSeconds() - start;
  return made;
}

}  // namespace irk
