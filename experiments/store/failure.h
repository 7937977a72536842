// What keeps a study's results from being read or written: exit status 1.
#pragma once

#include <stdexcept>

namespace irk::store {

/// No fault of the command: another writer, a full disk, times that cannot be joined. One line.
class StoreFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace irk::store
