#include "experiments/reference/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <utility>

#include "experiments/base/clock.h"
#include "experiments/base/progress.h"
#include "experiments/reference/agreement.h"
#include "experiments/reference/cache.h"

namespace irk {
namespace {

std::string lineOf(const ReferenceQuestion& question, const ComputedReference& made) {
  const std::string place = "reference " + placeText(question);
  if (made.values.empty()) return fmt::format("{}: none: {}", place, made.problem);
  const auto digits = static_cast<int>(std::floor(-std::log10(made.accuracy)));
  const std::string seconds = fmt::format("{:.{}f}", made.seconds, made.seconds < 10 ? 1 : 0);
  if (made.in_double.empty()) return fmt::format("{}: {} digits, {} s", place, digits, seconds);
  return fmt::format("{}: {} digits, {} s, in double: {}", place, digits, seconds, made.in_double);
}

MadeReference forRuns(const ComputedReference& made) {
  MadeReference reference;
  for (const auto& value : made.values) {
    reference.values.push_back({std::strtod(value.t.c_str(), nullptr), value.component,
                                decimalText(value.value, value.accuracy), value.accuracy, value.source});
  }
  if (made.values.empty()) reference.problem = "no reference: " + made.problem;
  return reference;
}

// The questions of these runs, each once.
std::vector<ReferenceQuestion> neededBy(const std::vector<RunSpec>& resolved) {
  std::set<std::string> seen;
  std::vector<ReferenceQuestion> questions;
  for (const auto& spec : resolved) {
    if (spec.reference != ReferenceUse::kAuto) continue;
    try {
      auto question = questionOf(spec);
      if (seen.insert(keyText(question)).second && needsReference(spec)) questions.push_back(std::move(question));
    } catch (const Misuse&) {  // the run will be refused
    }
  }
  return questions;
}

}  // namespace

ReferenceLibrary::ReferenceLibrary(Options options) : options_(std::move(options)) {}

MadeReference ReferenceLibrary::of(const RunSpec& resolved) {
  const auto question = questionOf(resolved);
  return fill(shelfOf(question), question, options_.jobs);
}

void ReferenceLibrary::prepare(const std::vector<RunSpec>& resolved, const std::string& label, std::ostream& out) {
  const auto questions = neededBy(resolved);
  if (questions.empty()) return;
  Progress progress(out, label);
  for (const auto& question : questions) progress.expect(question.scene);
  // One question is computed by four threads; several questions by one thread each.
  const int inside = questions.size() == 1 ? options_.jobs : 1;
#pragma omp parallel for schedule(dynamic, 1) num_threads(options_.jobs)
  for (const auto& question : questions) {
    const double start = wallSeconds();
    fill(shelfOf(question), question, inside);
    const std::lock_guard lock(mutex_);
    progress.finished(question.scene, wallSeconds() - start);
  }
}

ReferenceLibrary::Shelf& ReferenceLibrary::shelfOf(const ReferenceQuestion& question) {
  auto key = keyText(question);
  const std::lock_guard lock(mutex_);
  auto& shelf = shelves_[std::move(key)];
  if (!shelf) shelf = std::make_unique<Shelf>();
  return *shelf;
}

const MadeReference& ReferenceLibrary::fill(Shelf& shelf, const ReferenceQuestion& question, int jobs) {
  std::call_once(shelf.once, [&] { shelf.reference = forRuns(keptOrMade(question, jobs)); });
  return shelf.reference;
}

ComputedReference ReferenceLibrary::keptOrMade(const ReferenceQuestion& question, int jobs) {
  try {
    if (auto kept = keptReference(question)) {
      if (kept->values.empty()) tell(lineOf(question, *kept));
      return *kept;
    }
  } catch (const std::exception&) {  // `keep` tells it
  }
  const ComputedReference made = makeReference(question, options_.limits, std::min(jobs, 4), options_.stop);
  if (made.interrupted) return made;
  tell(lineOf(question, made));
  keep(question, made);
  return made;
}

void ReferenceLibrary::keep(const ReferenceQuestion& question, const ComputedReference& made) {
  try {
    keepReference(question, made);
  } catch (const std::exception& error) {
    if (cache_works_.exchange(false)) tell(fmt::format("references are computed, but not kept: {}", error.what()));
  }
}

void ReferenceLibrary::tell(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (options_.tell) options_.tell(line);
}

}  // namespace irk
