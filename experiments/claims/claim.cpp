#include "experiments/claims/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/text.h"
#include "experiments/claims/builtin_protocol.h"
#include "experiments/study/toml/toml_text.h"
#include "irk/misuse.h"

namespace irk::claims {
namespace {

constexpr std::pair<std::string_view, Statistic> kStatistics[] = {{"median", Statistic::kMedian},
                                                                  {"share", Statistic::kShare},
                                                                  {"existence", Statistic::kExistence},
                                                                  {"report", Statistic::kReport}};

// Reads one table of the file; every key must be read.
class Reader {
 public:
  Reader(const toml::table& table, const std::string& file, std::string name)
      : table_(table), file_(file), name_(std::move(name)) {}

  [[noreturn]] void refuse(const toml::node& node, std::string_view reason) const {
    throw Misuse(fmt::format("{}:{}: {}: {}", file_, node.source().begin.line, name_, reason));
  }
  [[noreturn]] void refuse(std::string_view reason) const { refuse(table_, reason); }

  const toml::node* find(const std::string& key) {
    known_.insert(key);
    return table_.get(key);
  }
  std::string textOr(const std::string& key, std::string_view other) {
    const auto* node = find(key);
    if (!node) return std::string(other);
    if (!node->is_string() || node->as_string()->get().empty()) refuse(*node, key + ": text in quotes is expected");
    return node->as_string()->get();
  }
  std::string text(const std::string& key) {
    if (!table_.get(key)) refuse(fmt::format("no '{}'", key));
    return textOr(key, "");
  }
  bool flag(const std::string& key) {
    const auto* node = find(key);
    if (node && !node->is_boolean()) refuse(*node, key + ": true or false is expected");
    return node && node->as_boolean()->get();
  }
  std::vector<std::string> texts(const std::string& key) {
    const auto* node = find(key);
    std::vector<std::string> all;
    if (!node) return all;
    if (!node->is_array()) refuse(*node, key + ": a list is expected");
    for (const auto& item : *node->as_array()) {
      if (!item.is_string()) refuse(item, key + ": text in quotes is expected");
      all.push_back(item.as_string()->get());
    }
    return all;
  }
  // Returns the tables [[key]], at least one.
  std::vector<const toml::table*> tables(const std::string& key) {
    const auto* node = find(key);
    const bool are_tables = node && node->is_array() && !node->as_array()->empty() &&
                            std::all_of(node->as_array()->begin(), node->as_array()->end(),
                                        [](const toml::node& item) { return item.is_table(); });
    if (!are_tables) refuse(fmt::format("tables [[{}]] are expected", key));
    std::vector<const toml::table*> all;
    for (const auto& item : *node->as_array()) all.push_back(item.as_table());
    return all;
  }
  // Reads the keys at_least or above, at_most or below, with `prefix` before them.
  Range range(const std::string& prefix) {
    Range range;
    readEnd(range.low, range.low_open, prefix + "at_least", prefix + "above");
    readEnd(range.high, range.high_open, prefix + "at_most", prefix + "below");
    if (range.low > range.high) refuse("no value lies between the thresholds");
    return range;
  }
  void requireAllRead() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (!known_.contains(name)) refuse(node, unknownName("key", name, {known_.begin(), known_.end()}));
    }
  }

 private:
  void readEnd(double& end, bool& open, const std::string& closed_key, const std::string& open_key) {
    const auto* closed_end = find(closed_key);
    const auto* open_end = find(open_key);
    if (closed_end && open_end)
      refuse(*open_end, fmt::format("'{}' and '{}' exclude each other", open_key, closed_key));
    open = open_end != nullptr;
    const auto* node = open ? open_end : closed_end;
    if (!node) return;
    if (!node->is_number()) refuse(*node, "a threshold is a number");
    end = node->value<double>().value();
  }

  const toml::table& table_;
  const std::string& file_;
  std::string name_;
  std::set<std::string> known_;
};

void requireThresholds(const Reader& reader, const Part& part) {
  const bool wants_statistic = part.statistic == Statistic::kMedian || part.statistic == Statistic::kShare;
  const bool wants_case = part.statistic == Statistic::kShare || part.statistic == Statistic::kExistence;
  if (wants_statistic == part.confirmed.isEmpty()) {
    reader.refuse(wants_statistic ? "no threshold: at_least, above, at_most or below"
                                  : "thresholds at_least, above, at_most, below belong to a median or a share");
  }
  if (wants_case == part.clean.isEmpty()) {
    reader.refuse(wants_case ? "no threshold of a case: case_at_least, case_above, case_at_most or case_below"
                             : "thresholds case_... belong to a share or an existence");
  }
  const bool is_share = part.statistic == Statistic::kShare;
  if (is_share && !(part.confirmed.low >= 0 && part.confirmed.low <= 1 && part.confirmed.high == kInfinity)) {
    reader.refuse("a share has one threshold, at_least or above, from 0 to 1");
  }
}

