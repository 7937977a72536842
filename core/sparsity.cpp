#include "core/sparsity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>

#include "core/multiprecision.h"
#include "core/point_buffers.h"

namespace irk {

std::shared_ptr<const Pattern> Pattern::dense(Index n) {
  auto p = std::make_shared<Pattern>();
  p->n = n;
  for (Index j = 0; j <= n; ++j) p->column_start.push_back(static_cast<int>(j * n));
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) p->row.push_back(static_cast<int>(i));
  }
  return p;
}

bool sameShape(const std::shared_ptr<const Pattern>& a, const std::shared_ptr<const Pattern>& b) {
  return a == b || (a && b && a->full && b->full && a->n == b->n);
}

Directions allDirections(const Sizes& n, int matrices) {
  const Index columns[] = {n.n(), n.nu + n.nx, n.nu};
  Directions all;
  for (int matrix = 0; matrix < matrices; ++matrix) {
    for (Index j = 0; j < columns[matrix]; ++j) all.push_back({matrix, j});
  }
  return all;
}

RowSets fullRows(std::size_t directions, Index n) {
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  return RowSets(directions, all);
}

bool unite(const RowSets& more, RowSets& into) {
  bool grown = false;
  std::vector<int> both;
  for (std::size_t i = 0; i < into.size(); ++i) {
    both.clear();
    std::set_union(into[i].begin(), into[i].end(), more[i].begin(), more[i].end(),
                   std::back_inserter(both));
    grown = grown || both.size() > into[i].size();
    into[i] = both;
  }
  return grown;
}

std::shared_ptr<const Pattern> unionPattern(const Directions& directions, const RowSets& rows,
                                            Index n) {
  // All rows of a column side by side, then each once.
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

std::vector<int> colour(const RowSets& sets, Index rows) {
  // The colours in use at each row, side by side: there is room for one of each set.
  std::vector<std::size_t> begin(static_cast<std::size_t>(rows) + 1, 0);
  for (const auto& set : sets) {
    for (const int row : set) ++begin[static_cast<std::size_t>(row) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  std::vector<int> at_row(begin.back());
  std::vector<int> colours(sets.size(), 0);
  std::vector<std::size_t> used_by;  // by colour: the last set + 1 for which it is in use
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int row : sets[i]) {
      const auto r = static_cast<std::size_t>(row);
      for (std::size_t k = begin[r]; k < end[r]; ++k) {
        used_by[static_cast<std::size_t>(at_row[k])] = i + 1;
      }
    }
    std::size_t free = 0;
    while (free < used_by.size() && used_by[free] == i + 1) ++free;
    if (free == used_by.size()) used_by.push_back(0);
    colours[i] = static_cast<int>(free);
    for (const int row : sets[i]) at_row[end[static_cast<std::size_t>(row)]++] = colours[i];
  }
  return colours;
}

ColouredDirections::ColouredDirections(const Directions& group, const RowSets& rows,
                                       const Pattern& pattern) {
  const std::vector<int> colours = colour(rows, pattern.n);
  std::vector<std::size_t> order(group.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return colours[a] < colours[b]; });
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> around_one(0.5, 1.5);
  int last = -1;
  for (const std::size_t i : order) {
    if (rows[i].empty()) continue;
    if (colours[i] != last) {
      first_direction.push_back(directions.size());
      first_entry.push_back(entries.size());
      last = colours[i];
    }
    directions.push_back(group[i]);
    weights.push_back(around_one(random));
    const auto column = static_cast<std::size_t>(group[i].column);
    auto at = pattern.row.begin() + pattern.column_start[column];
    for (const int row : rows[i]) {
      at = std::lower_bound(at, pattern.row.begin() + pattern.column_start[column + 1], row);
      entries.push_back({row, group[i].matrix, at - pattern.row.begin(), weights.size() - 1});
    }
  }
  first_direction.push_back(directions.size());
  first_entry.push_back(entries.size());
  for (const std::size_t i : order) {  // what reaches nothing takes part in the check only
    if (!rows[i].empty()) continue;
    directions.push_back(group[i]);
    weights.push_back(around_one(random));
  }
}

namespace {

// How far from p the pattern is looked at: a part of 1 + |y|, a tenth of it after each point where the
// residual is not finite. (What that misses, the check of an evaluation finds, and then p is looked at.)
constexpr double kDistance = 0.01;
constexpr int kCloser = 6;

/// Finds the rows of each direction at one point by halving intervals of directions.
template <class Real>
class RowSearch {
 public:
  RowSearch(const System<Real>& system, Level level, const Directions& directions)
      : system_(system), level_(level), directions_(directions), at_(system.sizes()) {}

