// How long the rest of many runs will take, where runs of different kinds last differently long.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace irk {

/// Seconds are those of the runs themselves, whatever the number of threads. Not thread-safe.
class TimeLeft {
 public:
  /// Runs to come. A kind is what tells how long a run lasts: its scene and tolerance, say.
  void expect(const std::string& kind, std::size_t runs = 1);
  /// One of them has been made.
  void made(const std::string& kind, double seconds);
  /// Some of them need not be made.
  void dropped(const std::string& kind, std::size_t runs = 1);

  /// Of the runs to come. A kind of which none was made yet counts as the mean of all that were.
  double left() const;
  /// Of the runs that were made.
  double spent() const { return spent_; }

 private:
  struct Kind {
    std::size_t left = 0, made = 0;
    double seconds = 0;  // recent runs weigh more: the order of runs is not random
  };
  std::map<std::string, Kind> kinds_;
  std::size_t made_ = 0;
  double spent_ = 0;
};

}  // namespace irk
