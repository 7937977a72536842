#include "experiments/own/compiler.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/input_file.h"
#include "experiments/base/child_process.h"
#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/own/command.h"
#include "experiments/own/compiled_cache.h"
#include "experiments/own/crash.h"
#include "experiments/tables/build_info.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLines = 60;

std::vector<std::string> words(std::string_view list) {
  std::vector<std::string> all;
  std::istringstream in{std::string(list)};
  for (std::string word; std::getline(in, word, ';');) {
    if (!word.empty()) all.push_back(word);
  }
  return all;
}

// The program's own headers: beside an installed program, else in the sources of this build.
std::vector<std::string> ownFolders() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "include";
  if (fs::exists(installed / "irk" / "scene_file.h", none)) return {installed, installed / "irk" / "internal"};
  return words(compileCommand().own_folders);
}

std::string shortName(const fs::path& source) {
  std::error_code none;
  const fs::path relative = fs::proximate(source, none);
  return none || relative.string().size() > source.string().size() ? source.string() : relative.string();
}

std::vector<std::string> commandFor(const fs::path& source, int digits) {
  std::vector<std::string> command{std::string(compileCommand().compiler)};
  for (auto& word : words(compileCommand().options)) command.push_back(word);
  for (auto& folder : ownFolders()) command.push_back("-I" + folder);
  for (auto& folder : words(compileCommand().folders)) {
    const bool searched_anyway = folder == "/usr/include";  // gcc finds its own headers no longer if this is given
    if (!searched_anyway) command.insert(command.end(), {"-isystem", folder});
  }
  if (wantsChecks()) command.insert(command.end(), {"-UNDEBUG", "-D_GLIBCXX_ASSERTIONS", "-g", "-O1"});
  command.insert(command.end(), {fmt::format("-DIRK_DIGITS={}", digits), "-shared", "-fPIC", "-fmax-errors=5",
                                 "-fdiagnostics-color=never", source.string()});
  return command;
}

// Everything that an object depends on besides the file and its included files.
std::string identity(const fs::path& source, int digits) {
  std::string text = fmt::format("{} {} {}", buildInfo().version, buildInfo().code, buildInfo().compiler);
  for (const auto& word : commandFor(source, digits)) text += ' ' + word;
  return text;
}

bool isWithin(const std::string& file, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const auto& folder) { return file.starts_with(folder + '/'); });
}

// The folders of the program's headers: the rooms of core, and the folders of headers for users. Not the root of the
// sources, which is searched for headers as well but may contain files of the user.
std::vector<std::string> headerFolders() {
  std::vector<std::string> folders = ownFolders();
  for (auto& folder : folders) {
    const bool is_root = fs::exists(fs::path(folder) / "core");
    if (is_root) folder += "/core";
  }
  return folders;
}

// The prerequisites in a rule of make, which puts a backslash before a blank in a name and before the end of a line.
std::vector<std::string> prerequisites(const fs::path& rule) {
  std::ifstream in(rule);
  std::vector<std::string> files;
  std::string word, name;
  in >> word;  // the target
  while (in >> word) {
    const bool goes_on = word.back() == '\\';
    if (goes_on) word.back() = ' ';
    if (word == " ") continue;
    name += word;
    if (!goes_on) files.push_back(std::exchange(name, ""));
  }
  return files;
}

// Those that are neither the program's headers nor other libraries'.
std::vector<fs::path> userFiles(const std::vector<std::string>& files) {
  std::vector<std::string> theirs = headerFolders();
  for (auto& folder : words(compileCommand().folders)) theirs.push_back(folder);
  theirs.insert(theirs.end(), {"/usr/include", "/usr/lib"});
  std::vector<fs::path> users;
  for (const auto& file : files) {
    if (!isWithin(file, theirs)) users.emplace_back(file);
  }
  return users;
}

// Writes the compiler's messages about `source` to `log`, and throws Misuse.
[[noreturn]] void refuseSource(const fs::path& given, const fs::path& source, const std::string& messages,
                               std::ostream& log) {
  const std::string about = messagesAbout(source.string(), messages);
  log << (about.empty() ? messages : about);
  throw Misuse(refusalOf(given, source.string(), messages));
}

