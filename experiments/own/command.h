// The command that compiled this program. Generated when the build is configured: experiments/own/command.cpp.in.
#pragma once

#include <string_view>

namespace irk::own {

/// Lists are separated by ';'.
struct CompileCommand {
  std::string_view compiler;     ///< path
  std::string_view options;      ///< of the build, with definitions
  std::string_view own_folders;  ///< of headers, in the sources
  std::string_view folders;      ///< of other libraries' headers
};
const CompileCommand& compileCommand();

}  // namespace irk::own
