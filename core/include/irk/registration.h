// What a file outside the tree adds to the program: scenes, integrators, strategies.
//
//   IRK_REGISTER { irk::registerStrategy<irk::StepControl>({...}); }
//
// The function is run when the program starts, or when the program loads the file (`--load FILE.cpp`). It may throw
// Misuse, which ends the program with the message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace irk {

/// A static object: its function waits for runRegistrations.
class Registration {
 public:
  explicit Registration(void (*run)());
};

/// Runs the functions that wait, and forgets them; returns how many they were. `source`: the file that they come from,
/// for messages; empty: the program itself. Not from several threads at once.
std::size_t runRegistrations(std::string_view source);

/// The `source` of the registrations that are run now; else empty.
const std::string& registeringSource();

}  // namespace irk

#define IRK_JOINED_(a, b) a##b
#define IRK_JOINED(a, b) IRK_JOINED_(a, b)

/// Begins the body of a function that registers something; any number of them in a file.
#define IRK_REGISTER IRK_REGISTER_AS(IRK_JOINED(irk_register_, __LINE__))
#define IRK_REGISTER_AS(name)                                              \
  static void name();                                                      \
  static const ::irk::Registration IRK_JOINED(name, _is_registered){name}; \
  static void name()
