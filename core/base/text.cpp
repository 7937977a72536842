#include "core/base/text.h"

#include <algorithm>
#include <numeric>

namespace irk {
namespace {

// Levenshtein distance, one row at a time.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

}  // namespace

std::string nearestName(std::string_view given, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](auto& a, auto& b) { return editDistance(given, a) < editDistance(given, b); });
  return nearest == known.end() ? std::string() : *nearest;
}

std::string unknownName(std::string_view kind, std::string_view given, const std::vector<std::string>& known) {
  std::string list;
  for (const auto& name : known) list += (list.empty() ? "" : ", ") + name;
  return "unknown " + std::string(kind) + " '" + std::string(given) + "'; did you mean '" + nearestName(given, known) +
         "'? Known: " + list;
}

}  // namespace irk