Part partOf(const toml::table& table, const std::string& file) {
  Reader reader(table, file, "part");
  Part part{.id = reader.text("id"),
            .name = reader.text("name"),
            .measured = reader.text("measured"),
            .unit = reader.textOr("unit", "")};
  if (part.name.size() > 40) reader.refuse(*table.get("name"), "a name has up to 40 characters");
  const std::string statistic = reader.text("statistic");
  std::vector<std::string> known;
  bool found = false;
  for (const auto& [name, value] : kStatistics) {
    known.emplace_back(name);
    if (name != statistic) continue;
    part.statistic = value;
    found = true;
  }
  if (!found) reader.refuse(*table.get("statistic"), unknownName("statistic", statistic, known));
  part.confirmed = reader.range("");
  part.clean = reader.range("case_");
  requireThresholds(reader, part);
  part.yes_or_no = reader.flag("yes_or_no");
  const Range yes = part.clean;
  if (part.yes_or_no && !(yes.low == 1 && !yes.low_open && yes.high == kInfinity)) {
    reader.refuse("yes_or_no: a case is 1 or 0, so that case_at_least = 1 is expected");
  }
  part.multibody_only = reader.flag("multibody_only");
  part.not_applied = {reader.textOr("not_paper", ""), reader.textOr("not_best", "")};
  if (!part.not_applied[0].empty() && !part.not_applied[1].empty()) {
    reader.refuse("it applies to no setting: not_paper and not_best");
  }
  reader.requireAllRead();
  return part;
}

Change changeOf(const toml::table& table, const std::string& file) {
  Reader reader(table, file, "history");
  Change change{reader.text("date"), reader.text("change"), reader.text("reason")};
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < 10; ++i) {
    const bool hyphen = i == 4 || i == 7;
    if (change.date.size() == 10 && (hyphen ? change.date[i] == '-' : isDigit(change.date[i]))) continue;
    reader.refuse(*table.get("date"), fmt::format("date = '{}': year-month-day is expected", change.date));
  }
  reader.requireAllRead();
  return change;
}

Claim claimOf(const toml::table& table, const std::string& file) {
  Reader reader(table, file, "claim");
  Claim claim{.id = reader.text("id"),
              .title = reader.text("title"),
              .words = reader.text("words"),
              .section = reader.text("section"),
              .studies = reader.texts("studies"),
              .figures = reader.texts("figures"),
              .parts = {},
              .history = {}};
  for (const auto* part : reader.tables("part")) {
    claim.parts.push_back(partOf(*part, file));
    if (!claim.parts.back().id.starts_with(claim.id)) reader.refuse(*part, "the id of a part begins with the claim's");
  }
  for (const auto* change : reader.tables("history")) claim.history.push_back(changeOf(*change, file));
  reader.requireAllRead();
  return claim;
}

}  // namespace

std::string_view settingName(Setting setting) { return setting == Setting::kPaper ? "paper" : "best"; }

std::string rangeText(const Range& range) {
  if (range.isTwoSided()) return fmt::format("{:.4g} to {:.4g}", range.low, range.high);
  if (range.low != -kInfinity) return fmt::format("{} {:.4g}", range.low_open ? "above" : "at least", range.low);
  if (range.high != kInfinity) return fmt::format("{} {:.4g}", range.high_open ? "below" : "at most", range.high);
  return {};
}

std::string placeOf(const Claim& claim) {
  return claim.section.find_first_of("0123456789") == 0 ? "section " + claim.section : claim.section;
}

Protocol parseProtocol(std::string_view toml, const std::string& file) {
  const toml::table root = parseToml(toml, file);
  Reader reader(root, file, "claims");
  Protocol protocol{.claims = {}, .multibody = reader.texts("multibody")};
  std::set<std::string> ids;
  for (const auto* table : reader.tables("claim")) {
    protocol.claims.push_back(claimOf(*table, file));
    const Claim& claim = protocol.claims.back();
    bool is_new = ids.insert(claim.id).second;
    for (const auto& part : claim.parts) is_new = (part.id == claim.id || ids.insert(part.id).second) && is_new;
    if (!is_new) reader.refuse(*table, fmt::format("{}: an id occurs twice", claim.id));
  }
  reader.requireAllRead();
  return protocol;
}

const Protocol& protocol() {
  static const Protocol kProtocol = parseProtocol(builtinProtocol(), "claims.toml");
  return kProtocol;
}

}  // namespace irk::claims
