#include "experiments/base/failure.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <filesystem>
#include <ios>
#include <new>
#include <string>

#include "experiments/base/streams.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::string oneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      line += c;
    }
  }
  return line;
}

// Whether the system is at fault (a full disk, no memory), not the user's input.
bool isFault(const std::error_code& code) {
  return code == std::errc::no_space_on_device || code == std::errc::io_error || code == std::errc::file_too_large ||
         code == std::errc::too_many_files_open;
}

std::string& blamed() {
  static std::string files;
  return files;
}

// The program itself throws none of these.
std::string unknownException(std::string_view what) {
  if (blamed().empty()) return fmt::format("internal error: {}", what);
  return fmt::format("code of {} throws: {}", blamed(), what);
}

}  // namespace

void blameExceptionsOn(const std::string& files) { blamed() = files; }

void printErrorLine(std::ostream& err, std::string_view text) { fmt::print(err, "irk: {}\n", oneLine(text)); }

int reportException(std::ostream& err) {
  try {
    throw;
  } catch (const Misuse& misuse) {
    printErrorLine(err, misuse.what());
    return kMisuseStatus;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    printErrorLine(err, path.empty() ? error.what() : fmt::format("{}: {}", path, error.code().message()));
    return isFault(error.code()) ? kFailedStatus : kMisuseStatus;
  } catch (const Failure& failure) {
    printErrorLine(err, failure.what());
  } catch (const std::ios_base::failure& error) {
    printErrorLine(err, fmt::format("input or output failed: {}", error.what()));
  } catch (const std::bad_alloc&) {
    printErrorLine(err,
                   blamed().empty() ? "out of memory" : fmt::format("out of memory, maybe by code of {}", blamed()));
  } catch (const std::exception& error) {
    printErrorLine(err, unknownException(error.what()));
  } catch (...) {
    printErrorLine(err, unknownException("an exception without text"));
  }
  return kFailedStatus;
}

}  // namespace irk
