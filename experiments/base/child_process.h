// Other programs: runs one and waits for it, and writes commands for a shell.
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

/// The text as one word of a shell's command, quoted where that is needed; with control characters in bash's form.
std::string shellWord(const std::string& text);

/// A shell's command that starts this program with these arguments: its absolute path, and every word quoted where that
/// is needed. It works in any folder and with any PATH.
std::string programCommand(const std::vector<std::string>& arguments);

}  // namespace irk
