// Progress of a study: one line with the finished runs and the time that is left.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "experiments/base/time_left.h"

namespace irk {

/// On a terminal the line is rewritten in place; elsewhere a new line is printed every ten seconds. Not thread-safe:
/// call it inside a critical section.
class Progress {
 public:
  Progress(std::ostream& out, std::string label);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Announces a run. For `kind` see TimeLeft.
  void expect(const std::string& kind);
  /// A run has been executed; it took this long.
  void finished(const std::string& kind, double seconds);
  /// A run is stored already or need not be made.
  void skipped(const std::string& kind);
  /// So many runs are stored that were not announced.
  void stored(std::size_t runs);
  /// What is being done now, for terminals: behind the numbers until a run is finished.
  void note(std::string text);

 private:
  void show();
  std::string text() const;

  std::ostream& out_;
  std::string label_;
  TimeLeft time_;
  std::string note_;
  std::size_t total_ = 0, made_ = 0, skipped_ = 0;
  double start_, shown_;
  double interval_;  ///< seconds between two lines
  bool terminal_;
};

/// A line that is rewritten in place if `out` is standard error and a terminal; else nothing. Not thread-safe.
class StatusLine {
 public:
  explicit StatusLine(std::ostream& out);
  ~StatusLine() { show(""); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Empty: removes the line, as is necessary before any other output.
  void show(const std::string& text);

 private:
  std::ostream& out_;
  bool terminal_;
  bool shown_ = false;
};

/// `0:42`, `12:03`, `1:02:03`.
std::string durationText(double seconds);

}  // namespace irk
