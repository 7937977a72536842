#include "experiments/base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <iostream>

#include "experiments/base/clock.h"

namespace irk {
namespace {

constexpr double kTerminalInterval = 0.2, kFileInterval = 10;  // s
constexpr const char* kRewrite = "\r\033[K";

bool isTerminal(const std::ostream& out) { return &out == &std::cerr && isatty(STDERR_FILENO) == 1; }

}  // namespace

Progress::Progress(std::ostream& out, std::string label)
    : out_(out), label_(std::move(label)), start_(wallSeconds()), shown_(start_), terminal_(isTerminal(out)) {
  interval_ = terminal_ ? kTerminalInterval : kFileInterval;
}

Progress::~Progress() {
  if (terminal_ && !note_.empty()) out_ << kRewrite << std::flush;
  if (made_ == 0) return;
  out_ << (terminal_ ? kRewrite : "")
       << fmt::format("{}: {} runs made in {}, {} there already or not needed\n", label_, made_,
                      durationText(wallSeconds() - start_), skipped_)
       << std::flush;
}

void Progress::expect(const std::string& kind) {
  ++total_;
  time_.expect(kind);
}

void Progress::finished(const std::string& kind, double seconds) {
  ++made_;
  note_.clear();
  time_.made(kind, seconds);
  show();
}

void Progress::skipped(const std::string& kind) {
  ++skipped_;
  time_.dropped(kind);
  show();
}

void Progress::stored(std::size_t runs) {
  total_ += runs;
  skipped_ += runs;
}

void Progress::note(std::string text) {
  if (!terminal_) return;
  note_ = std::move(text);
  show();
}

void Progress::show() {
  const double now = wallSeconds();
  if (now - shown_ < interval_ || (made_ == 0 && note_.empty())) return;
  shown_ = now;
  out_ << (terminal_ ? kRewrite : "") << text() << (terminal_ ? "" : "\n") << std::flush;
}

std::string Progress::text() const {
  const std::size_t done = made_ + skipped_;
  const std::string now = note_.empty() ? "" : "; " + note_;
  if (made_ == 0) return fmt::format("{}: {}/{} runs{}", label_, done, total_, now);
  // Wall time per second of run time so far: it accounts for the number of threads and for other load.
  const double pace = time_.spent() > 0 ? (wallSeconds() - start_) / time_.spent() : 0;
  const double left = pace * time_.left();
  return fmt::format("{}: {}/{} runs, {} %, about {} left{}", label_, done, total_,
                     total_ == 0 ? 100 : 100 * done / total_, durationText(left), now);
}

StatusLine::StatusLine(std::ostream& out) : out_(out), terminal_(isTerminal(out)) {}

void StatusLine::show(const std::string& text) {
  if (!terminal_ || (text.empty() && !shown_)) return;
  shown_ = !text.empty();
  out_ << kRewrite << text << std::flush;
}

std::string durationText(double seconds) {
  const auto s = static_cast<long>(std::lround(seconds));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace irk
