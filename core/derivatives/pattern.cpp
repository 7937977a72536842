#include "core/derivatives/pattern.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace irk {

namespace {

std::shared_ptr<const Pattern> makeDense(Index n) {
  auto p = std::make_shared<Pattern>();
  p->n = n;
  p->column_start.reserve(static_cast<std::size_t>(n + 1));
  p->row.reserve(static_cast<std::size_t>(n * n));
  for (Index j = 0; j <= n; ++j) p->column_start.push_back(static_cast<int>(j * n));
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) p->row.push_back(static_cast<int>(i));
  }
  return p;
}

}  // namespace

std::shared_ptr<const Pattern> Pattern::dense(Index n) {
  static const auto small = [] {
    std::array<std::shared_ptr<const Pattern>, 17> all;  // of 0 to 16 unknowns
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = makeDense(static_cast<Index>(i));
    return all;
  }();
  return n < std::ssize(small) ? small[static_cast<std::size_t>(n)] : makeDense(n);
}

bool sameShape(const std::shared_ptr<const Pattern>& a, const std::shared_ptr<const Pattern>& b) {
  return a == b || (a && b && a->full && b->full && a->n == b->n);
}

Directions allDirections(const Sizes& n, int matrices) {
  const Index columns[] = {n.n(), n.nu + n.nx, n.nu};
  Directions all;
  all.reserve(static_cast<std::size_t>(std::accumulate(columns, columns + matrices, Index(0))));
  for (int matrix = 0; matrix < matrices; ++matrix) {
    for (Index j = 0; j < columns[matrix]; ++j) all.push_back({matrix, static_cast<int>(j)});
  }
  return all;
}

void RowSets::append(const RowSets& others) {
  const std::size_t before = rows_.size();
  if (start_.empty() && others.size() > 0) start_.push_back(0);
  rows_.insert(rows_.end(), others.rows_.begin(), others.rows_.end());
  for (std::size_t i = 1; i < others.start_.size(); ++i) start_.push_back(before + others.start_[i]);
}

RowSets fullRows(std::size_t directions, Index n) {
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  RowSets sets;
  for (std::size_t i = 0; i < directions; ++i) sets.append(all);
  return sets;
}

bool unite(const RowSets& more, RowSets& into) {
  const std::size_t before = into.entries();
  if (before == 0) {
    into = more;
    return into.entries() > 0;
  }
  RowSets united;
  united.reserve(into.size(), std::max(before, more.entries()));
  std::vector<int> both;
  for (std::size_t i = 0; i < into.size(); ++i) {
    both.clear();
    std::set_union(into[i].begin(), into[i].end(), more[i].begin(), more[i].end(), std::back_inserter(both));
    united.append(both);
  }
  const bool grown = united.entries() > before;
  into = std::move(united);
  return grown;
}

std::shared_ptr<const Pattern> unionPattern(const Directions& directions, const RowSets& rows, Index n) {
  // First the rows of all directions of a column, then the same rows sorted and without repetitions.
  std::vector<int> start(static_cast<std::size_t>(n) + 1, 0);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    start[static_cast<std::size_t>(directions[i].column) + 1] += static_cast<int>(rows[i].size());
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> all(static_cast<std::size_t>(start.back()));
  std::vector<int> end(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    int& at = end[static_cast<std::size_t>(directions[i].column)];
    std::copy(rows[i].begin(), rows[i].end(), all.begin() + at);
    at += static_cast<int>(rows[i].size());
  }
  auto p = std::make_shared<Pattern>();
  p->n = n;
  p->full = false;
  p->column_start.reserve(start.size());
  p->column_start.push_back(0);
  p->row.reserve(all.size());
  for (std::size_t j = 0; j + 1 < start.size(); ++j) {
    const auto first = all.begin() + start[j], last = all.begin() + start[j + 1];
    std::sort(first, last);
    p->row.insert(p->row.end(), first, std::unique(first, last));
    p->column_start.push_back(static_cast<int>(p->row.size()));
  }
  return p;
}

}  // namespace irk
