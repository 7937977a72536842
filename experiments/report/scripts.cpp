#include "experiments/report/scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

#include "core/base/input_file.h"
#include "core/base/text.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "irk/misuse.h"

namespace irk {
namespace {

bool isIn(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) {
    if (!isIn(found, (*i)[1].str())) found.push_back((*i)[1]);
  }
  return found;
}

std::vector<std::string> scriptNames(const std::filesystem::path& home) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(home / "plots")) {
    auto path = entry.path().lexically_relative(home / "plots");
    if (path.extension() == ".gp" && path.stem() != "style") names.push_back(path.replace_extension());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> wordsOf(const FigureOption& option) {
  std::vector<std::string> words;
  for (const auto& item : option.items) {
    std::istringstream in(item);
    words.insert(words.end(), std::istream_iterator<std::string>(in), {});
  }
  return words;
}

// Options whose words are columns.
constexpr std::string_view kColumnOptions[] = {"variant", "by", "panel_by", "quantity", "cost", "quantities", "costs"};

// The known columns: those of runs.csv and of tables that repeat them, and those that scripts compute themselves.
std::vector<std::string> knownColumns() {
  auto columns = runColumns();
  columns.insert(columns.end(), {std::string(kBlockColumn), "target_error", "iterations"});
  return columns;
}

void requireColumn(const FigureOption& option, std::string_view column) {
  static const auto known = knownColumns();
  if (isIn(known, column)) return;
  throw Misuse(fmt::format("{}: {}: unknown column '{}'; did you mean '{}'?", option.place, option.name, column,
                           nearestName(column, known)));
}

void checkColumns(const FigureOption& option) {
  if (std::find(std::begin(kColumnOptions), std::end(kColumnOptions), option.name) != std::end(kColumnOptions)) {
    for (const auto& word : wordsOf(option)) requireColumn(option, word);
  }
  if (option.name != "only") return;
  for (const auto& item : option.kind == FigureOption::Kind::kText ? wordsOf(option) : option.items) {
    const auto equals = item.find('=');
    if (equals == item.npos) {
      throw Misuse(fmt::format("{}: only: '{}': column=value is expected", option.place, item));
    }
    requireColumn(option, item.substr(0, equals));
  }
}

void checkBlocks(const FigureOption& option, const std::vector<std::string>& blocks) {
  if (blocks.empty() || (option.name != "block" && option.name != "cases" && option.name != "only")) return;
  constexpr std::string_view kBlock = "block=";
  for (auto word : wordsOf(option)) {
    if (option.name != "block") {
      if (!word.starts_with(kBlock)) continue;
      word = word.substr(kBlock.size(), word.find(':') - kBlock.size());
    }
    if (isIn(blocks, word)) continue;
    throw Misuse(fmt::format("{}: {}: {}", option.place, option.name, unknownName("block", word, blocks)));
  }
}

}  // namespace

Script readScript(const std::filesystem::path& home, const std::string& name) {
  const auto names = scriptNames(home);
  if (!isIn(names, name)) throw Misuse(unknownName("script", name, names));
  const std::string text = readInputFile(home / "plots" / (name + ".gp"));
  Script script;
  script.options = matches(text, "if \\(!exists\\(\"(\\w+)\"\\)\\)");
  const auto uses = [&](std::string_view part) { return text.find(part) != text.npos; };
  if (uses("ofScene(") || uses("ofCase(")) script.options.insert(script.options.end(), {"block", "scene"});
  if (uses("ofCase(")) script.options.emplace_back("settings");
  if (uses("= scene") && !isIn(script.options, "scene")) script.options.emplace_back("scene");
  for (const auto& line : matches(text, "# Reads ([^\n]*)")) {
    for (auto& table : matches(line, "(\\w+\\.csv)")) script.tables.push_back(std::move(table));
  }
  return script;
}

void checkFigure(const FigureTable& figure, const std::filesystem::path& home, const std::vector<std::string>& blocks) {
  Script script;
  try {
    script = readScript(home, figure.script);
  } catch (const Misuse& misuse) {
    throw Misuse(fmt::format("{}: {}", figure.place, misuse.what()));
  }
  for (const auto& option : figure.options) {
    if (!isIn(script.options, option.name)) {
      throw Misuse(fmt::format("{}: {}", option.place,
                               unknownName("option of the script " + figure.script, option.name, script.options)));
    }
    checkColumns(option);
    checkBlocks(option, blocks);
  }
}

}  // namespace irk
