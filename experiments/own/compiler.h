// Compiles a user's file to a shared object, with the compiler and the flags of this program.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace irk::own {

/// A compiled file.
struct Compiled {
  std::filesystem::path object;  ///< in the user's cache
  std::string hash;              ///< of the file and its included files, without the program's headers
};

/// The object of `source` (a .cpp file) for numbers of 16, 50 or 100 digits. It comes from the cache if file, included
/// files, program and compiler are the same as when it was made, and its bytes are; otherwise it is compiled, with a
/// line on `log`. One process compiles a file, others wait for it (CompileLock). Throws Misuse for a file that cannot
/// be read, and for one that does not compile, after writing the compiler's messages to `log`, and for a cache that
/// others can write to; Failure if there is no compiler.
Compiled compile(const std::filesystem::path& source, int digits, std::ostream& log);

/// Lines of a compiler's messages about `source`: those that begin with its name, with the lines that belong to them,
/// and every error. At most 60.
std::string messagesAbout(const std::string& source, const std::string& messages);

/// `GIVEN:LINE: it does not compile: ERROR` with the first error of the messages; LINE is that of the error, or of the
/// last place of `source` before it, if the error is in another file.
std::string refusalOf(const std::filesystem::path& given, const std::string& source, const std::string& messages);

/// An object that was compiled with other headers than the program would spoil its memory: throws Misuse if one of the
/// program's own headers among `files` is newer than `program`, a link as /proc/self/exe, or says that the program was
/// replaced by a new build since it was started.
void requireHeadersOfProgram(const std::vector<std::string>& files, const std::filesystem::path& program);

}  // namespace irk::own
