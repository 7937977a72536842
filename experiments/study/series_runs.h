// The runs of a series, generated on demand: large studies keep no runs in memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

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
  class Iterator {
   public:
    Iterator(const SeriesRuns* runs, std::size_t at) : runs_(runs), at_(at) {}
    RunSpec operator*() const { return (*runs_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    const SeriesRuns* runs_;
    std::size_t at_;
  };

  SeriesRuns(RunSpec base) : base_(std::move(base)) {}  // NOLINT: one run is a series
  SeriesRuns(RunSpec base, Swept swept, std::vector<double> values)
      : base_(std::move(base)), swept_(swept), values_(std::move(values)) {}

  std::size_t size() const { return swept_ == Swept::kNothing ? 1 : values_.size(); }
  RunSpec operator[](std::size_t i) const;
  RunSpec front() const { return (*this)[0]; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

 private:
  RunSpec base_;
  Swept swept_ = Swept::kNothing;
  std::vector<double> values_;
};

}  // namespace irk
