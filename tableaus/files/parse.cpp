// Parses the text of a tableau file into numbers.
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/split.hpp>
#include <charconv>
#include <map>
#include <regex>
#include <utility>

#include "core/base/text.h"
#include "irk/misuse.h"
#include "tableaus/families/families.h"
#include "tableaus/files/file.h"

namespace irk {

using tableaus::Place;

namespace {

constexpr int kMinDigits = 15;  // as a double has; the default of the key `digits`
constexpr int kMaxDigits = kAnalysisDigits - 5;
constexpr std::size_t kMaxNumberLength = 200;

const std::vector<std::string>& headerKeys() {
  static const std::vector<std::string> keys = {"family",    "stages", "order", "stage_order",
                                                "order_hat", "source", "digits"};
  return keys;
}

constexpr std::pair<const char*, Place> kPlaces[] = {{"family", Place::kFamily},
                                                     {"order", Place::kOrder},
                                                     {"stage_order", Place::kStageOrder},
                                                     {"order_hat", Place::kOrderHat}};

struct Line {
  int number;
  std::string text;  ///< without surrounding blanks
};

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> result;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  return boost::split(result, text, is_blank, boost::token_compress_on);
}

class Parser {
 public:
  Parser(std::string_view text, std::string name) : name_(std::move(name)) {
    int number = 0;
    for (std::size_t start = 0; start < text.size(); ++number) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string line = trimmed(text.substr(start, end - start));
      if (!line.empty() && line.front() != '#') lines_.push_back({number + 1, line});
      start = end + 1;
    }
    last_line_ = std::max(number, 1);
  }

  TableauFile parse() {
    parseHeader();
    const int s = integer("stages", 1, static_cast<int>(kMaxStages));
    TableauFile file{};
    Tableau<BigFloat>& tableau = file.tableau;
    tableau.id = name_;
    tableau.family = header_.contains("family") ? header_["family"].text : "user";
    tableau.order = integer("order", 1, 2 * s);
    file.source = header_.contains("source") ? header_["source"].text : "";
    file.digits = header_.contains("digits") ? integer("digits", kMinDigits, kMaxDigits) : kMinDigits;
    for (const auto& [key, place] : kPlaces) {
      if (header_.contains(key)) file.lines[place] = header_[key].number;
    }

    tableau.A.resize(s, s);
    expectWord("A");
    for (int i = 0; i < s; ++i) {
      const std::string what = fmt::format("row {} of A", i + 1);
      file.row_lines.push_back(nextLine(what).number);
      tableau.A.row(i) = row(what, s).transpose();
    }
    expectWord("b");
    file.lines[Place::kWeights] = nextLine("the row of b").number;
    tableau.b = row("the row of b", s);
    expectWord("c");
    tableau.c = row("the row of c", s);
    parseEmbedded(s, file);
    if (position_ < lines_.size()) {
      const auto last = tableau.b_hat.size() > 0 ? "b_hat" : "c";
      fail(lines_[position_].number, fmt::format("'{}' after the end of block {}", shown(), last));
    }
    tableau.stage_order = stageOrderOf(file);
    return file;
  }

 private:
  // The block b_hat and its key `order_hat`: both or neither.
  void parseEmbedded(int s, TableauFile& file) {
    const auto key = header_.find("order_hat");
    const bool has_block = position_ < lines_.size() && lines_[position_].text == "b_hat";
    if (!has_block && key == header_.end()) return;
    if (!has_block) fail(key->second.number, "'order_hat' without a block b_hat after block c");
    file.tableau.order_hat = integer("order_hat", 1, 2 * s);
    ++position_;
    file.lines[Place::kWeightsHat] = nextLine("the row of b_hat").number;
    file.tableau.b_hat = row("the row of b_hat", s);
  }

  [[noreturn]] void fail(int line, std::string_view reason) const {
    throw Misuse(fmt::format("{}:{}: {}", name_, line, reason));
  }

  /// The start of the current line, short enough for a message.
  std::string shown() const {
    constexpr std::size_t kShown = 30;
    const std::string& text = lines_[position_].text;
    std::string shown = text.size() <= kShown ? text : text.substr(0, kShown) + "...";
    // The message of an exception ends at the first zero byte.
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
    return shown;
  }

