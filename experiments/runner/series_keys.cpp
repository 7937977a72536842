#include "experiments/runner/series_keys.h"

#include <string>

#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"

namespace irk {
namespace {

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

}  // namespace irk
