// The program in a process of its own, in a folder with a user's files.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "experiments/runs/setup.h"
#include "tests/experiments/support.h"

namespace irk {

struct Ran {
  int status;
  std::string text;  ///< standard output and standard error
};

class OwnFiles : public testing::Test {
 protected:
  /// The program in this test's folder, with a cache of its own.
  Ran irk(const std::string& arguments, const std::string& environment = {}) const {
    const std::string command = "cd " + folder_.path().string() + " && IRK_CACHE=" + folder_.path().string() +
                                "/cache " + environment + " " IRK_PROGRAM " " + arguments + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    Ran ran{0, {}};
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) ran.text.append(buffer, n);
    const int status = pclose(pipe);
    ran.status = WEXITSTATUS(status);
    return ran;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
  std::string read(const std::string& name) const { return readInputFile(folder_.path() / name); }
  std::string replaced(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read(name);
    EXPECT_NE(text.find(from), text.npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }
  /// The program refuses the scene of this file, in one line with this text.
  void expectRefused(const std::string& file, const std::string& text, const std::string& environment = {}) const {
    const Ran ran = irk("solve " + file + " --method radau_iia_3 --tol 1e-6", environment);
    EXPECT_EQ(ran.status, 2) << file << ": " << ran.text;
    EXPECT_NE(ran.text.find(text), std::string::npos) << file << ": " << ran.text;
    EXPECT_EQ(std::count(ran.text.begin(), ran.text.end(), '\n'), 1) << file << ": " << ran.text;
  }

  TemporaryFolder folder_;
};

inline RunSpec radauSpec(const std::string& scene, double tolerance = 1e-8) {
  RunSpec spec;
  spec.scene = scene;
  spec.method = "radau_iia_3";
  spec.options.tolerances.rtol = spec.options.tolerances.atol = tolerance;
  return spec;
}

/// To the end of the spec; where it gives none, to that of the scene.
inline Solution<double> integrated(const Setup<double>& setup) {
  const double t_end = setup.spec.t_end;
  auto integrator = setup.integrator();
  return integrator.integrate(setup.scene.start, std::isnan(t_end) ? setup.scene.t_end : t_end);
}

}  // namespace irk
