// Tables of misuses: what is done wrong, and a part of the message that says so.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "tests/refusal.h"

namespace irk::test {

struct WrongUse {
  std::string what;
  std::string message;  ///< a part of it: place, value, allowed range
  std::function<void()> use;
};

/// Each use throws Misuse with its message.
inline void expectRefusals(std::initializer_list<WrongUse> uses) {
  for (const auto& [what, message, use] : uses) {
    const std::string said = refusal(use);
    EXPECT_TRUE(contains(said, message)) << what;
    EXPECT_FALSE(said.empty()) << what;
  }
}

}  // namespace irk::test
