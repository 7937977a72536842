#include "experiments/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <iostream>

#include "experiments/clock.h"

namespace irk {
namespace {

constexpr double kTerminalInterval = 0.2, kFileInterval = 10;  // s

}  // namespace

Progress::Progress(std::ostream& out, std::string label, std::size_t total)
    : out_(out),
      label_(std::move(label)),
      total_(total),
      start_(wallSeconds()),
      shown_(start_),
      terminal_(&out == &std::cerr && isatty(STDERR_FILENO) == 1) {
  interval_ = terminal_ ? kTerminalInterval : kFileInterval;
}

Progress::~Progress() {
  if (made_ == 0) return;
  out_ << (terminal_ ? "\r\033[K" : "")
       << fmt::format("{}: {} runs made in {}, {} there already or not needed\n", label_, made_,
                      durationText(wallSeconds() - start_), skipped_)
       << std::flush;
}

void Progress::finished(std::size_t count) {
  made_ += count;
  show();
}

void Progress::skipped(std::size_t count) {
  skipped_ += count;
  show();
}

void Progress::show() {
  const double now = wallSeconds();
  if (now - shown_ < interval_ || made_ == 0) return;
  shown_ = now;
  out_ << (terminal_ ? "\r\033[K" : "") << text() << (terminal_ ? "" : "\n") << std::flush;
}

std::string Progress::text() const {
  const std::size_t done = made_ + skipped_;
  const double each = (wallSeconds() - start_) / static_cast<double>(made_);
  const double left = each * static_cast<double>(total_ - std::min(done, total_));
  return fmt::format("{}: {}/{} runs, {} %, about {} left", label_, done, total_,
                     total_ == 0 ? 100 : 100 * done / total_, durationText(left));
}

std::string durationText(double seconds) {
  const auto s = static_cast<long>(std::lround(seconds));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace irk
