// What a refused call says.
#pragma once

#include <string>

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

}  // namespace irk
