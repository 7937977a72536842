// How the cost of an integration is spread over time.
#pragma once

#include <atomic>
#include <vector>

#include "experiments/reference/question.h"

namespace irk {

/// From the steps of a cheap integration: steps of any other become short where its steps do.
class Course {
 public:
  Course() = default;
  /// The time before each step, ascending; less than two: nothing is known.
  explicit Course(std::vector<double> times) : times_(std::move(times)) {}

  bool known() const { return times_.size() > 1; }
  /// The part of all steps that lies before t: 0 to 1. Needs `known`.
  double part(double t) const;

 private:
  std::vector<double> times_;
};

/// The course up to `question.t_end`, from a run in double with a moderate tolerance; unknown if it fails or takes more
/// than `cpu_s`.
Course courseOf(const ReferenceQuestion& question, double cpu_s, const std::atomic<bool>* stop);

}  // namespace irk
