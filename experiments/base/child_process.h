// Runs another program and waits for it.
#pragma once

#include <string>
#include <vector>

namespace irk {

struct ChildResult {
  int status = 0;        ///< its exit status; 1 if a signal ended it
  std::string messages;  ///< what it wrote to standard error
};

/// `words`: the program, looked for in PATH, and its arguments; no shell reads them. Standard output is that of this
/// program. Throws Failure, naming the program, if it cannot be started.
ChildResult runChild(std::vector<std::string> words);

}  // namespace irk
