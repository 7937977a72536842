#include "experiments/analyses/run_file.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"

namespace irk {
namespace {

// A hash of a series' name. Different names with equal hashes are detected when their rows are read.
std::uint64_t hashOf(const TableRow& name) {
  std::string text;
  for (const auto& cell : name) text.append(cell) += '\0';
  return fnv1a(text);
}

}  // namespace

RunFile::RunFile(const std::filesystem::path& file) : file_(file), start_(file_.position()) {
  for (const auto& column : seriesColumns(names())) cells_.push_back(names().column(column));
  findPieces();
  group();
}

TableRow RunFile::nameOf(const TableRow& row) const {
  TableRow name;
  name.reserve(cells_.size());
  for (const std::size_t cell : cells_) name.push_back(row[cell]);
  return name;
}

// Of a piece, `series` is the hash of the name until `group`.
void RunFile::findPieces() {
  TableRow last;
  for (std::uint64_t begin = start_;; begin = file_.position()) {
    auto row = file_.next();
    if (!row) break;
    ++rows_;
    const auto same = [&](std::size_t cell) { return (*row)[cell] == last[cell]; };
    if (!last.empty() && std::all_of(cells_.begin(), cells_.end(), same)) {
      ++pieces_.back().rows;
    } else {
      pieces_.push_back({hashOf(nameOf(*row)), begin, 1});
    }
    last = std::move(*row);
  }
}

void RunFile::group() {
  const auto sort = [this] {
    std::sort(pieces_.begin(), pieces_.end(),
              [](const Piece& a, const Piece& b) { return std::tie(a.series, a.begin) < std::tie(b.series, b.begin); });
  };
  sort();
  for (auto& piece : pieces_) {
    if (names_.empty() || names_.back().hash != piece.series) names_.push_back({piece.series, piece.begin});
    piece.series = names_.back().series;
  }
  sort();
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (i == 0 || pieces_[i].series != pieces_[i - 1].series) first_.push_back(i);
  }
  first_.push_back(static_cast<std::uint32_t>(pieces_.size()));
}

HeldSeries RunFile::operator[](std::size_t i) const {
  HeldSeries held;
  for (std::uint32_t piece = first_[i]; piece < first_[i + 1]; ++piece) {
    file_.seek(pieces_[piece].begin);
    for (std::uint32_t k = 0; k < pieces_[piece].rows; ++k) held.rows.push_back(file_.next().value());
  }
  auto& series = held.series;
  series.name = nameOf(held.rows.front());
  const bool has_blocks = names().hasColumn(kBlockColumn);
  for (const auto& row : held.rows) {
    if (nameOf(row) != series.name) throw Failure("two series of one table have the same hash");
    series.rows.push_back(&row);
    if (has_blocks) addBlocks(series.blocks, textAt(names(), row, kBlockColumn));
  }
  return held;
}

void RunFile::forEachSeries(const std::function<void(const RunSeries&)>& take) const {
  for (std::size_t i = 0; i < size(); ++i) take((*this)[i].series);
}

void RunFile::forEachRow(const std::function<void(const TableRow&)>& take) const {
  file_.seek(start_);
  while (const auto row = file_.next()) take(*row);
}

std::optional<std::size_t> RunFile::find(const TableRow& name) const {
  const auto hash = hashOf(name);
  const auto at = std::lower_bound(names_.begin(), names_.end(), hash,
                                   [](const Name& its, std::uint64_t wanted) { return its.hash < wanted; });
  if (at == names_.end() || at->hash != hash) return {};
  const auto first =
      std::lower_bound(first_.begin(), first_.end() - 1, at->series,
                       [this](std::uint32_t i, std::uint64_t begin) { return pieces_[i].series < begin; });
  return static_cast<std::size_t>(first - first_.begin());
}

}  // namespace irk
