// How the program ends in bad days: one line on standard error and an exit status.
#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string_view>

namespace irk {

/// What was asked for could not be done, though the input is fit: exit status 1. Misuse is status 2.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `irk: text` as one line; control characters are written as escapes.
void printErrorLine(std::ostream& err, std::string_view text);

/// Inside a catch block: prints the line of the exception that is being handled and returns the exit status.
/// Misuse and files that cannot be used are 2; a full disk, no memory, and everything else 1.
int reportException(std::ostream& err);

}  // namespace irk
