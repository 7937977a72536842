// Test values for every field, derived from the field's own description, so that new fields are tested automatically.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/options/field.h"

namespace irk {

/// Values at the bounds of a range, inside and outside of it.
inline std::vector<double> probes(const Range& range) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double middle = std::isfinite(range.most - range.least) ? (range.least + range.most) / 2 : 0.5;
  std::vector<double> all{range.least, range.most, range.whole ? std::floor(middle) : middle};
  for (const double step : {0.5, 1.0, 2.0}) {
    for (const double bound : {range.least, range.most, 0.0}) all.insert(all.end(), {bound - step, bound + step});
  }
  all.insert(all.end(), {std::nan(""), kInfinity, -kInfinity});
  return all;
}
inline std::vector<double> legalValues(const Range& range) {
  auto all = probes(range);
  std::erase_if(all, [&](double x) { return !range.contains(x); });
  return all;
}
inline std::vector<double> illegalValues(const Range& range) {
  auto all = probes(range);
  std::erase_if(all, [&](double x) { return range.contains(x); });
  return all;
}

/// The number as the field's setter reads it.
template <class Spec>
std::string textOf(const Field<Spec>& field, double x) {
  const bool integer = field.kind == FieldKind::kInteger && std::isfinite(x) && x == std::floor(x);
  return integer ? std::to_string(static_cast<std::int64_t>(x)) : numberText(x);
}

/// For axes all ids but the default, for numbers some legal values; nothing for texts.
template <class Spec>
std::vector<std::string> otherValues(const Field<Spec>& field) {
  std::vector<std::string> values;
  for (const auto& choice : field.kind == FieldKind::kAxis ? field.choices() : std::vector<Choice>{})
    values.push_back(choice.id);
  if (field.isNumeric()) {
    for (const double x : legalValues(field.range)) values.push_back(textOf(field, x));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::erase(values, field.defaultText());
  return values;
}

}  // namespace irk
