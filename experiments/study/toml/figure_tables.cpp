#include "experiments/study/toml/figure_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "experiments/base/numbers.h"
#include "experiments/study/toml/toml_text.h"
#include "irk/misuse.h"

namespace irk {
namespace {

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  std::string place(const toml::node& node) const { return fmt::format("{}:{}", file_, node.source().begin.line); }
  [[noreturn]] void refuse(const toml::node& node, std::string_view reason) const {
    throw Misuse(fmt::format("{}: {}", place(node), reason));
  }

  std::string text(std::string_view key, const toml::node& node) const {
    const auto* text = node.as_string();
    if (!text) refuse(node, fmt::format("{}: text in quotes is expected", key));
    if (std::any_of(text->get().begin(), text->get().end(), isControl)) {
      refuse(node, fmt::format("{}: a control character; one line of text is expected", key));
    }
    return text->get();
  }

  /// Letters, digits and _.
  std::string word(std::string_view key, const toml::node& node) const {
    std::string word = text(key, node);
    const auto isPlain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (word.empty() || !std::all_of(word.begin(), word.end(), isPlain)) {
      refuse(node, fmt::format("{} = '{}': letters, digits and _ are expected", key, word));
    }
    return word;
  }

  FigureOption option(const std::string& key, const toml::node& node) const {
    FigureOption option{key, {}, FigureOption::Kind::kText, place(node)};
    if (const auto* integer = node.as_integer()) {
      option.items.push_back(std::to_string(integer->get()));
      option.kind = FigureOption::Kind::kNumber;
    } else if (const auto* number = node.as_floating_point()) {
      option.items.push_back(numberText(number->get()));
      option.kind = FigureOption::Kind::kNumber;
    } else if (const auto* list = node.as_array()) {
      option.kind = FigureOption::Kind::kList;
      for (const auto& item : *list) option.items.push_back(value(key, item));
    } else {
      option.items.push_back(value(key, node));
    }
    return option;
  }

 private:
  std::string value(const std::string& key, const toml::node& node) const {
    std::string value = text(key, node);
    const auto at = value.find_first_of("'\"`\\");
    if (at != value.npos) {
      refuse(node, fmt::format("{} = '{}': {} is not allowed in an option of a figure", key, value, value[at]));
    }
    return value;
  }

  const std::string& file_;
};

FigureTable figureOf(const Reader& reader, const toml::table& table) {
  FigureTable figure;
  figure.place = reader.place(table);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == "script" || name == "name") {
      (name == "script" ? figure.script : figure.name) = reader.word(name, node);
    } else if (name == "title" || name == "caption") {
      (name == "title" ? figure.title : figure.caption) = reader.text(name, node);
    } else {
      reader.word("the name of an option", toml::value<std::string>(name));
      figure.options.push_back(reader.option(name, node));
    }
  }
  if (figure.script.empty()) reader.refuse(table, "[[figure]] without script: a script of plots/, as \"work_by\"");
  if (figure.name.empty()) figure.name = figure.script;
  return figure;
}

// Text in quotes of TOML.
std::string inQuotes(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    all += c;
  }
  return all + '"';
}

std::string valueText(const FigureOption& option) {
  if (option.kind == FigureOption::Kind::kNumber) return option.items.front();
  if (option.kind == FigureOption::Kind::kText) return inQuotes(option.items.front());
  std::string text;
  for (const auto& item : option.items) text += (text.empty() ? "" : ", ") + inQuotes(item);
  return "[" + text + "]";
}

}  // namespace

FigureTables parseFigureTables(std::string_view toml, const std::string& file) {
  const Reader reader(file);
  const toml::table root = parseToml(toml, file);
  FigureTables tables;
  if (const auto* title = root.get("title"); title && title->is_string()) {
    tables.title = title->as_string()->get();
    std::replace_if(tables.title.begin(), tables.title.end(), isControl, ' ');
  }
  const auto* node = root.get("figure");
  if (!node) return tables;
  if (!node->is_array()) reader.refuse(*node, "figure: tables [[figure]] are expected");
  for (const auto& item : *node->as_array()) {
    if (!item.is_table()) reader.refuse(item, "figure: tables [[figure]] are expected");
    FigureTable figure = figureOf(reader, *item.as_table());
    for (const auto& other : tables.figures) {
      if (other.name != figure.name) continue;
      reader.refuse(item, fmt::format("name: '{}' is the figure at {}, too; give one of them another name", figure.name,
                                      other.place));
    }
    tables.figures.push_back(std::move(figure));
  }
  return tables;
}

std::string figureTablesText(const FigureTables& tables) {
  std::string text = fmt::format("title = {}\n", inQuotes(tables.title));
  for (const auto& figure : tables.figures) {
    text += fmt::format("\n[[figure]]\nscript = {}\nname = {}\n", inQuotes(figure.script), inQuotes(figure.name));
    if (!figure.title.empty()) text += fmt::format("title = {}\n", inQuotes(figure.title));
    if (!figure.caption.empty()) text += fmt::format("caption = {}\n", inQuotes(figure.caption));
    for (const auto& option : figure.options) text += fmt::format("{} = {}\n", option.name, valueText(option));
  }
  return text;
}

std::string assignmentsOf(const std::vector<FigureOption>& options) {
  std::string text;
  for (const auto& option : options) {
    if (!text.empty()) text += "; ";
    std::string value;
    for (const auto& item : option.items) {
      const bool quotes = option.kind == FigureOption::Kind::kList && (item.empty() || item.find(' ') != item.npos);
      value += (value.empty() ? "" : " ") + (quotes ? '"' + item + '"' : item);
    }
    text += option.kind == FigureOption::Kind::kNumber ? fmt::format("{}={}", option.name, value)
                                                       : fmt::format("{}='{}'", option.name, value);
  }
  return text;
}

}  // namespace irk