// Compiles `source`, given as `given`, to the cached object.
void compileTo(const CachedObject& cached, const fs::path& given, const fs::path& source, int digits,
               std::ostream& log) {
  std::error_code none;
  const fs::path made = cached.nameBeside();
  const fs::path rule = made.string() + ".d";
  auto command = commandFor(source, digits);
  command.insert(command.end(), {"-o", made.string(), "-MMD", "-MF", rule.string()});
  const ChildResult child = runChild(command);
  if (child.status != 0) {
    fs::remove(made, none);
    fs::remove(rule, none);
    cached.putFailure(child.messages);
    refuseSource(given, source, child.messages, log);
  }
  const auto all = prerequisites(rule);
  fs::remove(rule, none);
  try {
    requireHeadersOfProgram(all, "/proc/self/exe");
  } catch (const Misuse&) {
    fs::remove(made, none);
    throw;
  }
  cached.put(made, userFiles(all));
}

}  // namespace

std::string messagesAbout(const std::string& source, const std::string& messages) {
  std::istringstream in(messages);
  std::string kept;
  std::size_t lines = 0;
  bool follows = false;
  for (std::string line; std::getline(in, line) && lines < kMaxLines;) {
    const bool continues = line.starts_with(' ');
    follows = continues ? follows : line.starts_with(source) || line.find(" error: ") != line.npos;
    if (!follows) continue;
    kept += line + '\n';
    ++lines;
  }
  return kept;
}

std::string refusalOf(const fs::path& given, const std::string& source, const std::string& messages) {
  constexpr std::string_view kError = " error: ";
  std::istringstream in(messages);
  std::string place;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(source + ':')) {
      const auto begin = source.size() + 1, end = line.find_first_not_of("0123456789", begin);
      if (end > begin) place = ':' + line.substr(begin, end - begin);
    }
    const auto error = line.find(kError);
    if (error == line.npos || line.starts_with(' ')) continue;
    return fmt::format("{}{}: it does not compile: {}", given.string(), place, line.substr(error + kError.size()));
  }
  return given.string() + ": it does not compile";
}

void requireHeadersOfProgram(const std::vector<std::string>& files, const fs::path& program) {
  std::error_code none;
  const auto built = fs::last_write_time(program, none);  // of the file that runs, also if it has no name any more
  for (const auto& file : files) {
    if (!isWithin(file, headerFolders()) || fs::last_write_time(file, none) <= built) continue;
    constexpr std::string_view kGone = " (deleted)";  // as the system marks it
    std::string name = fs::read_symlink(program, none).string();
    if (name.ends_with(kGone)) {
      name.resize(name.size() - kGone.size());
      throw Misuse(fmt::format(
          "{} was replaced since this program was started from it, and {} is newer: start it again", name, file));
    }
    throw Misuse(fmt::format(
        "{} is newer than this program, which was built with a former version of it: build the program again", file));
  }
}

Compiled compile(const fs::path& source, int digits, std::ostream& log) {
  (void)readInputFile(source.string());  // for its message
  const fs::path file = fs::canonical(source);
  const std::string name =
      fmt::format("{}_{}_{}", file.stem().string(), hexText(fnv1a(file.string() + identity(file, digits))), digits);
  const CachedObject cached(compiledFolder(), name);
  Compiled compiled{cached.object(), {}};
  using State = CachedObject::State;
  if (cached.look(compiled.hash) == State::kCurrent) return compiled;

  const CompileLock lock(cached, shortName(source), log);
  const State state = cached.look(compiled.hash);
  if (state == State::kCurrent) return compiled;
  if (const auto messages = lock.waited() ? cached.failure() : std::nullopt) refuseSource(source, file, *messages, log);
  cached.forgetFailure();
  fmt::print(log, "irk: compiling {}{}{}\n", shortName(source), digits > 16 ? fmt::format(" in {} digits", digits) : "",
             state == State::kDamaged ? ": the object in the cache is damaged, or others can write to it" : "");
  log.flush();
  compileTo(cached, source, file, digits, log);
  if (cached.look(compiled.hash) != State::kCurrent) {
    throw Failure(
        fmt::format("{}: its object {} has changed since it was compiled", source.string(), cached.object().string()));
  }
  return compiled;
}

}  // namespace irk::own
