#include "core/derivatives/pattern_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "core/derivatives/colouring.h"
#include "core/derivatives/point_buffers.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Distance of the random point from p, relative to 1 + |y|. It is divided by ten after each point where the residual
// is not finite. (Entries missed there are found by the check of an evaluation, which then searches at p.)
constexpr double kDistance = 0.01;
constexpr int kCloser = 6;

/// Finds the rows of each direction at one point by splitting intervals of directions.
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
    return inOrder(partition);
  }

 private:
  struct Interval {
    std::size_t begin, end;  // of the directions
  };
  struct Partition {
    std::vector<Interval> intervals;
    RowSets rows;  // for each interval: the rows that it reaches, or may reach
  };

  // One interval per matrix: an interval never contains columns of two matrices.
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

  // The rows by direction, of a partition whose intervals hold one direction each.
  RowSets inOrder(const Partition& partition) const {
    constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> place(directions_.size(), kNowhere);
    for (std::size_t i = 0; i < partition.intervals.size(); ++i) place[partition.intervals[i].begin] = i;
    RowSets rows;
    for (const std::size_t i : place) rows.append(i == kNowhere ? std::span<const int>() : partition.rows[i]);
    return rows;
  }

  // Splits every interval into kChunk parts. Intervals that share no row are evaluated together.
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

  static std::size_t part(const Interval& i, std::size_t c) { return i.begin + (i.end - i.begin) * c / kChunk; }

  void seed(const Partition& parents, const std::vector<std::size_t>& together, std::minstd_rand* random) {
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

  void appendChildren(const Interval& parent, std::span<const int> rows, Partition& children) {
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
      children.rows.append(reached_);
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
RowSets detectRows(const System<Real>& system, Level level, const Point<Real>& p, const Directions& directions,
                   bool at_p) {
  RowSearch<Real> search(system, level, directions);
  std::minstd_rand random(1);
  PointBuffers<Real> near(system.sizes());
  double distance = kDistance;
  RowSets rows;
  bool searched = false;
  for (int closer = 0; closer < kCloser && !searched; ++closer, distance /= 10) {
    Real t = p.t;
    near.copy(p);
    moveNearby(distance, random, near, t);
    system.evaluate(level, near.at(t), near.residual());
    searched = near.r.allFinite();
    if (searched) rows = search.search(near, t, random);
  }
  if (searched && !at_p) return rows;
  near.copy(p);
  const RowSets here = search.search(near, p.t, random);
  if (!searched) return here;
  unite(here, rows);
  return rows;
}

template RowSets detectRows(const System<double>&, Level, const Point<double>&, const Directions&, bool);
template RowSets detectRows(const System<BigFloat>&, Level, const Point<BigFloat>&, const Directions&, bool);

}  // namespace irk
