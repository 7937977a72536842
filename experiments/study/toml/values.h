// The values of a study's keys. Errors are Misuse with file and line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/study/study_file.h"
#include "irk/misuse.h"

namespace irk::values {

/// Calls f; a Misuse that it throws gets the value's place, unless it names a place in this file already.
template <class F>
auto atPlace(const StudyValue& value, F&& f) {
  try {
    return f();
  } catch (const Misuse& misuse) {
    const std::string reason = misuse.what(), file = value.place.substr(0, value.place.rfind(':') + 1);
    throw Misuse(!file.empty() && reason.starts_with(file) ? reason : value.place + ": " + reason);
  }
}

/// Returns nullptr for a key that is not given.
const StudyValue* find(const StudyKeys& keys, std::string_view key);
/// Refuses lists.
const std::string& single(std::string_view key, const StudyValue& value);
double number(const StudyKeys& keys, std::string_view key, double fallback, const Range& range);
std::int64_t integer(const StudyKeys& keys, std::string_view key, std::int64_t fallback, std::int64_t min,
                     std::int64_t max);
std::vector<double> numbers(const StudyValue& value, std::string_view key, const Range& range);
/// false for a key that is not given.
bool flag(const StudyKeys& keys, std::string_view key);

}  // namespace irk::values
