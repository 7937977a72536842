// The command line.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace irk {

inline constexpr int kFailedStatus = 1;
inline constexpr int kMisuseStatus = 2;
inline constexpr int kInterruptedStatus = 130;  ///< as shells report SIGINT

struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// Runs `irk arguments...`. Returns the exit status: 0 done; kFailedStatus; kMisuseStatus with one line
/// `irk: what, where, what is allowed` on `err`; kInterruptedStatus. Throws nothing. Output that cannot be written is
/// a failure.
int runProgram(const std::vector<std::string>& arguments, Streams streams);

}  // namespace irk
