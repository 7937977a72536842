#include "core/derivatives/differentiator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/base/threads.h"
#include "core/derivatives/pattern_search.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Tolerances of the check, relative to the terms of a row: round-off of exact derivatives, truncation error of
// differences.
constexpr double kDualCheck = 1e-8, kDifferenceCheck = 1e-3;
// If a check fails but no new entry is found, it was round-off: the tolerance grows by this factor.
constexpr double kLooser = 10;

}  // namespace

template <class Real>
Differentiator<Real>::Differentiator(const System<Real>& system, DerivativeSource source, JacobianTerms terms,
                                     Storage storage, Matrices matrices, std::shared_ptr<Scratch> scratch, int threads)
    : system_(system),
      source_(source),
      sizes_(system.sizes()),
      terms_(catalogue<JacobianTerms>()[terms]),
      storage_(storage),
      threads_(threads),
      scratch_(scratch ? std::move(scratch) : std::make_shared<Scratch>(sizes_, source)),
      zero_a_(Vec<Real>::Zero(sizes_.nu)) {
  if (scratch_->source != source) throw Misuse("a scratch for derivatives of another source");
  if (!std::is_same_v<Real, double>) {
    if (storage == Storage::kSparse) {
      throw Misuse("illegal combination: storage 'sparse' in multiprecision: KLU is for double");
    }
    storage_ = Storage::kDense;
  }
  // Only the rows F2 have a constant stiffness. If there are other rows, D2 has to be evaluated for them anyway.
  const bool once = terms_.stiffness_once && sizes_.n() == sizes_.nu;
  const Index rates = sizes_.nu + sizes_.nx;
  // Where no derivative of M a is kept, those along a are taken at a = 0 as well: they are M whatever a is, and one
  // group needs fewer evaluations than two.
  const bool all_at_zero = terms_.mass_without_vxz && terms_.mass_without_u;
  const Directions all = allDirections(sizes_, matrices == Matrices::kAll ? 3 : 1);
  (all_at_zero ? at_zero_ : at_a_).directions.reserve(all.size());
  for (const Direction& d : all) {
    const bool vxz = d.matrix == 1 || (d.matrix == 0 && d.column >= rates);
    const bool at_zero = all_at_zero || (terms_.mass_without_vxz && vxz) || (terms_.mass_without_u && d.matrix == 2);
    (at_zero ? at_zero_ : once && d.matrix == 2 ? stiffness_ : at_a_).directions.push_back(d);
  }
  forgetPattern();
}

template <class Real>
bool Differentiator<Real>::detects() const {
  return sizes_.n() >= kSparseFrom || storage_ == Storage::kSparse;
}

template <class Real>
void Differentiator<Real>::forgetPattern() {
  forget();
  looked_ = false;
  check_tolerance_ = source_ == DerivativeSource::kAutomatic ? kDualCheck : kDifferenceCheck;
  const bool dense = storage_ == Storage::kDense || !detects();
  const bool first = !pattern_;
  if (!dense) {
    pattern_ = nullptr;
  } else if (first) {
    pattern_ = Pattern::dense(sizes_.n());
  }
  if (!detects()) {
    if (first) setPattern();  // the pattern stays dense
    return;
  }
  for (Group* group : {&at_a_, &at_zero_, &stiffness_}) group->rows = RowSets(group->directions.size());
}

/// Searches the pattern near p, and at p itself if it has been searched before. Returns whether it has grown.
template <class Real>
bool Differentiator<Real>::look(Level level, const Point<Real>& p) {
  bool grown = !looked_;
  for (Group* group : {&at_a_, &at_zero_, &stiffness_}) {
    if (group->directions.empty()) continue;
    const RowSets rows = detectRows(system_, level, p, group->directions, looked_);
    if (unite(rows, group->rows)) grown = true;
  }
  looked_ = true;
  if (grown) setPattern();
  return grown;
}

template <class Real>
void Differentiator<Real>::setPattern() {
  const Index n = sizes_.n();
  if (!pattern_ || !pattern_->full) {
    Directions all;
    RowSets rows;
    for (const Group* group : {&at_a_, &at_zero_, &stiffness_}) {
      all.insert(all.end(), group->directions.begin(), group->directions.end());
      rows.append(group->rows);
    }
    pattern_ = unionPattern(all, rows, n);
    const double fill = static_cast<double>(pattern_->nonzeros()) / (static_cast<double>(n) * static_cast<double>(n));
    if (storage_ == Storage::kAutomatic && fill > kSparseFill) pattern_ = Pattern::dense(n);
  }
  std::size_t most = 0;
  for (Group* group : {&at_a_, &at_zero_, &stiffness_}) {
    group->coloured = detects() ? ColouredDirections(group->directions, group->rows, *pattern_)
                                : ColouredDirections::dense(group->directions, n);
    most = std::max(most, group->directions.size());
  }
  if (source_ == DerivativeSource::kAutomatic) {
    reserveForThreads();
  } else {
    y_.resize(static_cast<Index>(most));
    delta_.resize(static_cast<Index>(most));
  }
  stiffness_known_ = false;
}

