// Estimates the time that many runs of different lengths still need.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace irk {

/// Counts the seconds of the runs themselves, regardless of the number of threads. Not thread-safe.
class TimeLeft {
 public:
  /// Announces runs. Runs of one `kind` (scene and tolerance, say) take about the same time.
  void expect(const std::string& kind, std::size_t runs = 1);
  /// One announced run has been made.
  void made(const std::string& kind, double seconds);
  /// Some announced runs need not be made.
  void dropped(const std::string& kind, std::size_t runs = 1);

  /// Seconds of the runs to come. A kind without finished runs counts with the mean over all finished runs.
  double left() const;
  /// Runs to come whose kind has no finished run.
  std::size_t guessed() const;
  /// Seconds of the finished runs.
  double spent() const { return spent_; }

 private:
  struct Kind {
    std::size_t left = 0, made = 0;
    double seconds = 0;  // recent runs weigh more: the order of runs is not random
  };
  Kind& kindOf(const std::string& name);
  std::map<std::string, Kind> kinds_;
  std::size_t made_ = 0;
  double spent_ = 0;
};

}  // namespace irk
