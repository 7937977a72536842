#include "experiments/tables/keyed_file.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "experiments/base/numbers.h"

namespace irk {

KeyedFile::KeyedFile(const std::filesystem::path& file) : file_(file) {
  for (auto position = file_.position();; position = file_.position()) {
    const auto row = file_.next();
    if (!row) break;
    places_.push_back({fnv1a(row->front()), position});
  }
  std::sort(places_.begin(), places_.end(),
            [](const Place& a, const Place& b) { return std::tie(a.hash, a.position) < std::tie(b.hash, b.position); });
}

std::optional<TableRow> KeyedFile::find(std::string_view key) {
  const auto hash = fnv1a(key);
  auto behind = std::upper_bound(places_.begin(), places_.end(), hash,
                                 [](std::uint64_t its, const Place& place) { return its < place.hash; });
  for (; behind != places_.begin() && std::prev(behind)->hash == hash; --behind) {
    file_.seek(std::prev(behind)->position);
    auto row = file_.next();
    if (row && row->front() == key) return row;
  }
  return {};
}

}  // namespace irk
