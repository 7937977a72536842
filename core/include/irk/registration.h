// How a file outside the tree adds scenes, integrators and strategies to the program.
//
//   IRK_REGISTER { irk::registerStrategy<irk::StepControl>({...}); }
//
// The function runs when the program starts, or when the program loads the file (`--load FILE.cpp`). If it throws
// Misuse, the program ends with the message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace irk {

/// A static object that keeps its function until runRegistrations runs it.
class Registration {
 public:
  explicit Registration(void (*run)());
};

/// Runs all kept functions once and returns their number. `source`: the file that they come from, for messages; empty
/// for the program itself. Must not be called from several threads at once.
std::size_t runRegistrations(std::string_view source);

/// The `source` of the registrations that are running; empty if none is.
const std::string& registeringSource();

}  // namespace irk

#define IRK_JOINED_(a, b) a##b
#define IRK_JOINED(a, b) IRK_JOINED_(a, b)

/// Begins the body of a function that registers something. A file may have any number of them.
#define IRK_REGISTER IRK_REGISTER_AS(IRK_JOINED(irk_register_, __LINE__))
#define IRK_REGISTER_AS(name)                                              \
  static void name();                                                      \
  static const ::irk::Registration IRK_JOINED(name, _is_registered){name}; \
  static void name()
