#include "experiments/study/study_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "core/base/text.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/study/analysis.h"
#include "experiments/study/toml/figure_tables.h"
#include "experiments/study/toml/toml_text.h"

namespace irk {
namespace {

class FileReader {
 public:
  explicit FileReader(std::string file) : file_(std::move(file)) {}

  std::string place(const toml::source_region& region) const { return fmt::format("{}:{}", file_, region.begin.line); }

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
      std::unordered_set<std::string> known;
      for (const auto& item : *list) {
        auto text = scalar(key, item);
        if (!known.insert(text).second) {
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

  /// Sets the keys of `from` in `keys`, replacing earlier values.
  void merge(const toml::table& from, StudyKeys& keys, Quick quick) const {
    for (const auto& [key, node] : from) {
      if (key.str() == "quick") {
        if (quick == Quick::kLeftOut) continue;
        refuse(node,
               "a table 'quick' in this table has no effect: [quick], [block.quick], [timing.quick] or "
               "[audit.quick] is expected");
      }
      // The key `error_bar` sets the field `error_bars`.
      const auto field = key.str() == kErrorBarKey ? axisName<ErrorBarUse>() : key.str();
      keys.insert_or_assign(std::string(field), value(key.str(), node));
    }
  }

  void mergeQuick(const toml::table& from, StudyKeys& keys) const {
    if (const auto* quick = from.get("quick")) merge(table("quick", *quick), keys, Quick::kRefused);
  }

 private:
  std::string file_;
};

std::vector<std::string> studyKeys() {
  std::vector<std::string> keys{"title", "question", "load",  "trajectories", "timing",
                                "audit", "defaults", "quick", "block",        "figure"};
  for (const Analysis& analysis : analyses()) keys.emplace_back(analysis.key);
  return keys;
}

// Reads a table of the study itself, such as [timing]. Its table `quick` applies with --quick only.
void readStudyTable(const FileReader& reader, const std::string& key, const toml::node& node, bool quick,
                    StudyKeys& study) {
  const toml::table& table = reader.table(key, node);
  StudyKeys keys;
  reader.merge(table, keys, FileReader::Quick::kLeftOut);
  if (quick) reader.mergeQuick(table, keys);
  study[key] = {{"true"}, reader.place(node.source())};
  for (auto& [name, value] : keys) study[key + "." + name] = std::move(value);
}

void readStudyKey(const FileReader& reader, std::string_view key, const toml::node& node, bool quick,
                  StudyKeys& study) {
  if (key == "defaults" || key == "quick" || key == "block" || key == "figure") return;
  const auto known = studyKeys();
  if (std::find(known.begin(), known.end(), key) == known.end()) reader.refuse(node, unknownName("key", key, known));
  if (key == "timing" || key == "audit") {
    return readStudyTable(reader, std::string(key), node, quick, study);
  }
  study[std::string(key)] = reader.value(key, node);
}

// A name belongs to one block: in [defaults] or in a --quick table it would name several.
void refuseName(const FileReader& reader, const toml::table* from, std::string_view where) {
  const auto* name = from ? from->get("name") : nullptr;
  if (name) reader.refuse(*name, fmt::format("name: a [[block]] is named in itself, not in {}", where));
}

void refuseNames(const FileReader& reader, const toml::table& root, const toml::array& blocks) {
  refuseName(reader, root.get_as<toml::table>("defaults"), "[defaults]");
  refuseName(reader, root.get_as<toml::table>("quick"), "[quick]");
  for (const auto& node : blocks) {
    const auto* block = node.as_table();
    if (block) refuseName(reader, block->get_as<toml::table>("quick"), "[block.quick]");
  }
}

// The block's name, by default its number. Figures, claims and the column `block` use it.
void nameBlock(StudyKeys& keys, std::size_t number, const std::string& place, std::vector<std::string>& names) {
  const auto& name = keys.try_emplace("name", StudyValue{{fmt::format("block_{}", number)}, place}).first->second;
  const auto refuse = [&](std::string_view reason) { throw Misuse(fmt::format("{}: name: {}", name.place, reason)); };
  if (name.items.size() != 1) refuse("one word is expected, not a list");
  const std::string& text = name.items.front();
  const auto isPlain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (text.empty() || !std::all_of(text.begin(), text.end(), isPlain)) {
    refuse(fmt::format("'{}': letters, digits and _ are expected", text));
  }
  if (std::find(names.begin(), names.end(), text) != names.end()) {
    refuse(fmt::format("'{}' is another block's name", text));
  }
  names.push_back(text);
}

}  // namespace

StudyFile parseStudyFile(std::string_view text, const std::string& file, StudyVariant variant) {
  const FileReader reader(file);
  const toml::table root = parseToml(text, file);
  parseFigureTables(text, file);
  StudyFile result;
  const bool quick = variant == StudyVariant::kQuick;
  for (const auto& [key, node] : root) readStudyKey(reader, key.str(), node, quick, result.study);

  StudyKeys defaults, common_quick;
  if (const auto* node = root.get("defaults"))
    reader.merge(reader.table("defaults", *node), defaults, FileReader::Quick::kRefused);
  if (quick) reader.mergeQuick(root, common_quick);
  for (auto* keys : {&defaults, &common_quick}) {
    for (auto& [key, value] : *keys) value.common = true;
  }
  const auto* blocks = root.get_as<toml::array>("block");
  if (root.contains("audit")) {
    for (const auto& [key, name] :
         {std::pair("block", "[[block]]"), {"defaults", "[defaults]"}, {"quick", "[quick]"}}) {
      const auto* node = root.get(key);
      if (node) reader.refuse(*node, fmt::format("[audit] draws its runs: no {} beside it", name));
    }
    return result;
  }
  if (!blocks || blocks->empty()) throw Misuse(file + ": no [[block]]: a study needs at least one");
  refuseNames(reader, root, *blocks);
  std::vector<std::string> names;
  for (const auto& node : *blocks) {
    const toml::table& block = reader.table("block", node);
    StudyKeys keys = defaults;
    reader.merge(block, keys, FileReader::Quick::kLeftOut);
    for (const auto& [key, value] : common_quick) keys.insert_or_assign(key, value);
    if (quick) reader.mergeQuick(block, keys);
    keys.try_emplace("scene", StudyValue{{}, reader.place(node.source())});
    nameBlock(keys, names.size() + 1, reader.place(node.source()), names);
    result.blocks.push_back(std::move(keys));
  }
  return result;
}

}  // namespace irk
