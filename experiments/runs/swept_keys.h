// The keys of many runs that are nearly the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// The keys of runs that differ in their swept fields only (SpecField::swept): the numbers that specKey writes, in a
/// third of the time. All specs are resolved.
class SweptKeys {
 public:
  explicit SweptKeys(const RunSpec& any);
  std::uint64_t of(const RunSpec& run) const;

 private:
  std::vector<std::string> between_;  // the text of a key before, between and behind the values of swept fields
};

}  // namespace irk