  RowSets search(const PointBuffers<Real>& p, const Real& t, std::minstd_rand& random) {
    at_.copy(p.at(t));
    t_ = t;
    Partition partition = whole();
    while (std::any_of(partition.intervals.begin(), partition.intervals.end(),
                       [](const Interval& i) { return i.end - i.begin > 1; })) {
      partition = split(partition, random);
    }
    RowSets rows(directions_.size());
    for (std::size_t i = 0; i < partition.rows.size(); ++i) {
      rows[partition.intervals[i].begin] = std::move(partition.rows[i]);
    }
    return rows;
  }

 private:
  struct Interval {
    std::size_t begin, end;  // of the directions
  };
  struct Partition {
    std::vector<Interval> intervals;
    RowSets rows;  // that each reaches, or may reach
  };

  // One interval per matrix, so that neighbours in one are not neighbours of another matrix' columns.
  Partition whole() const {
    Partition all;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (i == 0 || directions_[i].matrix != directions_[i - 1].matrix) {
        all.intervals.push_back({i, i});
      }
      ++all.intervals.back().end;
    }
    all.rows = fullRows(all.intervals.size(), system_.sizes().n());
    return all;
  }

  // Every interval in kChunk parts, the parts of intervals that share no row together.
  Partition split(const Partition& parents, std::minstd_rand& random) {
    const std::vector<int> colours = colour(parents.rows, system_.sizes().n());
    const int count = 1 + *std::max_element(colours.begin(), colours.end());
    Partition children;
    std::vector<std::size_t> together;
    for (int c = 0; c < count; ++c) {
      together.clear();
      for (std::size_t i = 0; i < colours.size(); ++i) {
        if (colours[i] == c) together.push_back(i);
      }
      seed(parents, together, &random);
      system_.evaluate(level_, at_.at(Dual<Real>(t_)), at_.residual());
      for (const std::size_t i : together) {
        appendChildren(parents.intervals[i], parents.rows[i], children);
      }
      seed(parents, together, nullptr);
    }
    return children;
  }

  static std::size_t part(const Interval& i, std::size_t c) {
    return i.begin + (i.end - i.begin) * c / kChunk;
  }

  void seed(const Partition& parents, const std::vector<std::size_t>& together,
            std::minstd_rand* random) {
    std::uniform_real_distribution<double> around_one(0.5, 1.5);
    for (const std::size_t p : together) {
      const Interval& i = parents.intervals[p];
      for (std::size_t c = 0; c < kChunk; ++c) {
        for (std::size_t k = part(i, c); k < part(i, c + 1); ++k) {
          at_.component(directions_[k]).d[c] = random ? Real(around_one(*random)) : Real(0);
        }
      }
    }
  }

  void appendChildren(const Interval& parent, const std::vector<int>& rows, Partition& children) {
    using std::isfinite;
    for (std::size_t c = 0; c < kChunk; ++c) {
      const Interval child{part(parent, c), part(parent, c + 1)};
      if (child.begin == child.end) continue;
      reached_.clear();
      for (const int row : rows) {
        const Real& slope = at_.r[row].d[c];
        if (isfinite(slope) && slope != Real(0)) reached_.push_back(row);
      }
      if (reached_.empty()) continue;
      children.intervals.push_back(child);
      children.rows.push_back(reached_);
    }
  }

  const System<Real>& system_;
  Level level_;
  const Directions& directions_;
  PointBuffers<Dual<Real>> at_;
  Real t_{};
  std::vector<int> reached_;
};

template <class Real>
void moveNearby(double distance, std::minstd_rand& random, PointBuffers<Real>& p, Real& t) {
  std::uniform_real_distribution<double> either_way(-1, 1);
  const auto move = [&](Real& y) {
    using std::abs;
    y += Real(distance * either_way(random)) * (Real(1) + Real(abs(y)));
  };
  move(t);
  for (auto* part : {&p.u, &p.v, &p.x, &p.w}) std::for_each(part->begin(), part->end(), move);
}

}  // namespace

template <class Real>
RowSets detectRows(const System<Real>& system, Level level, const Point<Real>& p,
                   const Directions& directions, bool at_p) {
  RowSearch<Real> search(system, level, directions);
  std::minstd_rand random(1);
  PointBuffers<Real> near(system.sizes());
  double distance = kDistance;
  RowSets rows;
  for (int closer = 0; closer < kCloser && rows.empty(); ++closer, distance /= 10) {
    Real t = p.t;
    near.copy(p);
    moveNearby(distance, random, near, t);
    system.evaluate(level, near.at(t), near.residual());
    if (near.r.allFinite()) rows = search.search(near, t, random);
  }
  if (!at_p && !rows.empty()) return rows;
  near.copy(p);
  const RowSets here = search.search(near, p.t, random);
  if (rows.empty()) return here;
  unite(here, rows);
  return rows;
}

template RowSets detectRows(const System<double>&, Level, const Point<double>&, const Directions&,
                            bool);
template RowSets detectRows(const System<mp50>&, Level, const Point<mp50>&, const Directions&, bool);
template RowSets detectRows(const System<mp100>&, Level, const Point<mp100>&, const Directions&,
                            bool);

}  // namespace irk
