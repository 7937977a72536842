#include "core/integration/rest_check.h"

#include <algorithm>
#include <cmath>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// A step at rest may change the state by this part of a tolerance.
constexpr double kRest = 0.1;
// Parts of the step: the golden section and its square, far from all fractions with small denominators.
constexpr double kLooks[] = {0.6180339887498949, 0.3819660112501051};

constexpr double kLong = 0.01;
constexpr double kHardly = 0.1;

}  // namespace

bool mayRest(double error, double h, double length) { return error < kHardly && h > kLong * length; }

template <class Real>
RestCheck<Real>::RestCheck(const System<Real>& system, const ErrorNorm<Real>& norm, ConsistentStart<Real>& start)
    : norm_(norm), start_(start) {
  const Sizes n = system.sizes();
  all_.resize(2 * n.nu + n.nx + n.nz);
  all_ << Vec<double>::Ones(2 * n.nu + n.nx), Vec<double>::Zero(n.nz);
}

template <class Real>
bool RestCheck<Real>::ratesAt(const State<Real>& state, double after, State<Real>& result) {
  result = state;
  result.t = state.t + Real(after);
  return start_.apply(result, StartCheck::kNone).outcome == Outcome::kSuccess;
}

template <class Real>
double RestCheck<Real>::error(const State<Real>& begin, const State<Real>& end, double h) {
  if (norm_.difference(begin, end, h, all_) > kRest || !ratesAt(begin, 0, still_)) return 0;
  double largest = 0;
  for (const double look : kLooks) {
    if (!ratesAt(begin, look * h, moved_)) return 0;
    moved_.x = begin.x + Real(h) * (moved_.k() - still_.k());
    moved_.v = begin.v + Real(h) * (moved_.a() - still_.a());
    moved_.u = begin.u + Real(h) * (moved_.v - begin.v);
    largest = std::max(largest, norm_.difference(begin, moved_, h, all_));
  }
  return largest;
}

IRK_INSTANTIATE_CLASS(RestCheck)

}  // namespace irk
