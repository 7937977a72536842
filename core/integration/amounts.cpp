#include "core/integration/amounts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "core/system/component_name.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

constexpr std::size_t kNamed = 4;  // a remark is one line

// Cubic Hermite interpolation of y with the rates dy, at theta in [0, 1] of a step h.
template <class Real>
Real hermite(double theta, const Real& h, const Real& y0, const Real& y1, const Real& dy0, const Real& dy1) {
  const Real s(theta), left = Real(1) - s;
  return left * left * (Real(1) + Real(2) * s) * y0 + s * s * (Real(3) - Real(2) * s) * y1 +
         h * s * left * (left * dy0 - s * dy1);
}

}  // namespace

template <class Real>
Amounts<Real>::Amounts(const System<Real>& system, ConsistentStart<Real>& start, Counters& counters)
    : system_(system),
      start_(start),
      counters_(counters),
      sizes_(system.sizes()),
      first_x_(sizes_.nx - system.sceneSizes().nx),
      scene_nx_(system.sceneSizes().nx),
      least_(2 * sizes_.nu + sizes_.nx),
      largest_(least_.size()) {
  small_.reserve(static_cast<std::size_t>(least_.size()));
  never_.reserve(static_cast<std::size_t>(scene_nx_));
}

template <class Real>
void Amounts<Real>::begin(const State<Real>& state, const ErrorNorm<Real>& norm) {
  norm.weightsAtZero(least_);
  round_off_ = kRoundOffUnits * std::numeric_limits<double>::epsilon() / norm.tolerance();
  small_.clear();
  never_.clear();
  negative_.clear();
  for (Index i = 0; i < least_.size(); ++i) {
    largest_[i] = std::abs(static_cast<double>(componentOf(state, i)));
    if (largest_[i] < least_[i]) small_.push_back(i);
  }
  for (Index i = 0; i < scene_nx_; ++i) {
    if (state.x[first_x_ + i] >= Real(0)) never_.push_back(i);
  }
}

template <class Real>
void Amounts<Real>::look(const State<Real>& from, const State<Real>& to) {
  std::erase_if(small_, [&](Index i) {
    const double size = std::abs(static_cast<double>(componentOf(to, i)));
    largest_[i] = std::max(largest_[i], size);
    return size >= least_[i];
  });
  lookBelowZero(from, to);
}

template <class Real>
void Amounts<Real>::lookBelowZero(const State<Real>& from, const State<Real>& to) {
  const double t = static_cast<double>(to.t);
  const auto value = [&](Index i) { return static_cast<double>(to.x[first_x_ + i]); };
  for (Negative& found : negative_) {
    if (value(found.i) < found.value) found.value = value(found.i), found.t = t;
  }
  const auto falls_again = [&](const Negative& found) {
    return !found.declared && isBelowZero(to, found.i) && from.x[first_x_ + found.i] >= Real(0);
  };
  fallen_.clear();
  std::copy_if(negative_.begin(), negative_.end(), std::back_inserter(fallen_), falls_again);
  std::erase_if(negative_, falls_again);
  std::erase_if(never_, [&](Index i) {
    if (!isBelowZero(to, i)) return false;
    const Negative now{i, value(i), t, system_.nonNegative(i)};
    (now.declared ? negative_ : fallen_).push_back(now);
    return true;
  });
  if (fallen_.empty()) return;
  clearThoseThatCross(from, to);
  negative_.insert(negative_.end(), fallen_.begin(), fallen_.end());
}

// Removes from fallen_ those whose rate at zero leads below it, or is not known: first all at once at the end of the
// step with those that are left at zero, until none is removed, then each at the time when it crosses zero.
template <class Real>
void Amounts<Real>::clearThoseThatCross(const State<Real>& from, const State<Real>& to) {
  if (!at_) at_.emplace(sizes_);
  const auto raise = [&](const std::vector<Negative>& below) {
    for (const Negative& one : below) at_->x[first_x_ + one.i] = std::max(to.x[first_x_ + one.i], Real(0));
  };
  for (std::size_t before = 0; before != fallen_.size();) {
    before = fallen_.size();
    *at_ = to;
    raise(fallen_);
    raise(negative_);
    const bool known = findRates();
    std::erase_if(fallen_,
                  [&](const Negative& one) { return !known || at_->w[sizes_.nu + first_x_ + one.i] < Real(0); });
  }
  std::erase_if(fallen_, [&](const Negative& one) { return !cannotCross(first_x_ + one.i, from, to); });
}

