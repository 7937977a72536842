// Errors that end the program: one line on standard error and an exit status.
#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irk {

/// The input is valid but the work could not be done: exit status 1. (Misuse means bad input: status 2.)
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Prints `irk: text` as one line; control characters are escaped.
void printErrorLine(std::ostream& err, std::string_view text);

/// From now on an exception of unknown kind is attributed to these users' files, instead of those given before.
void blameExceptionsOn(const std::string& files);

/// Call inside a catch block. Prints one line about the exception and returns the exit status: 2 for Misuse and for
/// files that cannot be used; 1 for a full disk, exhausted memory and everything else.
int reportException(std::ostream& err);

}  // namespace irk
