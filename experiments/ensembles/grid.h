// The grid of an ensemble: values of parameters and of components of the start, in all combinations.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// One parameter, or one component of the start, and its values.
struct GridAxis {
  std::string name;
  std::vector<std::string> values;
};

/// The axis of `name=VALUES`. VALUES: items with ',' between; an item is any text, `A..B:N` for N >= 2 numbers at equal
/// distances from A to B, or `A..B:N:log` for N numbers with equal ratios. Throws Misuse, which names `option`, for
/// text of another form, for empty items, and for ranges that are none.
GridAxis gridAxis(std::string_view option, const std::string& text);

/// The combinations of axes, by numbers: the last axis changes fastest.
class Grid {
 public:
  /// Throws Misuse for a name that occurs twice and for more than kMostMembers combinations.
  Grid(std::vector<GridAxis> parameters, std::vector<GridAxis> starts);

  static constexpr std::size_t kMostMembers = 10'000'000;

  std::size_t size() const { return size_; }
  const std::vector<GridAxis>& parameters() const { return parameters_; }
  const std::vector<GridAxis>& starts() const { return starts_; }
  /// The values of combination i: of the parameters, then of the starts.
  std::vector<std::string_view> at(std::size_t i) const;
  /// The number of the combination of parameters in combination i. Neighbours that differ in their starts only have the
  /// same one.
  std::size_t parametersOf(std::size_t i) const { return i / starts_size_; }

 private:
  std::vector<GridAxis> parameters_, starts_;
  std::size_t size_ = 1, starts_size_ = 1;
};

}  // namespace irk
