#include <fmt/format.h>
#include <fmt/ostream.h>

#include "experiments/analyses/results.h"
#include "experiments/commands/commands.h"
#include "experiments/compare/compare.h"
#include "experiments/compare/folders.h"
#include "experiments/compare/publications.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// Reads `5%` as 0.05.
double percentage(std::string_view name, const std::string& text) {
  constexpr Range kPercent = Range::from(0).to(1000);
  if (!text.ends_with('%')) {
    throw Misuse(fmt::format("{} = '{}': a percentage is expected, 0% to 1000%", name, text));
  }
  return parseNumber(fmt::format("{} in %", name), text.substr(0, text.size() - 1), kPercent) / 100;
}

compare::Limits limitsOf(const CompareOptions& options) {
  constexpr Range kFactor = Range::from(1).to(1e15);
  constexpr Range kAlpha = Range::above(0).below(1);
  return {.errors = parseNumber("errors", options.errors, kFactor),
          .times = percentage("times", options.times),
          .alpha = parseNumber("alpha", options.alpha, kAlpha),
          .counters = percentage("counters", options.counters)};
}

// Publications have no runs.csv. Two of them are compared by their small tables.
bool arePublications(const CompareOptions& options) {
  const bool first = compare::isPublication(options.first), second = compare::isPublication(options.second);
  if (first == second) return first;
  throw Misuse(
      fmt::format("{} is a publication (published.csv), {} is not: compare two publications, or two folders "
                  "of results",
                  first ? options.first : options.second, first ? options.second : options.first));
}

}  // namespace

int compareCommand(const CompareOptions& options, Streams streams) {
  const compare::Limits limits = limitsOf(options);
  if (arePublications(options)) {
    const auto found = compare::comparePublications(options.first, options.second, limits);
    streams.out << found.text;
    return found.count == 0 ? 0 : 1;
  }
  const auto first = compare::runsIn(options.first), second = compare::runsIn(options.second);
  if (first.contains("") != second.contains("")) {
    const bool study_first = first.contains("");
    throw Misuse(fmt::format("{} is the folder of a study (runs.csv), {} is not: compare two of a kind",
                             study_first ? options.first : options.second,
                             study_first ? options.second : options.first));
  }
  std::size_t differences = 0;
  const auto tellMissing = [&](const auto& from, const auto& in, const char* which) {
    for (const auto& [study, file] : from) {
      if (in.contains(study)) continue;
      ++differences;
      fmt::print(streams.out, "{}: only in the {} ({})\n", study, which, file.string());
    }
  };
  tellMissing(first, second, "first");
  tellMissing(second, first, "second");
  for (const auto& [study, file] : first) {
    const auto other = second.find(study);
    if (other == second.end()) continue;
    const auto comparison = compare::compareRuns(compare::runsOf(file), compare::runsOf(other->second), limits);
    differences += comparison.total();
    streams.out << compare::textOf(study, comparison);
    for (const auto& its : {file, other->second}) tellDrift(its.parent_path().string(), its, streams.err);
  }
  return differences == 0 ? 0 : 1;
}

}  // namespace irk
