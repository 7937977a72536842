// The program in a process of its own, in a folder with a user's files.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <string>

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

  TemporaryFolder folder_;
};

}  // namespace irk