  const Line& nextLine(std::string_view wanted) const {
    if (position_ == lines_.size()) fail(last_line_, fmt::format("cut short: {} is missing", wanted));
    return lines_[position_];
  }

  void parseHeader() {
    for (; nextLine("block A").text != "A"; ++position_) {
      const auto& [number, text] = lines_[position_];
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos) {
        fail(number, fmt::format("'{}' is neither 'key: value' nor the start of block A", shown()));
      }
      const std::string key = trimmed(std::string_view(text).substr(0, colon));
      const std::string value = trimmed(std::string_view(text).substr(colon + 1));
      if (key == "A" || key == "b" || key == "c" || key == "b_hat") {
        fail(number, fmt::format("'{}': a block begins with a line '{}' without ':'", shown(), key));
      }
      if (std::ranges::find(headerKeys(), key) == headerKeys().end()) {
        fail(number, unknownName("key", key, headerKeys()));
      }
      if (value.empty()) fail(number, fmt::format("'{}' has no value", key));
      const auto [entry, is_new] = header_.try_emplace(key, Line{number, value});
      if (!is_new) {
        fail(number, fmt::format("'{}' again, first on line {}", key, entry->second.number));
      }
    }
  }

  int integer(const std::string& key, int low, int high) const {
    const auto entry = header_.find(key);
    if (entry == header_.end()) {
      fail(lines_[position_].number, fmt::format("the header has no '{}'", key));
    }
    const auto& [number, text] = entry->second;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < low || value > high) {
      fail(number, fmt::format("{}: '{}' is not a whole number from {} to {}", key, text, low, high));
    }
    return value;
  }

  void expectWord(std::string_view word) {
    if (nextLine(fmt::format("block {}", word)).text != word) {
      fail(lines_[position_].number, fmt::format("block {} expected, not '{}'", word, shown()));
    }
    ++position_;
  }

  Vec<BigFloat> row(const std::string& what, Index s) {
    const auto& [number, text] = nextLine(what);
    if (text == "b" || text == "c" || text == "b_hat") {
      fail(number, fmt::format("block {} starts, but {} is missing", text, what));
    }
    const std::vector<std::string> entries = words(text);
    const auto count = static_cast<Index>(entries.size());
    if (count != s) fail(number, fmt::format("{} has {} numbers, not {}", what, count, s));
    Vec<BigFloat> values(s);
    for (Index j = 0; j < s; ++j) {
      values[j] = numberOrFraction(entries[static_cast<std::size_t>(j)], number);
    }
    ++position_;
    return values;
  }

  BigFloat numberOrFraction(const std::string& word, int line) const {
    const std::size_t slash = word.find('/');
    if (slash == std::string::npos) return decimal(word, line);
    const BigFloat denominator = decimal(word.substr(slash + 1), line);
    if (denominator == 0) fail(line, fmt::format("'{}' divides by zero", word));
    return decimal(word.substr(0, slash), line) / denominator;
  }

  // An exponent has at most three digits, so that no value overflows and each is read quickly.
  BigFloat decimal(const std::string& word, int line) const {
    static const std::regex form(R"([+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?)");
    if (word.size() > kMaxNumberLength || !std::regex_match(word, form)) {
      fail(line, fmt::format("'{}' is not a finite number", word.substr(0, kMaxNumberLength)));
    }
    return BigFloat(word.front() == '+' ? word.substr(1) : word);
  }

  int stageOrderOf(const TableauFile& file) const {
    const Tableau<BigFloat>& tableau = file.tableau;
    const auto s = static_cast<int>(tableau.stages());
    if (header_.contains("stage_order")) return integer("stage_order", 0, s);
    if (const Family* family = findFamily(tableau.family)) return family->orders(s).q;
    return std::min(s, analyzeTableau(tableau, toleranceOfDigits(file.digits)).q);
  }

  std::string name_;
  std::vector<Line> lines_;
  int last_line_ = 1;
  std::size_t position_ = 0;
  std::map<std::string, Line> header_;
};

}  // namespace

TableauFile parseTableau(std::string_view text, const std::string& name) {
  const WorkingDigits digits(kAnalysisDigits);
  return Parser(text, name).parse();
}

}  // namespace irk
