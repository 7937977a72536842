// Shared by the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/input_file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace irk {

/// The message of the Misuse that f throws; the test fails if it throws none.
inline std::string misuseOf(const std::function<void()>& f) {
  try {
    f();
  } catch (const Misuse& misuse) {
    return misuse.what();
  }
  ADD_FAILURE() << "no misuse was reported";
  return {};
}

}  // namespace irk
