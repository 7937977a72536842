#include "experiments/study/toml/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "irk/misuse.h"

namespace irk {
namespace {

// Tables within tables, which toml++ reads and removes by recursion; a study has three at most.
constexpr std::ptrdiff_t kMaxKeyParts = 16;

// The text with strings and comments replaced by blanks; lines keep their numbers.
std::string structureOf(std::string_view text) {
  std::string bare(text);
  for (std::size_t at = 0; at < bare.size();) {
    const char c = bare[at];
    if (c == '#') {
      for (; at < bare.size() && bare[at] != '\n'; ++at) bare[at] = ' ';
    } else if (c == '"' || c == '\'') {
      const bool lines = text.substr(at).starts_with(std::string(3, c));
      const std::string end(lines ? 3 : 1, c);
      for (at += end.size(); at < bare.size() && !text.substr(at).starts_with(end); ++at) {
        if (bare[at] == '\n' && !lines) break;
        if (c == '"' && bare[at] == '\\' && at + 1 < bare.size()) bare[at++] = '_';
        if (bare[at] != '\n') bare[at] = '_';
      }
      at = std::min(at + end.size(), bare.size());
    } else {
      ++at;
    }
  }
  return bare;
}

// Refuses texts at which toml++ (3.3) ends the program, or without assertions reads past the end: a table without a
// name (`[` and the end of the line), some times of day, keys of very many parts, and in lists braces and blanks beyond
// ASCII. A study needs no braces, no times and no lists of lists.
void refuseUnreadable(std::string_view text, const std::string& file) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
  const auto isForeign = [&](char c) {
    const auto code = static_cast<unsigned char>(c);
    return !isBlank(c) && c != '\r' && (code < 0x20 || code >= 0x7f);
  };
  const auto mayBegin = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-\"'").find(c) != std::string_view::npos;
  };
  const auto trimmed = [&](std::string_view line) {
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    return line;
  };
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::string structure = structureOf(text);
  std::string_view rest = structure;
  for (int number = 1; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const auto line = trimmed(rest.substr(0, end));
    const auto refuse = [&](std::string_view reason) { throw Misuse(fmt::format("{}:{}: {}", file, number, reason)); };
    if (std::any_of(line.begin(), line.end(), isForeign)) {
      refuse("a character that is no printable ASCII, outside of quotes and comments");
    }
    if (line.find_first_of("{}") != line.npos) {
      refuse("a brace: a table of a study begins with a line [name], a list has brackets");
    }
    if (line.find(':') != line.npos) refuse("a colon outside of quotes and comments: a study has no times");
    if (line.starts_with('[')) {
      const auto name = trimmed(line.substr(line.starts_with("[[") ? 2 : 1));
      if (name.empty() || !mayBegin(name.front())) refuse("a table's name is expected after '['");
    }
    const auto equals = line.find('=');
    const auto key = line.substr(0, equals == line.npos && !line.starts_with('[') ? 0 : equals);
    if (std::count(key.begin(), key.end(), '.') >= kMaxKeyParts) {
      refuse(fmt::format("a key of more than {} parts with '.' between them", kMaxKeyParts));
    }
    ++number;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace

toml::table parseToml(std::string_view text, const std::string& file) {
  refuseUnreadable(text, file);
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
