#include "experiments/store/row_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <system_error>

#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"
#include "experiments/store/part.h"
#include "irk/misuse.h"
#include "irk/statistics.h"

namespace irk::store {
namespace {

using Kind = CellKinds::Kind;

template <class Number>
bool isAll(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool isNumber(std::string_view text) {
  double number = 0;
  return isAll(text, number);
}

bool areNumbers(std::string_view text) {
  while (!text.empty()) {
    const auto word = text.substr(0, text.find(' '));
    if (!isNumber(word)) return false;
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return true;
}

bool isCount(std::string_view text) {
  std::int64_t count = 0;
  return isAll(text, count) && count >= 0;
}

bool isHash(std::string_view text) {
  return !text.empty() && text.size() <= 16 &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

bool isOutcome(std::string_view text) {
  if (text == "refused") return true;  // orRefused
  for (int i = 0; i <= static_cast<int>(Outcome::kInaccurate); ++i) {
    if (text == name(static_cast<Outcome>(i))) return true;
  }
  return false;
}

bool isOfKind(Kind kind, std::string_view cell) {
  switch (kind) {
    case Kind::kText:
      return true;
    case Kind::kHash:
      return isHash(cell);
    case Kind::kNumber:
      return isNumber(cell);
    case Kind::kNumbers:
      return areNumbers(cell);
    case Kind::kCount:
      return isCount(cell);
    case Kind::kDate:
      return cell.empty() || secondsOf(cell) > 0;
    case Kind::kRequest:
      return cell.empty() || requestOf(cell) > 0;
    case Kind::kOutcome:
      return isOutcome(cell);
  }
  return true;
}

std::string_view wordFor(Kind kind) {
  switch (kind) {
    case Kind::kText:
      return "text";
    case Kind::kHash:
      return "hash of at most 16 hexadecimal digits";
    case Kind::kNumber:
      return "number";
    case Kind::kNumbers:
      return "list of numbers";
    case Kind::kCount:
      return "number of 0, 1, 2, ...";
    case Kind::kDate:
      return "date";
    case Kind::kRequest:
      return "number of 1, 2, 3, ... and no date";
    case Kind::kOutcome:
      return "outcome";
  }
  return "";
}

// Of the tables runs, states, environments, calibrations and timing_cores. A setting is checked by the row's key.
Kind kindOf(const std::string& column) {
  static const std::vector<std::string> counters = [] {
    std::vector<std::string> names{"cpu_runs", "stages", "cores", "cores_at_once", "taken"};
    Counters{}.forEach([&names](const char* name, std::int64_t) { names.emplace_back(name); });
    return names;
  }();
  constexpr std::string_view kHashes[] = {"key", "environment", "calibration", "trial"};
  constexpr std::string_view kMeasured[] = {
      "drift",     "invariant_change", "mescd",        "scd",           "reference_accuracy",
      "cpu_s",     "cpu_setup_s",      "cpu_median_s", "memory_gb",     "cpu_error_bar_s",
      "error",     "error_u",          "error_v",      "error_x",       "error_z",
      "error_bar", "error_bar_z",      "cpu_spread",   "calibration_s", "error_bar_tolerances",
      "t",         "error_t"};
  const auto isAmong = [&column](const auto& names) {
    return std::find(std::begin(names), std::end(names), column) != std::end(names);
  };
  if (column == "outcome") return Kind::kOutcome;
  if (isAmong(kHashes)) return Kind::kHash;
  if (isAmong(kMeasured) || column.ends_with("_over_time") || column.ends_with("_slower")) return Kind::kNumber;
  if (column == "cpu_all" || column == "state" || column == "bar") return Kind::kNumbers;
  if (column == "date" || column == "first_date") return Kind::kDate;
  if (column == "remade") return Kind::kRequest;
  return isAmong(counters) ? Kind::kCount : Kind::kText;
}

}  // namespace

std::uint32_t secondsOf(std::string_view date) {
  constexpr std::size_t kLength = 20;
  if (date.size() != kLength || date.back() != 'Z') return 0;
  const auto part = [date](std::size_t at, std::size_t length) {
    unsigned number = 0;
    std::from_chars(date.data() + at, date.data() + at + length, number);
    return number;
  };
  const std::chrono::sys_days day =
      std::chrono::year(static_cast<int>(part(0, 4))) / std::chrono::month(part(5, 2)) / std::chrono::day(part(8, 2));
  const auto seconds = day.time_since_epoch() / std::chrono::seconds(1) + std::int64_t{part(11, 2)} * 3600 +
                       std::int64_t{part(14, 2)} * 60 + part(17, 2);
  return static_cast<std::uint32_t>(seconds);
}

std::uint32_t requestOf(std::string_view remade) {
  std::uint32_t number = 0;
  return isAll(remade, number) ? number : secondsOf(remade);
}

CellKinds::CellKinds(const std::vector<std::string>& columns) : columns_(columns) {
  for (const auto& column : columns) kinds_.push_back(kindOf(column));
}

std::string CellKinds::problemOf(const std::vector<std::string_view>& cells) const {
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (!isOfKind(kinds_[i], cells[i]))
      return fmt::format("{}: '{}' is no {}", columns_[i], cells[i], wordFor(kinds_[i]));
  }
  return {};
}

RowKeys::RowKeys(const std::vector<std::string>& columns) {
  for (const auto& field : specFields()) {
    at_.push_back(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), field.name) - columns.begin()));
  }
}

bool RowKeys::isOfSeries(const std::vector<std::string_view>& cells) const {
  if (fixed_.empty()) return false;
  const auto fields = specFields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].swept && cells[at_[i]] != fixed_[i]) return false;
  }
  return true;
}

void RowKeys::readSeries(const std::vector<std::string_view>& cells) {
  const auto fields = specFields();
  known_ = false;
  fixed_.assign(fields.size(), "");
  between_.assign(1, "");
  RunSpec spec;
  try {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string cell = plainCell(cells[at_[i]]);
      fields[i].set(spec, cell);
      between_.back().append(i == 0 ? "" : ";").append(fields[i].name) += '=';
      if (fields[i].swept) {
        between_.emplace_back();
      } else {
        fixed_[i] = cells[at_[i]];
        between_.back() += cell;
      }
    }
    between_.back() += keyText(spec, findScene(spec.scene).parameters).substr(canonicalText(spec).size());
    known_ = true;
  } catch (const Misuse&) {
    fixed_.clear();
  }
}

std::optional<std::uint64_t> RowKeys::keyOf(const std::vector<std::string_view>& cells) {
  if (!isOfSeries(cells)) readSeries(cells);
  if (!known_) return {};
  const auto fields = specFields();
  std::string text = between_.front();
  std::size_t next = 1;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].swept) text.append(cells[at_[i]]).append(between_[next++]);
  }
  return fnv1a(text);
}

}  // namespace irk::store
