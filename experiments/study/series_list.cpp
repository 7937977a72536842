#include "experiments/study/series_list.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace irk {
namespace {

constexpr std::size_t kKept = 4096;  // some megabytes

SeriesList::Make from(std::vector<Series> all) {
  return [kept = std::make_shared<const std::vector<Series>>(std::move(all))](std::size_t i) { return (*kept)[i]; };
}

}  // namespace

SeriesList::SeriesList(std::vector<Series> all) : size_(all.size()) { parts_.push_back({0, from(std::move(all))}); }

void SeriesList::append(std::size_t count, Make make) {
  if (count <= kKept) {
    std::vector<Series> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(make(i));
    make = from(std::move(all));
  }
  parts_.push_back({size_, std::move(make)});
  size_ += count;
}

Series SeriesList::operator[](std::size_t i) const {
  const auto behind = std::upper_bound(parts_.begin(), parts_.end(), i,
                                       [](std::size_t at, const Part& part) { return at < part.first; });
  const Part& part = *std::prev(behind);
  return part.make(i - part.first);
}

}  // namespace irk
