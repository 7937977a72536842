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
      auto question = referenceQuestion(spec);
      if (seen.insert(keyText(question)).second && needsReference(spec)) questions.push_back(std::move(question));
    } catch (const Misuse&) {  // the run will be refused
    }
  }
  return questions;
}

}  // namespace

ReferenceLibrary::ReferenceLibrary(Options options) : options_(std::move(options)) {}

MadeReference ReferenceLibrary::of(const RunSpec& resolved) {
  return fill(referenceQuestion(resolved), options_.jobs).reference;
}

void ReferenceLibrary::prepare(const std::vector<RunSpec>& resolved, const std::string& label, std::ostream& out) {
  const auto questions = neededBy(resolved);
  if (questions.empty()) return;
  Progress progress(out, label);
  for (const auto& question : questions) progress.expect(question.scene);
  // All threads compute a single question; of several questions each thread computes its own.
  const int threads = questions.size() == 1 ? 1 : options_.jobs, inside = questions.size() == 1 ? options_.jobs : 1;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (const auto& question : questions) {
    const double start = wallSeconds();
    const bool is_made = fill(question, inside).made;
    const std::lock_guard lock(mutex_);
    if (is_made) {
      progress.finished(question.scene, wallSeconds() - start);
    } else {
      progress.skipped(question.scene);
    }
  }
}

ReferenceLibrary::Shelf& ReferenceLibrary::shelfOf(const ReferenceQuestion& question) {
  auto key = keyText(question);
  const std::lock_guard lock(mutex_);
  auto& shelf = shelves_[std::move(key)];
  if (!shelf) shelf = std::make_unique<Shelf>();
  return *shelf;
}

const ReferenceLibrary::Shelf& ReferenceLibrary::fill(const ReferenceQuestion& question, int jobs) {
  Shelf& shelf = shelfOf(question);
  std::call_once(shelf.once, [&] {
    const auto from_cache = kept(question);
    shelf.made = !from_cache;
    shelf.reference = forRuns(from_cache ? *from_cache : made(question, jobs));
  });
  return shelf;
}

std::optional<ComputedReference> ReferenceLibrary::kept(const ReferenceQuestion& question) {
  try {
    auto reference = keptReference(question);
    if (reference && reference->values.empty()) tell(lineOf(question, *reference));
    return reference;
  } catch (const std::exception&) {  // there is no cache; `keep` reports it
    return {};
  }
}

ComputedReference ReferenceLibrary::made(const ReferenceQuestion& question, int jobs) {
  const int threads = std::min(jobs, static_cast<int>(kReferenceRuns));
  auto reference = makeReference(question, options_.limits, threads, options_.stop);
  if (reference.interrupted) return reference;
  tell(lineOf(question, reference));
  keep(question, reference);
  return reference;
}

void ReferenceLibrary::keep(const ReferenceQuestion& question, const ComputedReference& reference) {
  try {
    keepReference(question, reference);
  } catch (const std::exception& error) {
    if (cache_works_.exchange(false)) tell(fmt::format("references are computed, but not kept: {}", error.what()));
  }
}

void ReferenceLibrary::tell(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (options_.tell) options_.tell(line);
}

}  // namespace irk
