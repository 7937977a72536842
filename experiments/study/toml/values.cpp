#include "experiments/study/toml/values.h"

#include <fmt/format.h>

namespace irk::values {

const StudyValue* find(const StudyKeys& keys, std::string_view key) {
  const auto at = keys.find(key);
  return at == keys.end() ? nullptr : &at->second;
}

const std::string& single(std::string_view key, const StudyValue& value) {
  if (value.items.size() != 1) {
    throw Misuse(fmt::format("{}: {}: one value is expected, not a list", value.place, key));
  }
  return value.items.front();
}

double number(const StudyKeys& keys, std::string_view key, double fallback, const Range& range) {
  const auto* value = find(keys, key);
  if (!value) return fallback;
  return atPlace(*value, [&] { return parseNumber(key, single(key, *value), range); });
}

std::int64_t integer(const StudyKeys& keys, std::string_view key, std::int64_t fallback, std::int64_t min,
                     std::int64_t max) {
  const auto* value = find(keys, key);
  if (!value) return fallback;
  return atPlace(*value, [&] { return parseInteger(key, single(key, *value), Range::integers(min, max)); });
}

std::vector<double> numbers(const StudyValue& value, std::string_view key, const Range& range) {
  std::vector<double> all;
  for (const auto& item : value.items) {
    all.push_back(atPlace(value, [&] { return parseNumber(key, item, range); }));
  }
  return all;
}

bool flag(const StudyKeys& keys, std::string_view key) {
  const auto* value = find(keys, key);
  if (!value) return false;
  const auto& text = single(key, *value);
  if (text != "true" && text != "false") {
    throw Misuse(fmt::format("{}: {} = '{}': true or false", value->place, key, text));
  }
  return text == "true";
}

}  // namespace irk::values
