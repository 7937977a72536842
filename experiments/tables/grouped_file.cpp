#include "experiments/tables/grouped_file.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"

namespace irk {
namespace {

// Different names with equal hashes are detected when their rows are read.
std::uint64_t groupHash(const TableRow& name) {
  std::string text;
  for (const auto& cell : name) text.append(cell) += '\0';
  return fnv1a(text);
}

}  // namespace

GroupedFile::GroupedFile(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : file_(file), start_(file_.position()) {
  for (const auto& column : columns) cells_.push_back(names().column(column));
  findPieces();
  sortGroups();
}

TableRow GroupedFile::nameOf(const TableRow& row) const {
  TableRow name;
  name.reserve(cells_.size());
  for (const std::size_t cell : cells_) name.push_back(row[cell]);
  return name;
}

// Of a piece, `group` is the hash of the name until `sortGroups`.
void GroupedFile::findPieces() {
  TableRow last;
  for (std::uint64_t begin = start_;; begin = file_.position()) {
    auto row = file_.next();
    if (!row) break;
    ++rows_;
    const auto same = [&](std::size_t cell) { return (*row)[cell] == last[cell]; };
    if (!last.empty() && std::all_of(cells_.begin(), cells_.end(), same)) {
      ++pieces_.back().rows;
    } else {
      pieces_.push_back({groupHash(nameOf(*row)), begin, 1});
    }
    last = std::move(*row);
  }
}

void GroupedFile::sortGroups() {
  const auto sort = [this] {
    std::sort(pieces_.begin(), pieces_.end(),
              [](const Piece& a, const Piece& b) { return std::tie(a.group, a.begin) < std::tie(b.group, b.begin); });
  };
  sort();
  for (auto& piece : pieces_) {
    if (names_.empty() || names_.back().hash != piece.group) names_.push_back({piece.group, piece.begin});
    piece.group = names_.back().group;
  }
  sort();
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (i == 0 || pieces_[i].group != pieces_[i - 1].group) first_.push_back(i);
  }
  first_.push_back(static_cast<std::uint32_t>(pieces_.size()));
}

TableRow GroupedFile::firstRow(std::size_t i) const {
  file_.seek(pieces_[first_[i]].begin);
  return file_.next().value();
}

std::vector<TableRow> GroupedFile::group(std::size_t i) const {
  std::vector<TableRow> rows;
  forEachRowOf({i}, [&rows](TableRow row) { rows.push_back(std::move(row)); });
  return rows;
}

void GroupedFile::forEachRowOf(const std::vector<std::size_t>& groups,
                               const std::function<void(TableRow row)>& take) const {
  std::vector<Piece> pieces;
  for (const std::size_t i : groups) {
    pieces.insert(pieces.end(), pieces_.begin() + first_[i], pieces_.begin() + first_[i + 1]);
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
  std::map<std::uint64_t, TableRow> names;
  for (const auto& piece : pieces) {
    file_.seek(piece.begin);
    for (std::uint32_t k = 0; k < piece.rows; ++k) {
      auto row = file_.next().value();
      auto name = nameOf(row);
      const auto& first = names.try_emplace(piece.group, name).first->second;
      if (name != first) throw Failure("two groups of one table have the same hash");
      take(std::move(row));
    }
  }
}

void GroupedFile::forEachRow(const std::function<void(const TableRow&)>& take) const {
  file_.seek(start_);
  while (const auto row = file_.next()) take(*row);
}

std::optional<std::size_t> GroupedFile::find(const TableRow& name) const {
  const auto hash = groupHash(name);
  const auto at = std::lower_bound(names_.begin(), names_.end(), hash,
                                   [](const Name& its, std::uint64_t wanted) { return its.hash < wanted; });
  if (at == names_.end() || at->hash != hash) return {};
  const auto first =
      std::lower_bound(first_.begin(), first_.end() - 1, at->group,
                       [this](std::uint32_t i, std::uint64_t begin) { return pieces_[i].group < begin; });
  return static_cast<std::size_t>(first - first_.begin());
}

}  // namespace irk
