// One line about how far a study is and how long it will take.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "experiments/base/time_left.h"

namespace irk {

/// On a terminal the line is rewritten in place; elsewhere a new line every ten seconds.
/// Not thread-safe: call it from within a critical section.
class Progress {
 public:
  Progress(std::ostream& out, std::string label);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A run to come; for kinds see TimeLeft.
  void expect(const std::string& kind);
  /// A run that was made now, and how long it took.
  void finished(const std::string& kind, double seconds);
  /// A run that is there already, or that need not be made.
  void skipped(const std::string& kind);

 private:
  void show();
  std::string text() const;

  std::ostream& out_;
  std::string label_;
  TimeLeft time_;
  std::size_t total_ = 0, made_ = 0, skipped_ = 0;
  double start_, shown_;
  double interval_;  ///< seconds between two lines
  bool terminal_;
};

/// `0:42`, `12:03`, `1:02:03`.
std::string durationText(double seconds);

}  // namespace irk
