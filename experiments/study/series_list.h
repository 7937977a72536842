// The series of a study, made on demand: large studies keep none of them in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/study/series_runs.h"

namespace irk {

/// The rule by which later runs of a series are skipped.
enum class SeriesEnd {
  kAll,         ///< every run is made
  kAsymptotic,  ///< a StepPlanner chooses among them, to measure orders
  kTooLong,     ///< after a run that hit max_steps or the time limit, harder runs are recorded with its outcome
};

/// Runs of one method on one scene, made in order from the easiest to the hardest.
struct Series {
  SeriesRuns runs;
  SeriesEnd end = SeriesEnd::kAll;
  std::string block = {};  ///< the name of its block; empty for the runs of an audit
};

/// Reads like a vector of series, but every access makes a new one: keep it by value or by a reference that extends its
/// life. Thread-safe if the functions are.
class SeriesList {
 public:
  using Make = std::function<Series(std::size_t)>;

  SeriesList() = default;
  SeriesList(std::vector<Series> all);  // NOLINT: all of them, kept

  /// Appends the series make(0), ..., make(count - 1). A few of them are made once and kept.
  void append(std::size_t count, Make make);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// 0 <= i < size.
  Series operator[](std::size_t i) const;
  Series front() const { return (*this)[0]; }
  auto begin() const { return iteratorAt(*this, 0); }
  auto end() const { return iteratorAt(*this, size_); }

 private:
  struct Part {
    std::size_t first;
    Make make;
  };
  std::vector<Part> parts_;
  std::size_t size_ = 0;
};

}  // namespace irk
