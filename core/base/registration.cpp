#include "irk/registration.h"

#include <utility>
#include <vector>

namespace irk {
namespace {

std::vector<void (*)()>& waiting() {
  static std::vector<void (*)()> functions;
  return functions;
}

std::string& currentSource() {
  static std::string source;
  return source;
}

}  // namespace

Registration::Registration(void (*run)()) { waiting().push_back(run); }

std::size_t runRegistrations(std::string_view source) {
  struct Scope {
    explicit Scope(std::string_view text) { currentSource() = text; }
    ~Scope() { currentSource().clear(); }
  };
  const Scope scope(source);
  const auto functions = std::exchange(waiting(), {});
  for (const auto run : functions) run();
  return functions.size();
}

const std::string& registeringSource() { return currentSource(); }

}  // namespace irk