// Computes the rates in at_. Components next to zero, which have never left their tolerance below it, are taken as
// zero: what they have below it is an error that would lead others below zero.
template <class Real>
bool Amounts<Real>::findRates() {
  for (const Index i : never_) at_->x[first_x_ + i] = std::max(at_->x[first_x_ + i], Real(0));
  const Counters kept = counters_;
  const StartReport report = start_.findRates(*at_);
  counters_ = kept;
  return report.outcome == Outcome::kSuccess && report.determined;
}

// Sets at_ to the polynomial through both ends and their rates.
template <class Real>
void Amounts<Real>::between(double theta, const State<Real>& from, const State<Real>& to) {
  State<Real>& at = *at_;
  const Real h = to.t - from.t;
  at.t = from.t + Real(theta) * h;
  for (Index j = 0; j < sizes_.nu; ++j) {
    at.u[j] = hermite(theta, h, from.u[j], to.u[j], from.v[j], to.v[j]);
    at.v[j] = hermite(theta, h, from.v[j], to.v[j], from.w[j], to.w[j]);
  }
  for (Index j = 0; j < sizes_.nx; ++j) {
    at.x[j] = hermite(theta, h, from.x[j], to.x[j], from.w[sizes_.nu + j], to.w[sizes_.nu + j]);
  }
}

// Whether k_i >= 0 where that polynomial crosses x_i = 0. False if the rates are not known there.
template <class Real>
bool Amounts<Real>::cannotCross(Index i, const State<Real>& from, const State<Real>& to) {
  constexpr int kHalvings = 40;
  const Index k = sizes_.nu + i;
  const Real h = to.t - from.t;
  double above = 0, below = from.x[i] < Real(0) ? 0 : 1;
  for (int halving = 0; halving < kHalvings && below > 0; ++halving) {
    const double middle = (above + below) / 2;
    (hermite(middle, h, from.x[i], to.x[i], from.w[k], to.w[k]) < Real(0) ? below : above) = middle;
  }
  between(below, from, to);
  at_->x[i] = Real(0);
  return findRates() && at_->w[k] >= Real(0);
}

template <class Real>
std::string Amounts<Real>::belowTolerance() const {
  std::vector<Index> named;
  for (const Index i : small_) {
    if (largest_[i] > round_off_ * least_[i]) named.push_back(i);  // what is always zero is right
  }
  if (named.empty()) return {};
  std::sort(named.begin(), named.end());
  std::string text;
  for (std::size_t k = 0; k < std::min(named.size(), kNamed); ++k) {
    text += (k > 0 ? ", " : "") + componentName(sizes_, named[k]);
  }
  if (named.size() > kNamed) text += " and " + std::to_string(named.size() - kNamed) + " more";
  return text + " stayed below the absolute tolerance: values of this size are not controlled";
}

template <class Real>
std::string Amounts<Real>::belowZero() const {
  if (negative_.empty()) return {};
  const auto worst = std::min_element(negative_.begin(), negative_.end(), [this](const auto& a, const auto& b) {
    const auto inTolerances = [this](const Negative& n) { return n.value / least_[2 * sizes_.nu + first_x_ + n.i]; };
    return inTolerances(a) < inTolerances(b);
  });
  std::ostringstream text;
  text.precision(2);
  text << componentName(sizes_, 2 * sizes_.nu + first_x_ + worst->i) << " falls to " << worst->value
       << " at t = " << sceneTime(system_, Real(worst->t))
       << (worst->declared ? ", but it is never negative on an exact solution"
                           : ", but its rate at zero does not lead below zero");
  if (negative_.size() > 1) text << "; " << negative_.size() - 1 << " more components, too";
  return text.str();
}

template <class Real>
std::string Amounts<Real>::remark() const {
  const std::string small = belowTolerance(), negative = belowZero();
  return small + (small.empty() || negative.empty() ? "" : "; ") + negative;
}

IRK_INSTANTIATE_CLASS(Amounts)

}  // namespace irk
