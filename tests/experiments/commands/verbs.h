// A folder with a small study, for the tests of verbs.
#pragma once

#include <gtest/gtest.h>
#include <csignal>
#include <fstream>
#include <iterator>

#include "experiments/study/study.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {

// The block, the scene and the formulations are those of the built-in study `drift`, so that its figures can be drawn.
inline constexpr char kSmall[] = R"(
title = "Small"
targets = [1e-2, 1e-4]
[defaults]
formulation = ["index2", "ggl"]
methods = ["radau_iia_3", "radau_iia_5"]
tolerances = [1e-3, 1e-5]
[timing]
min_time_s = 0.0005
repetitions = 2
[[block]]
name = "pendulum"
scene = "pendulum"
t_end = 0.5
)";

/// A temporary folder with a study file and results.
class Verbs : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(study()) << kSmall; }
  std::string study() const { return folder_.path() / "small.toml"; }
  std::string results(const std::string& name = "results") const { return folder_.path() / name; }
  Ended run(const std::string& into = "results", std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", study(), "--results", results(into), "--jobs", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program(arguments);
  }
  Table runs(const std::string& into = "results") const {
    return readTable(std::filesystem::path(results(into)) / "small" / "runs.csv");
  }
  bool exists(const std::string& file) const { return std::filesystem::exists(results() + "/" + file); }

  TemporaryFolder folder_;
};

}  // namespace irk