template <class Real>
std::size_t Differentiator<Real>::directions() const {
  return at_a_.coloured.colours() + at_zero_.coloured.colours() + stiffness_.coloured.colours();
}

template <class Real>
const std::shared_ptr<const Pattern>& Differentiator<Real>::pattern(Level level, const Point<Real>& p) {
  if (detects() && !looked_) look(level, p);
  return pattern_;
}

template <class Real>
void Differentiator<Real>::evaluate(Level level, const Point<Real>& p, Linearization<Real>& out) {
  pattern(level, p);
  differentiate(level, p, out);
  if (!incomplete_) return;
  if (look(level, p)) {
    differentiate(level, p, out);
  } else {
    check_tolerance_ *= kLooser;
  }
}

template <class Real>
void Differentiator<Real>::differentiate(Level level, const Point<Real>& p, Linearization<Real>& out) {
  if (!sameShape(out.pattern, pattern_)) out = Linearization<Real>(pattern_);
  incomplete_ = false;
  evaluateGroup(at_a_, level, p, out);
  if (!stiffness_known_) evaluateGroup(stiffness_, level, p, out);
  if (!at_zero_.directions.empty()) {
    const ConstVec<Real> zero(zero_a_.data(), sizes_.nu);
    evaluateGroup(at_zero_, level, {p.t, p.u, p.v, p.x, zero, p.k, p.z, p.d}, out);
  }
  if (const auto& change = terms_.change.template of<Real>()) change(sizes_, out);
  if (terms_.stiffness_once) keepStiffness(out);
}

template <class Real>
void Differentiator<Real>::evaluateGroup(const Group& group, Level level, const Point<Real>& p,
                                         Linearization<Real>& out) {
  if (group.directions.empty()) return;
  t_ = p.t;
  if (looked_) {
    scratch_->expected.setZero();
    scratch_->magnitude.setZero();
  }
  if (source_ == DerivativeSource::kAutomatic) {
    evaluateDual(group.coloured, level, p, out);
  } else {
    scratch_->real.copy(p);
    evaluateDifferences(group.coloured, level, out);
  }
}

template <class Real>
void Differentiator<Real>::keepStiffness(Linearization<Real>& out) {
  if (!stiffness_known_) {
    kept_stiffness_ = out.d2;
    stiffness_known_ = true;
    return;
  }
  out.pattern->forEachInBlock(0, sizes_.nu, 0, sizes_.nu, [&](Index k) { out.d2[k] = kept_stiffness_[k]; });
}

/// Stores the changes along a colour, given by row, in the matrices.
template <class Real>
template <class Change>
void Differentiator<Real>::take(const ColouredDirections& group, std::size_t colour, const Change& change,
                                Linearization<Real>& out) {
  using std::abs;
  if (colour == group.colours()) return check(change, out);
  const bool exact = source_ == DerivativeSource::kAutomatic;
  Real* const matrices[] = {out.d0.data(), out.d1.data(), out.d2.data()};
  Vec<Real>&expected = scratch_->expected, &magnitude = scratch_->magnitude;
  for (std::size_t i = group.begin(colour); i < group.end(colour); ++i) {
    Real* const values = matrices[group.directions[i].matrix];
    if (exact && !looked_) {
      group.forEachEntry(i, [&](Index row, Index slot) { values[slot] = change(row); });
      continue;
    }
    const Real weight = looked_ ? Real(ColouredDirections::weightOf(i)) : Real(0);
    group.forEachEntry(i, [&](Index row, Index slot) {
      const Real& value = change(row);
      values[slot] = exact ? value : Real(value / delta_[static_cast<Index>(i)]);
      if (!looked_) return;
      const Real part = weight * value;
      expected[row] += part;
      magnitude[row] += abs(part);
    });
  }
}

/// Compares the changes along the combination of all directions, by row, with the stored derivatives.
template <class Real>
template <class Change>
void Differentiator<Real>::check(const Change& change, Linearization<Real>& out) {
  using std::abs;
  using std::isfinite;
  const Vec<Real>&expected = scratch_->expected, &magnitude = scratch_->magnitude;
  for (Index row = 0; row < sizes_.n(); ++row) {
    const Real& all = change(row);
    if (!isfinite(all)) {  // the entry may be outside of the pattern
      out.d0.setConstant(std::numeric_limits<Real>::quiet_NaN());
      return;
    }
    const Real difference = abs(Real(all - expected[row]));
    if (difference > Real(check_tolerance_) * magnitude[row]) incomplete_ = true;
  }
}

/// The number of dual evaluations, with the check.
template <class Real>
std::size_t Differentiator<Real>::evaluationsOf(const ColouredDirections& group) {
  return (group.colours() + kChunk) / kChunk;
}

