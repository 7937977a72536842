// Shared by the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "irk/misuse.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace irk {

/// The message of the Error that f throws; the test fails if it throws none.
template <class Error>
std::string thrownBy(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused, and nothing failed";
  return {};
}
inline std::string misuseOf(const std::function<void()>& f) { return thrownBy<Misuse>(f); }
inline std::string failureOf(const std::function<void()>& f) { return thrownBy<Failure>(f); }

}  // namespace irk
