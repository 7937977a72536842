#include "experiments/reference/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/base/progress.h"
#include "experiments/reference/agreement.h"
#include "experiments/reference/cache.h"

namespace irk {
namespace {

// Of references that were made together and in the same way: there are none, or all are in 50 digits or in double for
// one reason.
std::string lineOf(const std::vector<ReferenceQuestion>& questions, const std::vector<ComputedReference>& made) {
  const std::string place = "reference " + placeText(questions);
  const ComputedReference& first = made.front();
  if (first.values.empty()) return fmt::format("{}: none: {}", place, first.problem);
  double accuracy = 0;
  for (const auto& reference : made) accuracy = std::max(accuracy, reference.accuracy);
  const auto digits = static_cast<int>(std::floor(-std::log10(accuracy)));
  const std::string seconds = fmt::format("{:.{}f}", first.seconds, first.seconds < 10 ? 1 : 0);
  if (first.in_double.empty()) return fmt::format("{}: {} digits, {} s", place, digits, seconds);
  return fmt::format("{}: {} digits, {} s, in double: {}", place, digits, seconds, first.in_double);
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

// Questions that differ in t_end only, ascending.
using Together = std::vector<ReferenceQuestion>;

// The questions of these runs, each once.
std::vector<Together> neededBy(const std::vector<RunSpec>& resolved) {
  std::set<std::string> seen;
  std::map<std::tuple<std::string, Settings, bool, std::string>, Together> problems;
  for (const auto& spec : resolved) {
    if (spec.reference != ReferenceUse::kAuto) continue;
    try {
      auto question = referenceQuestion(spec);
      if (!seen.insert(keyText(question)).second || !needsReference(spec)) continue;
      problems[{question.scene, question.settings, question.smooth, question.stop_at}].push_back(std::move(question));
    } catch (const Misuse&) {  // the run will be refused
    }
  }
  std::vector<Together> all;
  for (auto& [problem, questions] : problems) {
    std::sort(questions.begin(), questions.end(), [](const auto& a, const auto& b) { return a.t_end < b.t_end; });
    all.push_back(std::move(questions));
  }
  return all;
}

}  // namespace

ReferenceLibrary::ReferenceLibrary(Options options) : options_(std::move(options)) {}

MadeReference ReferenceLibrary::of(const RunSpec& resolved) {
  const auto question = referenceQuestion(resolved);
  Shelf& shelf = shelfOf(question);
  fill(shelf, [&] {
    const auto from_cache = kept(question);
    return from_cache ? *from_cache : made({question}, options_.jobs, nullptr).front();
  });
  return shelf.reference;
}

void ReferenceLibrary::prepare(const std::vector<RunSpec>& resolved, Progress* progress) {
  std::vector<Together> missing;
  for (auto& problem : neededBy(resolved)) {
    std::erase_if(problem, [&](const auto& question) { return isFilled(question); });
    if (problem.empty()) continue;
    if (progress) {
      for (const auto& question : problem) progress->expect(question.scene);
    }
    std::erase_if(problem, [&](const auto& question) {
      const auto from_cache = kept(question);
      if (!from_cache) return false;
      if (progress) progress->skipped(question.scene);
      fill(shelfOf(question), [&] { return *from_cache; });
      return true;
    });
    if (!problem.empty()) missing.push_back(std::move(problem));
  }
  // All threads compute a single problem; of several problems each thread computes its own.
  const int threads = missing.size() == 1 ? 1 : options_.jobs, inside = missing.size() == 1 ? options_.jobs : 1;
  ParallelLoop loop;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t turn = 0; turn < missing.size(); ++turn) {
    loop.turn(turn, [&] {
      const Together& problem = missing[turn];
      const double start = wallSeconds();
      const auto references = made(problem, inside, progress);
      const double each = (wallSeconds() - start) / static_cast<double>(problem.size());
      for (std::size_t i = 0; i < problem.size(); ++i) {
        fill(shelfOf(problem[i]), [&] { return references[i]; });
        const std::lock_guard lock(mutex_);
        if (progress) progress->finished(problem[i].scene, each);
      }
    });
  }
  loop.rethrow();
}

ReferenceLibrary::Shelf& ReferenceLibrary::shelfOf(const ReferenceQuestion& question) {
  auto key = keyText(question);
  const std::lock_guard lock(mutex_);
  auto& shelf = shelves_[std::move(key)];
  if (!shelf) shelf = std::make_unique<Shelf>();
  return *shelf;
}

void ReferenceLibrary::fill(Shelf& shelf, const std::function<ComputedReference()>& find) {
  std::call_once(shelf.once, [&] {
    shelf.reference = forRuns(find());
    shelf.filled = true;
  });
}

bool ReferenceLibrary::isFilled(const ReferenceQuestion& question) { return shelfOf(question).filled; }

std::optional<ComputedReference> ReferenceLibrary::kept(const ReferenceQuestion& question) {
  try {
    auto reference = keptReference(question);
    if (reference && reference->values.empty()) tell(lineOf({question}, {*reference}));
    return reference;
  } catch (const std::exception&) {  // there is no cache; `keep` reports it
    return {};
  }
}

std::vector<ComputedReference> ReferenceLibrary::made(const Questions& questions, int jobs, Progress* progress) {
  MakingWatch watch{.jobs = std::min(jobs, static_cast<int>(kReferenceRuns)), .stop = options_.stop};
  if (progress || options_.show) watch.show = [&](const std::string& text) { show(text, progress); };
  auto references = makeReferences(questions, options_.limits, watch);
  show("", progress);
  for (std::size_t begin = 0, end = 0; begin < references.size(); begin = end) {
    const ComputedReference& first = references[begin];
    std::vector<ReferenceQuestion> alike;
    std::vector<ComputedReference> found;
    while (end < references.size() && references[end].problem == first.problem &&
           references[end].in_double == first.in_double) {
      alike.push_back(questions[end]);
      found.push_back(references[end++]);
    }
    if (first.interrupted) continue;
    tell(lineOf(alike, found));
    for (std::size_t i = 0; i < alike.size(); ++i) keep(alike[i], found[i]);
  }
  return references;
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
  if (options_.show) options_.show("");
  if (options_.tell) options_.tell(line);
}

void ReferenceLibrary::show(const std::string& text, Progress* progress) {
  const std::lock_guard lock(mutex_);
  if (progress) {
    progress->note(text);
  } else if (options_.show) {
    options_.show(text);
  }
}

}  // namespace irk
