// Progress over several studies that run one after the other, for `irk paper`.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace irk {

struct ExpectedStudy {
  std::string id;
  std::size_t runs = 0;
  double time_per_run = 1;  ///< in any unit, the same for all studies
};

class StudiesProgress {
 public:
  /// The studies in their order.
  explicit StudiesProgress(std::vector<ExpectedStudy> studies) : studies_(std::move(studies)) {}

  /// The line before study number `next` (from 0): `study 3 of 23, order: 400 of 20000 runs done, about 12:00 left for
  /// all studies`. `seconds` is the wall time of the studies before it. The time left is missing until one percent of
  /// the expected time is over.
  std::string line(std::size_t next, double seconds) const;

 private:
  std::vector<ExpectedStudy> studies_;
};

}  // namespace irk
