#include "experiments/study_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "experiments/numbers.h"

namespace irk {
namespace {

class FileReader {
 public:
  explicit FileReader(std::string file) : file_(std::move(file)) {}

  std::string place(const toml::source_region& region) const {
    return fmt::format("{}:{}", file_, region.begin.line);
  }

  [[noreturn]] void refuse(const toml::node& node, std::string_view reason) const {
    throw Misuse(fmt::format("{}: {}", place(node.source()), reason));
  }

  std::string scalar(std::string_view key, const toml::node& node) const {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
    if (const auto* number = node.as_floating_point()) return numberText(number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    refuse(node, fmt::format("{}: text, a number, true or false is expected", key));
  }

  StudyValue value(std::string_view key, const toml::node& node) const {
    StudyValue value{{}, place(node.source())};
    if (const auto* list = node.as_array()) {
      for (const auto& item : *list) {
        auto text = scalar(key, item);
        if (std::find(value.items.begin(), value.items.end(), text) != value.items.end()) {
          refuse(item, fmt::format("{}: '{}' twice in the list", key, text));
        }
        value.items.push_back(std::move(text));
      }
      if (value.items.empty()) refuse(node, fmt::format("{}: an empty list", key));
    } else {
      value.items.push_back(scalar(key, node));
    }
    return value;
  }

  const toml::table& table(std::string_view key, const toml::node& node) const {
    if (const auto* found = node.as_table()) return *found;
    refuse(node, fmt::format("{}: a table is expected", key));
  }

  enum class Quick { kRefused, kLeftOut };

  /// Overwrites `keys` with what the table holds.
  void merge(const toml::table& from, StudyKeys& keys, Quick quick) const {
    for (const auto& [key, node] : from) {
      if (key.str() == "quick") {
        if (quick == Quick::kLeftOut) continue;
        refuse(node, "a table 'quick' in this table has no effect: [quick], [block.quick], [timing.quick] or "
                     "[audit.quick] is expected");
      }
      keys.insert_or_assign(std::string(key.str()), value(key.str(), node));
    }
  }

  void mergeQuick(const toml::table& from, StudyKeys& keys) const {
    if (const auto* quick = from.get("quick")) merge(table("quick", *quick), keys, Quick::kRefused);
  }

 private:
  std::string file_;
};

constexpr std::string_view kStudyKeys[] = {"title",  "orders", "trajectories", "estimates",
                                           "energy", "phases", "timing",       "targets",
                                           "profile", "scaling", "audit", "defaults",
                                           "quick", "block"};

// A table of the study itself: `timing.repetitions`. Its table `quick` holds for --quick only.
void readStudyTable(const FileReader& reader, const std::string& key, const toml::node& node,
                    bool quick, StudyKeys& study) {
  const toml::table& table = reader.table(key, node);
  StudyKeys keys;
  reader.merge(table, keys, FileReader::Quick::kLeftOut);
  if (quick) reader.mergeQuick(table, keys);
  study[key] = {{"true"}, reader.place(node.source())};
  for (auto& [name, value] : keys) study[key + "." + name] = std::move(value);
}

void readStudyKey(const FileReader& reader, std::string_view key, const toml::node& node,
                  bool quick, StudyKeys& study) {
  if (key == "defaults" || key == "quick" || key == "block") return;
  if (std::find(std::begin(kStudyKeys), std::end(kStudyKeys), key) == std::end(kStudyKeys)) {
    reader.refuse(node, unknownName("key", key, {std::begin(kStudyKeys), std::end(kStudyKeys)}));
  }
  if (key == "timing" || key == "audit") {
    return readStudyTable(reader, std::string(key), node, quick, study);
  }
  study[std::string(key)] = reader.value(key, node);
}

// toml++ (3.3) asserts that a table's header goes on with its name, in a build without assertions it reads on:
// `[` at the end of a line ends the program. Lines that begin so are refused, those inside of lists as well: a study
// has no lists of lists.
void refuseNamelessTables(std::string_view text, const FileReader& reader) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || static_cast<unsigned char>(c) >= 0x80; };
  const auto mayBegin = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-\"']").find(c) != std::string_view::npos;
  };
  const auto trimmed = [&](std::string_view line) {
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    return line;
  };
  for (toml::source_index number = 1; !text.empty();) {
    const auto end = std::min(text.find_first_of("\n\v\f\r"), text.size());
    const auto line = trimmed(text.substr(0, end));
    if (line.starts_with('[')) {
      const auto name = trimmed(line.substr(line.starts_with("[[") ? 2 : 1));
      if (name.empty() || !mayBegin(name.front())) {
        throw Misuse(fmt::format("{}: a table's name is expected after '['", reader.place({{number, 1}, {}, {}})));
      }
    }
    if (end < text.size() && text[end] == '\n') ++number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

toml::table parsed(std::string_view text, const FileReader& reader) {
  refuseNamelessTables(text, reader);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Misuse(fmt::format("{}: {}", reader.place(error.source()), error.description()));
  }
}

}  // namespace

StudyFile parseStudyFile(std::string_view text, const std::string& file, StudyVariant variant) {
  const FileReader reader(file);
  const toml::table root = parsed(text, reader);
  StudyFile result;
  const bool quick = variant == StudyVariant::kQuick;
  for (const auto& [key, node] : root) readStudyKey(reader, key.str(), node, quick, result.study);

  StudyKeys defaults;
  if (const auto* node = root.get("defaults"))
    reader.merge(reader.table("defaults", *node), defaults, FileReader::Quick::kRefused);
  const auto* blocks = root.get_as<toml::array>("block");
  if (root.contains("audit")) {
    for (const auto* key : {"block", "defaults", "quick"}) {
      const auto* node = root.get(key);
      if (node) reader.refuse(*node, fmt::format("{}: [audit] draws its runs: no {} beside it", key, key));
    }
    return result;
  }
  if (!blocks || blocks->empty()) throw Misuse(file + ": no [[block]]: a study needs at least one");
  for (const auto& node : *blocks) {
    const toml::table& block = reader.table("block", node);
    StudyKeys keys = defaults;
    reader.merge(block, keys, FileReader::Quick::kLeftOut);
    if (quick) reader.mergeQuick(root, keys);
    if (quick) reader.mergeQuick(block, keys);
    keys.try_emplace("scene", StudyValue{{}, reader.place(node.source())});
    result.blocks.push_back(std::move(keys));
  }
  return result;
}

}  // namespace irk
