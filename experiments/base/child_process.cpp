#include "experiments/base/child_process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

#include "experiments/base/failure.h"

namespace irk {

ChildResult runChild(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages(std::tmpfile(), std::fclose);
  if (!messages) throw Failure("no temporary file for the messages of " + words.front());
  posix_spawn_file_actions_t redirect;
  posix_spawn_file_actions_init(&redirect);
  posix_spawn_file_actions_adddup2(&redirect, fileno(messages.get()), STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, words.front().c_str(), &redirect, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&redirect);
  if (error != 0) throw Failure(words.front() + " cannot be started: " + std::strerror(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ChildResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 1, {}};
  std::rewind(messages.get());
  char buffer[4096];
  for (std::size_t read; (read = std::fread(buffer, 1, sizeof buffer, messages.get())) > 0;) {
    result.messages.append(buffer, read);
  }
  return result;
}

namespace {

// $'...' of bash: a line end would end a comment.
std::string ansiQuoted(const std::string& text) {
  std::string quoted = "$'";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (std::iscntrl(code) != 0) {
      const char* digits = "0123456789abcdef";
      quoted += {'\\', 'x', digits[code / 16], digits[code % 16]};
    } else {
      if (c == '\'' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted + "'";
}

}  // namespace

std::string shellWord(const std::string& text) {
  constexpr std::string_view kPlain = "-_./=+:@,%";
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || kPlain.find(static_cast<char>(c)) != kPlain.npos;
  });
  if (plain) return text;
  const bool has_control = std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; });
  if (has_control) return ansiQuoted(text);
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string programCommand(const std::vector<std::string>& arguments) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw Failure("the program's own path is not known: /proc/self/exe: " + error.message());
  std::string command = shellWord(program.string());
  for (const auto& argument : arguments) command += ' ' + shellWord(argument);
  return command;
}

}  // namespace irk
