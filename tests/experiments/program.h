// Calls the program as a user does: arguments in, exit status and output out.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/commands/cli.h"
#include "tests/experiments/solve_schema.h"
#include "tests/refusal.h"

namespace irk {

struct Ended {
  int status;
  std::string out, err;
};

/// What `irk solve --json` prints has to follow its schema.
inline Ended program(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = runProgram(arguments, {out, err});
  const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  if (json && arguments.front() == "solve" && !out.str().empty()) {
    EXPECT_EQ(againstSolveSchema(out.str()), std::vector<std::string>{});
  }
  return {status, out.str(), err.str()};
}

/// What `irk solve arguments... --json` prints; the test fails if it ends with another status.
nlohmann::json solvedJson(std::vector<std::string> arguments, int status = 0);

using Line = std::vector<std::string>;

/// A line that the program refuses.
struct BadLine {
  int status;
  Line arguments;    ///< '@' stands for the test's folder
  std::string word;  ///< of the message
  Line more = {};    ///< words that are in it, too
};

/// The line with the folder for the first '@' of each argument.
inline Line withFolder(Line line, const std::filesystem::path& folder) {
  for (auto& argument : line) {
    const auto at = argument.find('@');
    if (at != std::string::npos) argument.replace(at, 1, folder.string());
  }
  return line;
}

/// Each line ends with its status and one line on `err` with its words, and prints nothing else.
inline void expectOneLine(const std::vector<BadLine>& lines, const std::filesystem::path& folder = {}) {
  for (const auto& [status, arguments, word, more] : lines) {
    std::string text;
    for (const auto& argument : arguments) text += argument + " ";
    const Ended ended = program(folder.empty() ? arguments : withFolder(arguments, folder));
    EXPECT_EQ(ended.status, status) << text << "\n" << ended.err;
    EXPECT_EQ(ended.out, "") << text;
    EXPECT_TRUE(ended.err.starts_with("irk: ")) << text << "\n" << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << text << "\n" << ended.err;
    EXPECT_TRUE(contains(ended.err, word)) << text;
    EXPECT_TRUE(containsAll(ended.err, more)) << text;
  }
}

}  // namespace irk
