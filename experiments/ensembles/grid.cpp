#include "experiments/ensembles/grid.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/base/number_text.h"
#include "experiments/base/split.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr Range kCounts = Range::integers(2, Grid::kMostMembers);
constexpr std::string_view kLogarithmic = ":log";

// The values of `A..B:N` or `A..B:N:log`.
void appendRange(const std::string& place, std::string_view text, std::vector<std::string>& values) {
  const bool logarithmic = text.ends_with(kLogarithmic);
  if (logarithmic) text.remove_suffix(kLogarithmic.size());
  const std::size_t dots = text.find(".."), colon = text.find(':', dots);
  if (colon == std::string_view::npos) {
    throw Misuse(fmt::format("{} = '{}': a range is A..B:N, N numbers from A to B, or A..B:N:log", place, text));
  }
  const Range& range = logarithmic ? kPositive : kAnyNumber;
  const double first = parseNumber(place, text.substr(0, dots), range);
  const double last = parseNumber(place, text.substr(dots + 2, colon - dots - 2), range);
  const auto count = parseInteger(place, text.substr(colon + 1), kCounts);
  for (std::int64_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count - 1);
    const double inside = logarithmic ? first * std::pow(last / first, part) : first + (last - first) * part;
    values.push_back(i == 0 ? numberText(first) : i + 1 == count ? numberText(last) : fmt::format("{:.15g}", inside));
  }
}

}  // namespace

GridAxis gridAxis(std::string_view option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw Misuse(fmt::format("{} '{}': name=VALUES is expected", option, text));
  }
  GridAxis axis{text.substr(0, equals), {}};
  const std::string place = fmt::format("{} {}", option, axis.name);
  for (const std::string& item : split(std::string_view(text).substr(equals + 1), ',')) {
    if (item.empty()) throw Misuse(fmt::format("{} '{}': an empty item in a list", option, text));
    if (item.find("..") != std::string::npos) {
      appendRange(place, item, axis.values);
    } else {
      axis.values.push_back(item);
    }
  }
  return axis;
}

Grid::Grid(std::vector<GridAxis> parameters, std::vector<GridAxis> starts)
    : parameters_(std::move(parameters)), starts_(std::move(starts)) {
  for (const auto* axes : {&parameters_, &starts_}) {
    std::set<std::string> names;
    for (const GridAxis& axis : *axes) {
      if (!names.insert(axis.name).second) throw Misuse(fmt::format("'{}' is set twice", axis.name));
      if (size_ > kMostMembers / axis.values.size()) {
        throw Misuse(fmt::format("the grid has more than {} combinations", kMostMembers));
      }
      size_ *= axis.values.size();
    }
  }
  for (const GridAxis& axis : starts_) starts_size_ *= axis.values.size();
}

std::vector<std::string_view> Grid::at(std::size_t i) const {
  std::vector<std::string_view> values(parameters_.size() + starts_.size());
  for (std::size_t k = values.size(); k-- > 0;) {
    const GridAxis& axis = k < parameters_.size() ? parameters_[k] : starts_[k - parameters_.size()];
    values[k] = axis.values[i % axis.values.size()];
    i /= axis.values.size();
  }
  return values;
}

}  // namespace irk
