// What a refused call says.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "irk/misuse.h"

namespace irk {

/// The message with which `action` refuses; empty if it does not refuse.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const Misuse& misuse) {
    return misuse.what();
  }
  return "";
}

/// Whether the text contains each of the parts; a failure shows the one that is missing, and the text.
inline testing::AssertionResult containsAll(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) {
    if (text.find(part) == std::string::npos) {
      return testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
    }
  }
  return testing::AssertionSuccess();
}
inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  return containsAll(text, {part});
}

}  // namespace irk
