// Progress over several studies that run one after the other, for `irk paper`.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace irk {

class StudiesProgress {
 public:
  /// The studies in their order, each with the expected number of its runs.
  explicit StudiesProgress(std::vector<std::pair<std::string, std::size_t>> studies) : studies_(std::move(studies)) {}

  /// The line before study number `next` (from 0): `study 3 of 23, order: 400 of 20000 runs done, 2 %, about 12:00
  /// left for all studies`. `seconds` is the wall time of the studies before it. The time left takes the mean time of
  /// their runs, so it is missing before the first.
  std::string line(std::size_t next, double seconds) const;

 private:
  std::size_t runsBefore(std::size_t study) const;

  std::vector<std::pair<std::string, std::size_t>> studies_;
};

}  // namespace irk
