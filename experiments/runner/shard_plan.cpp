#include "experiments/runner/shard_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <string>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/runner/schedule/costs.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

std::filesystem::path planFile(const Study& study, const RunnerOptions& options) {
  return options.results / study.id / fmt::format("shards_of_{}", options.shard.count);
}

/// The keys of runs that differ in their swept fields only (SpecField::swept): the numbers that specKey writes, in a
/// third of the time. All specs are resolved.
class SweptKeys {
 public:
  explicit SweptKeys(const RunSpec& any) : between_(1) {
    for (const auto& field : specFields()) {
      if (&field != &specFields().front()) between_.back() += ';';
      between_.back().append(field.name) += '=';
      if (field.swept) {
        swept_.push_back(&field);
        between_.emplace_back();
      } else {
        between_.back() += field.get(any);
      }
    }
    // What follows the fields is the same for all runs.
    between_.back() += keyText(any, findScene(any.scene).parameters).substr(canonicalText(any).size());
  }

  std::uint64_t of(const RunSpec& run) const {
    std::string text = between_.front();
    for (std::size_t i = 0; i < swept_.size(); ++i) text.append(swept_[i]->get(run)).append(between_[i + 1]);
    return fnv1a(text);
  }

 private:
  std::vector<const SpecField*> swept_;
  std::vector<std::string> between_;  // the text of a key before, between and behind the values of swept fields
};

// A hash of the study's series.
std::string fingerprint(const Study& study) {
  std::uint64_t hash = 0;
  for (const Series& series : study.series) {
    hash = fnv1a(fmt::format("{:x} {} {}", hash, specKey(series.runs.front()), series.runs.size()));
  }
  return hexText(hash);
}

// Reads the plan; empty if there is none for these series.
std::vector<int> readPlan(const Study& study, const RunnerOptions& options) {
  requireRegularFile(planFile(study, options));
  std::ifstream in(planFile(study, options));
  std::string its;
  if (!(in >> its) || its != fingerprint(study)) return {};
  std::vector<int> shards;
  for (int shard = 0; in >> shard && shard >= 1 && shard <= options.shard.count;) shards.push_back(shard);
  return shards.size() == study.series.size() ? shards : std::vector<int>();
}

}  // namespace

std::vector<std::uint64_t> keysOf(const Series& series) {
  if (series.runs.size() == 1) {
    const RunSpec only = series.runs.front();
    return {fnv1a(keyText(only, findScene(only.scene).parameters))};
  }
  std::vector<std::uint64_t> keys;
  keys.reserve(series.runs.size());
  const SweptKeys all(series.runs.front());
  for (const auto& spec : series.runs) keys.push_back(all.of(spec));
  return keys;
}

std::vector<int> shardsOf(const Study& study, const RunnerOptions& options) {
  if (options.shard.count == 1) return std::vector<int>(study.series.size(), 1);
  auto kept = readPlan(study, options);
  if (!kept.empty()) return kept;
  std::ostream silent(nullptr);
  const store::Store earlier(options.results / study.id, study.id, store::Use::kRead, {}, silent);
  const Costs costs(
      study, [&](std::size_t i) { return keysOf(study.series[i]); }, earlier.runs());
  return balanced(costs.sums(), options.shard.count);
}

void keepShards(const Study& study, const RunnerOptions& options) {
  if (options.shard.count == 1 || !readPlan(study, options).empty()) return;
  std::string text = fingerprint(study) + '\n';
  for (const int shard : shardsOf(study, options)) text += std::to_string(shard) + '\n';
  const auto file = planFile(study, options);
  const auto beside = fmt::format("{}.{}.{}", file.string(), hostName(), getpid());
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(beside, std::ios::binary);
  if (!(out << text).flush()) throw Failure(fmt::format("cannot write {}: {}", beside, std::strerror(errno)));
  out.close();
  std::filesystem::rename(beside, file);
}

}  // namespace irk
