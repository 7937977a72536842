#include "experiments/reference/making.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/base/clock.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/reference/attempt.h"
#include "experiments/runs/error_bar.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/setup.h"

namespace irk {
namespace {

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

ReferenceSpecs specsInFiftyDigits(const ReferenceQuestion& question, const ReferenceCase& of) {
  ReferenceSpecs specs;
  for (std::size_t i = 0; i < kReferenceRuns; ++i) {
    specs[i] = referenceRun({question.scene, of}, i);
    if (question.smooth) specs[i].discontinuity = Discontinuity::kSmooth;
    specs[i].options.stop_at = question.stop_at;
  }
  return specs;
}

ReferenceSpecs specsInDouble(const ReferenceQuestion& question, double length, const Strictness& strictness) {
  RunSpec asked;
  asked.scene = question.scene;
  asked.settings = question.settings;
  asked.t_end = question.t_end;
  if (question.smooth) asked.discontinuity = Discontinuity::kSmooth;
  asked.options.stop_at = question.stop_at;
  ReferenceSpecs specs;
  for (std::size_t i = 0; i < kReferenceRuns; ++i) {
    const bool fine = i >= 2, radau = i % 2 == 1;
    const auto family = radau ? IndependentFamily::kRadauIIA : IndependentFamily::kLobattoIIIC;
    specs[i] =
        strictRun(asked, family, strictness.tolerance * (fine ? 0.1 : 1), length / strictness.steps / (fine ? 2 : 1));
  }
  return specs;
}

class Making {
 public:
  Making(const std::vector<ReferenceQuestion>& questions, const ReferenceLimits& limits, const MakingWatch& watch)
      : questions_(questions),
        limits_(limits),
        watch_(watch),
        scene_(makeScene<double>(last().scene, last().settings)),
        results_(questions.size()),
        in_fifty_(questions.size()),
        in_double_(questions.size()) {}

  std::vector<ComputedReference> made() {
    const std::string no_fifty = whyNotInFiftyDigits();
    std::fill(in_fifty_.begin(), in_fifty_.end(), no_fifty);
    if (no_fifty.empty()) {
      const ReferenceCase of = caseOf(last());
      attemptOpen("in 50 digits", specsInFiftyDigits(last(), of), of.tolerance * kFiner, in_fifty_);
    }
    for (const auto& strictness : kStrictnesses) {
      const double length = std::abs(last().t_end - static_cast<double>(scene_.start.t));
      attemptOpen("in double", specsInDouble(last(), length, strictness), kDoubleRoundOff, in_double_);
    }
    for (const std::size_t k : open()) {
      results_[k].interrupted = stopped();
      results_[k].problem =
          stopped() ? "interrupted" : fmt::format("in 50 digits: {}; in double: {}", in_fifty_[k], in_double_[k]);
    }
    return results_;
  }

 private:
  const ReferenceQuestion& last() const { return questions_.back(); }
  bool stopped() const { return watch_.stop && watch_.stop->load(std::memory_order_relaxed); }

  // The questions that have no answer yet.
  std::vector<std::size_t> open() const {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < results_.size(); ++k) {
      if (results_[k].values.empty() && results_[k].problem.empty()) open.push_back(k);
    }
    return open;
  }

  std::string whyNotInFiftyDigits() const {
    if (!findScene(last().scene).make_big_float) return "the scene has no 50-digit instance";
    const Index n = scene_.sizes().n();
    if (n <= limits_.most_unknowns) return "";
    return fmt::format("{} unknowns are too many, up to {} are computed in 50 digits", n, limits_.most_unknowns);
  }

  // Makes the four runs through all open times and keeps what they agree on; `why_not` says it of the others.
  void attemptOpen(const char* how, const ReferenceSpecs& specs, double least, std::vector<std::string>& why_not) {
    const auto wanted = open();
    if (wanted.empty() || stopped()) return;
    std::vector<std::string> times;
    for (const std::size_t k : wanted) times.push_back(numberText(questions_[k].t_end));
    const auto made = attempt(
        specs, times, {.jobs = watch_.jobs, .stop = watch_.stop, .cpu_s = limits_.cpu_s, .progress = [&](double cpu_s) {
                         show(how, cpu_s);
                       }});
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      why_not[wanted[i]] = made.hasReached(i) ? agree(specs, made, i, least, wanted[i]) : made.failure;
    }
  }

  void show(const char* how, double cpu_s) const {
    if (!watch_.show) return;
    watch_.show(fmt::format("reference {}: {}, {} of CPU time, at most {}", placeText(questions_), how,
                            durationText(cpu_s), durationText(limits_.cpu_s)));
  }

  // Of the i-th row of the runs, for question k. Returns why there is nothing to keep.
  std::string agree(const ReferenceSpecs& specs, const Attempted& made, std::size_t i, double least, std::size_t k) {
    const auto names = namesOf();
    ComputedReference result;
    result.in_double = in_fifty_[k];
    for (std::size_t j = 0; j < names.size(); ++j) {
      const auto found = agreedNumber(made, i, j, least, scaleOf(j));
      if (!found) continue;
      const double accuracy = found->accuracy / found->size;
      if (accuracy > limits_.disagreement) {
        const auto text = fmt::format("the four runs disagree, {} by {:.0e}", names[j], accuracy);
        // In 50 digits this is the end; in double a stricter attempt may follow.
        if (!specs.back().scalar.isDouble()) results_[k].problem = "in 50 digits " + text;
        return text;
      }
      result.accuracy = std::max(result.accuracy, accuracy);
      result.values.push_back({last().scene, settingsText(last().settings), numberText(questions_[k].t_end), names[j],
                               found->value, found->accuracy, "four runs that agree"});
    }
    if (result.values.empty()) return "no component is finite";
    results_[k] = std::move(result);
    return "";
  }

  std::vector<std::string> namesOf() const {
    auto names = scene_.names;
    for (const auto& output : scene_.outputs) names.push_back(output.name);
    if (!last().stop_at.empty()) names.emplace_back(kEventTime);
    return names;
  }
  // As errors are measured (runs/run_errors.cpp).
  double scaleOf(std::size_t j) const {
    const auto i = static_cast<Index>(j);
    return j < scene_.names.size() && i < scene_.scale.size() ? scene_.scale[i] : 1;
  }

  const std::vector<ReferenceQuestion>& questions_;
  const ReferenceLimits& limits_;
  const MakingWatch& watch_;
  Scene<double> scene_;
  std::vector<ComputedReference> results_;
  std::vector<std::string> in_fifty_, in_double_;  // why there are no values, for each question
};

}  // namespace

std::vector<ComputedReference> makeReferences(const std::vector<ReferenceQuestion>& questions,
                                              const ReferenceLimits& limits, const MakingWatch& watch) {
  const double start = wallSeconds();
  std::vector<ComputedReference> made(questions.size());
  try {
    made = Making(questions, limits, watch).made();
  } catch (const std::exception& error) {
    for (auto& reference : made) reference.problem = error.what();
  }
  const double seconds = wallSeconds() - start;
  for (auto& reference : made) {
    std::replace(reference.problem.begin(), reference.problem.end(), '\n', ' ');
    std::replace(reference.in_double.begin(), reference.in_double.end(), '\n', ' ');
    reference.seconds = seconds;
  }
  return made;
}

}  // namespace irk
