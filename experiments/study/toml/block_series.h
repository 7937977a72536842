// The series of a block of a study.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/runs/fields.h"
#include "experiments/study/series_list.h"
#include "experiments/study/study_file.h"

namespace irk {

/// The number of runs of each series of the block.
std::size_t runsOfSeries(const StudyKeys& keys);

/// Makes the series of a block: all combinations of the values of its spec fields, with each of its methods. The
/// constructor checks all of them; it throws Misuse with file and line.
class BlockSeries {
 public:
  BlockSeries(const StudyKeys& keys, std::vector<std::string> methods);
  std::size_t size() const { return combinations() * methods_.size(); }
  Series operator()(std::size_t i) const;

 private:
  struct Axis {
    const SpecField* field;
    StudyValue value;
  };
  void findAxes(const StudyKeys& keys);
  void findSweep(const StudyKeys& keys);
  std::size_t combinations() const;
  RunSpec combination(std::size_t i) const;

  std::vector<Axis> axes_;
  std::vector<std::string> methods_;
  std::string name_;
  Swept swept_ = Swept::kNothing;
  std::vector<double> values_;  // tolerances, steps, or the numbers of steps of planned series
  bool planned_ = false;
  std::vector<double> t_ends_, starts_;  // of each combination; starts of planned series only
};

}  // namespace irk
