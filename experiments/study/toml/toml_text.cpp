#include "experiments/study/toml/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "irk/misuse.h"

namespace irk {
namespace {

// toml++ (3.3) removes tables within tables by recursion, which ends the program at some 50 000; a study has three.
constexpr std::ptrdiff_t kMaxKeyParts = 1000;

void refuseDeepKeys(std::string_view text, const std::string& file) {
  std::istringstream lines{std::string(text)};
  int number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    const auto equals = line.find('=');
    if (equals == line.npos && !line.starts_with('[')) continue;  // inside a list
    const auto key = std::string_view(line).substr(0, equals);
    if (std::count(key.begin(), key.end(), '.') < kMaxKeyParts) continue;
    throw Misuse(fmt::format("{}:{}: a key of more than {} parts with '.' between them", file, number, kMaxKeyParts));
  }
}

}  // namespace

toml::table parseToml(std::string_view text, const std::string& file) {
  refuseDeepKeys(text, file);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const std::string_view what = error.description();
    const bool open = what.find("unescaped control characters") != what.npos;
    throw Misuse(
        fmt::format("{}:{}: {}", file, error.source().begin.line, open ? "a text without its closing quote" : what));
  }
}

}  // namespace irk
