// The part of a stored row that a process holds in memory.
#pragma once

#include <cstdint>

namespace irk::store {

/// The place of a row and the facts that decide about it; its size does not depend on the row's length. `code`,
/// `environment`, `cpu_environment` and `outcome` are ids for `Rows::name`; 0 is the empty text.
struct Entry {
  std::uint64_t key = 0, offset = 0;
  std::uint32_t part = 0;
  std::uint32_t date = 0;         ///< seconds since 1970; 0 = none. For people: it decides nothing
  std::uint32_t request = 0;      ///< the number of the last request to make the run again; 0 = none
  std::uint16_t repetitions = 0;  ///< of the timing pass
  std::uint16_t code = 0, environment = 0, cpu_environment = 0, outcome = 0;
};

}  // namespace irk::store
