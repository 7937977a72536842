// Shows whether the processor kept its speed while times were measured: a fixed computation, timed beside them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/store/rows.h"

namespace irk::store {

/// The columns of calibrations.csv: calibration (an id), environment, date, calibration_s.
std::vector<std::string> calibrationColumns();

/// Seconds of the thread's CPU clock that a fixed computation takes, the least of three. About 3 ms in all.
double calibrationSeconds();

/// The row of a calibration that was measured here and now.
TableRow calibrationRow(double seconds);

/// The head entry of a runs.csv for whose times there are calibration doubts. Its value names the hosts.
inline constexpr std::string_view kTimesDrift = "times drift";

/// Calibrations of one host.
struct HostCalibrations {
  std::string host, processor;
  std::vector<double> seconds;
};

/// Doubts about times as text; empty if there are none. They concern hosts of which at least one calibration in ten
/// takes 1.1 times their shortest one, and hosts whose median is 1.1 times that of the fastest host with the same
/// processor. Hosts with fewer than five calibrations are not judged.
std::string calibrationDoubts(std::vector<HostCalibrations> hosts);

/// Joins the calibrations with the hosts of their environments.
std::vector<HostCalibrations> calibrationsByHost(const Rows& calibrations, const Rows& environments);

/// How many times as long two fixed computations take on so many cores at once as on one alone; NaN: not measured.
struct CoresTrial {
  std::size_t cores;  ///< at least 1
  double elimination, vectors;
  bool taken;  ///< whether times were then measured on so many cores at once
};

/// The columns of timing_cores.csv: trial (an id), environment, date, cores_at_once, elimination_slower,
/// vectors_slower, taken (0 or 1).
std::vector<std::string> coresColumns();

/// The row of a trial that was made here and now.
TableRow coresRow(const CoresTrial& trial);

/// The head entry of a runs.csv: on how many cores at once its times were measured, by host: `2 on HOST`.
inline constexpr std::string_view kTimingCores = "timing cores";

/// Its value; empty without trials.
std::string takenCores(const Rows& trials, const Rows& environments);

}  // namespace irk::store