/// Makes buffers for as many evaluations at a time as there are threads and the largest group has evaluations.
template <class Real>
void Differentiator<Real>::reserveForThreads() {
  std::size_t evaluations = 0;
  for (const Group* group : {&at_a_, &at_zero_, &stiffness_}) {
    evaluations = std::max(evaluations, evaluationsOf(group->coloured));
  }
  const std::size_t wanted = std::min(evaluations, static_cast<std::size_t>(threads_));
  while (scratch_->others.size() + 1 < wanted) scratch_->others.emplace_back(sizes_);
}

/// Evaluates r along the colours from `first` on, kChunk at most, at the point in `at`. The colour after the last one
/// stands for the check.
template <class Real>
void Differentiator<Real>::evaluateAlong(const ColouredDirections& group, std::size_t first, Level level,
                                         PointBuffers<Dual<Real>>& at) {
  const std::size_t count = std::min(kChunk, group.colours() + (looked_ ? 1 : 0) - first);
  const auto set = [&](const auto& along) {
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t i = group.begin(first + c); i < group.end(first + c); ++i) {
        at.component(group.directions[i]).d[c] = along(first + c, i);
      }
    }
  };
  set([&group](std::size_t colour, std::size_t i) { return Real(group.weight(colour, i)); });
  system_.evaluate(level, at.at(Dual<Real>(t_)), at.residual());
  set([](std::size_t, std::size_t) { return Real(0); });
}

// As many evaluations at a time as there are buffers. The sums of the check are made in the order of the colours,
// whatever the number of threads.
template <class Real>
void Differentiator<Real>::evaluateDual(const ColouredDirections& group, Level level, const Point<Real>& p,
                                        Linearization<Real>& out) {
  const std::size_t colours = group.colours() + (looked_ ? 1 : 0);
  const std::size_t evaluations = (colours + kChunk - 1) / kChunk;
  const std::size_t buffers = std::min({evaluations, static_cast<std::size_t>(threads_), scratch_->others.size() + 1});
  for (std::size_t done = 0; done < evaluations; done += buffers) {
    const std::size_t now = std::min(buffers, evaluations - done);
    onThreads(threads_, now, [&](std::size_t i) {
      if (done == 0) dualOf(i).copy(p);
      evaluateAlong(group, (done + i) * kChunk, level, dualOf(i));
    });
    for (std::size_t i = 0; i < now; ++i) {
      const VecView<Dual<Real>> r = dualOf(i).residual();
      const std::size_t first = (done + i) * kChunk;
      for (std::size_t colour = first; colour < std::min(first + kChunk, colours); ++colour) {
        take(
            group, colour, [&](Index row) -> const Real& { return r[row].d[colour - first]; }, out);
      }
    }
  }
}

// Increments: eps^(1/2) (forward) and eps^(1/3) (central) times max(|y|, 1) balance truncation and
// round-off; Dennis & Schnabel, section 5.4.
template <class Real>
void Differentiator<Real>::evaluateDifferences(const ColouredDirections& group, Level level, Linearization<Real>& out) {
  using std::abs;
  using std::cbrt;
  using std::sqrt;
  const bool central = source_ == DerivativeSource::kCentral;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  const Real relative = central ? Real(cbrt(eps)) : Real(sqrt(eps));
  auto& real = scratch_->real;
  Vec<Real>& base = scratch_->base;
  const auto at = real.at(t_);
  const VecView<Real> r = real.residual();
  const auto move = [&](std::size_t colour, double side) {
    for (std::size_t i = group.begin(colour); i < group.end(colour); ++i) {
      const Real& y = y_[static_cast<Index>(i)];
      const Real magnitude = abs(y) > Real(1) ? Real(abs(y)) : Real(1);
      real.component(group.directions[i]) = y + Real(side * group.weight(colour, i)) * relative * magnitude;
    }
  };
  for (std::size_t i = 0; i < group.directions.size(); ++i) {
    y_[static_cast<Index>(i)] = real.component(group.directions[i]);
  }
  if (!central) {
    system_.evaluate(level, at, r);
    base = r;
  }
  const std::size_t colours = group.colours() + (looked_ ? 1 : 0);
  for (std::size_t colour = 0; colour < colours; ++colour) {
    const bool check = colour == group.colours();
    const auto keep = [&](auto&& f) {
      for (std::size_t i = group.begin(colour); i < group.end(colour) && !check; ++i) {
        f(delta_[static_cast<Index>(i)], real.component(group.directions[i]));
      }
    };
    if (central) {
      move(colour, -1);
      system_.evaluate(level, at, r);
      base = r;
    }
    keep([](Real& delta, const Real& lower) { delta = lower; });
    move(colour, 1);
    system_.evaluate(level, at, r);
    keep([](Real& delta, const Real& upper) { delta = upper - delta; });
    move(colour, 0);
    take(
        group, colour, [&](Index row) { return Real(r[row] - base[row]); }, out);
  }
}

IRK_INSTANTIATE_CLASS(Differentiator)

}  // namespace irk
