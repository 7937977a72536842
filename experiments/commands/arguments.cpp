#include "experiments/commands/arguments.h"

#include <algorithm>

#include "core/base/text.h"
#include "irk/misuse.h"

namespace irk {

void refuseEmpty(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument.empty()) {
      throw Misuse(i == 0 ? "an empty argument: a verb is expected, see irk --help"
                          : "an empty value after '" + arguments[i - 1] + "': a value is expected");
    }
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1) {
      throw Misuse("an empty value in '" + argument + "': a value is expected");
    }
  }
}

void requireKnownVerb(CLI::App& parent, const std::vector<std::string>& arguments, std::size_t i) {
  const auto verbs = parent.get_subcommands({});
  if (verbs.empty() || i == arguments.size() || arguments[i].starts_with('-')) return;
  std::vector<std::string> known;
  for (auto* sub : verbs) {
    known.push_back(sub->get_name());
    if (known.back() == arguments[i]) return requireKnownVerb(*sub, arguments, i + 1);
  }
  throw Misuse(unknownName("verb", arguments[i], known));
}

void requireKnownOption(const std::vector<std::string>& arguments) {
  const std::vector<std::string> known{"--help", "-h", "--version"};
  if (arguments.empty() || !arguments.front().starts_with('-')) return;
  if (std::find(known.begin(), known.end(), arguments.front()) == known.end()) {
    throw Misuse(unknownName("option before a verb", arguments.front(), known));
  }
}

std::string helpOf(const std::vector<std::string>& arguments) {
  const bool verb = !arguments.empty() && !arguments.front().starts_with('-');
  return verb ? "irk " + arguments.front() + " --help" : "irk --help";
}

const char* valueName(FieldKind kind) {
  switch (kind) {
    case FieldKind::kAxis:
      return "ID";
    case FieldKind::kNumber:
      return "NUMBER";
    case FieldKind::kInteger:
      return "INTEGER";
    case FieldKind::kText:
      break;
  }
  return "TEXT";
}

}  // namespace irk
