// The command line.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace irk {

inline constexpr int kMisuseStatus = 2;
inline constexpr int kInterruptedStatus = 130;  ///< as shells report SIGINT

struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// Runs `irk arguments...`. Returns the exit status: 0 done, 1 the run failed, kMisuseStatus with a
/// message on `err`, kInterruptedStatus.
int runProgram(const std::vector<std::string>& arguments, Streams streams);

}  // namespace irk
