// The facts of a stored row that decide about later runs of its series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "experiments/store/rows.h"
#include "experiments/study/series_walk.h"

namespace irk::store {

/// Includes the errors only if the series is planned: they must be read from the file again.
RunFacts factsOf(const Rows& runs, const Entry& entry, bool planned);

/// The timing class of a row. Times are comparable if the machines are equal, and the names of one library.
struct RowClass {
  std::string machine;  ///< the class without the library of the row's method
  std::string library;  ///< `SUNDIALS`; empty: the method is the suite's own
  std::string name;     ///< the class
};

/// The timing classes (tables/timing_class.h) of rows' times. Keeps references to its arguments. Not thread-safe.
class TimingClasses {
 public:
  TimingClasses(const Rows& runs, const Rows& environments);

  /// All `unknown` but the library if the environment of the row's times is not stored. The library depends on the
  /// row's method, which is read only if there are several environments.
  const RowClass& of(const Entry& entry);

 private:
  const Rows& runs_;
  const Rows& environments_;
  std::size_t method_;                                               // its column
  std::map<std::pair<std::uint16_t, std::string>, RowClass> known_;  // by environment and library
};

}  // namespace irk::store
