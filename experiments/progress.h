// One line about how far a study is and how long it will take.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace irk {

/// On a terminal the line is rewritten in place; elsewhere a new line every ten seconds.
/// Not thread-safe: call it from within a critical section.
class Progress {
 public:
  Progress(std::ostream& out, std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Runs that were made now: the time left is estimated from them.
  void finished(std::size_t count = 1);
  /// Runs that are there already, or that need not be made.
  void skipped(std::size_t count);

 private:
  void show();
  std::string text() const;

  std::ostream& out_;
  std::string label_;
  std::size_t total_, made_ = 0, skipped_ = 0;
  double start_, shown_;
  double interval_;  ///< seconds between two lines
  bool terminal_;
};

/// `0:42`, `12:03`, `1:02:03`.
std::string durationText(double seconds);

}  // namespace irk
