// The program's output streams and exit statuses.
#pragma once

#include <iosfwd>

namespace irk {

inline constexpr int kFailedStatus = 1;
inline constexpr int kMisuseStatus = 2;
inline constexpr int kInterruptedStatus = 130;  ///< as shells report SIGINT

/// Results on `out`, progress and messages on `err`.
struct Streams {
  std::ostream& out;
  std::ostream& err;
};

}  // namespace irk
