// The runs of a series, generated on demand: large studies keep no runs in memory.
#pragma once

#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// An iterator of a list that makes its elements on demand, at element i.
template <class List>
auto iteratorAt(const List& list, std::size_t i) {
  return boost::make_transform_iterator(boost::make_counting_iterator(i), std::bind_front(&List::operator[], &list));
}

/// The option in which the runs of a series differ.
enum class Swept {
  kNothing,     ///< one run, the base
  kTolerances,  ///< rtol = atol
  kStep,        ///< fixed steps, without an estimate of the error
};

/// Reads like a vector of specs, but every access makes a new spec: keep it by value or by a reference that extends
/// its life.
class SeriesRuns {
 public:
  SeriesRuns(RunSpec base) : base_(std::move(base)) {}  // NOLINT: one run is a series
  SeriesRuns(RunSpec base, Swept swept, std::vector<double> values)
      : base_(std::move(base)), swept_(swept), values_(std::move(values)) {}

  std::size_t size() const { return swept_ == Swept::kNothing ? 1 : values_.size(); }
  RunSpec operator[](std::size_t i) const;
  RunSpec front() const { return (*this)[0]; }
  auto begin() const { return iteratorAt(*this, 0); }
  auto end() const { return iteratorAt(*this, size()); }

 private:
  RunSpec base_;
  Swept swept_ = Swept::kNothing;
  std::vector<double> values_;
};

}  // namespace irk
