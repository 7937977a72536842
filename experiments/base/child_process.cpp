#include "experiments/base/child_process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

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

}  // namespace irk
