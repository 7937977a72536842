#include "core/estimates/defect.h"

#include <algorithm>
#include <cmath>

#include "core/base/legendre.h"
#include "core/base/small_product.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
MovingPoints<Real>::MovingPoints(const Scheme<Real>& scheme)
    : scheme_(scheme),
      inside_(scheme.s, kPeriod),
      once_(scheme.s, kPeriod),
      twice_(scheme.s, kPeriod),
      known_(kPeriod, false),
      p_(scheme.s + 2),
      integral_(scheme.s + 1),
      second_(scheme.s) {}

template <class Real>
double MovingPoints<Real>::place(std::int64_t i) {
  return (static_cast<double>(i * kStride % kPeriod) + 0.5) / kPeriod;
}

template <class Real>
auto MovingPoints<Real>::operator[](std::int64_t i) -> Point {
  const Index at = i % kPeriod, s = scheme_.s;
  const Real theta(place(at));
  if (const auto k = static_cast<std::size_t>(at); !known_[k]) {
    known_[k] = true;
    legendre<Real>(theta, p_);
    integrateLegendre(p_, integral_, second_);
    const auto& to_stages = scheme_.legendre_inverse_transposed;
    inside_.col(at).noalias() = to_stages * p_.head(s);
    once_.col(at).noalias() = to_stages * integral_.head(s);
    twice_.col(at).noalias() = to_stages * second_;
  }
  return {theta, {inside_.col(at).data(), s}, {once_.col(at).data(), s}, {twice_.col(at).data(), s}};
}

template <class Real>
Defect<Real>::Defect(EmbeddedEstimate<Real>& filter, const Scheme<Real>& scheme, const Sizes& sizes, Start start)
    : filter_(filter),
      scheme_(scheme),
      sizes_(sizes),
      looks_at_start_(start == Start::kLookAt),
      looks_at_end_(scheme.c.maxCoeff() < Real(1 - 1e-10)),
      points_(scheme),
      at_(sizes) {}

template <class Real>
void Defect<Real>::begin(double length) {
  length_ = length;
  next_ = 0;
}

template <class Real>
int Defect<Real>::looks(double h, double length) {
  return static_cast<int>(std::clamp(std::ceil(kParts * h / length), 1.0, double{MovingPoints<Real>::kPeriod}));
}

template <class Real>
auto Defect<Real>::at(const typename MovingPoints<Real>::Point& point, const State<Real>& from,
                      const StagePolynomial<Real>& stages) -> Result {
  const Real& h = stages.h;
  const Index n = sizes_.n(), nu = sizes_.nu, nx = sizes_.nx;
  const Real* const W = stages.W.data();
  at_.t = from.t + point.theta * h;
  at_.d = from.d;
  inlinedProduct(W, n, n, point.inside, at_.w.data(), n);
  inlinedProduct(W, n, nu, point.twice, at_.u.data(), nu);
  inlinedProduct(W, n, nu, point.once, at_.v.data(), nu);
  inlinedProduct(W + nu, n, nx, point.once, at_.x.data(), nx);
  at_.u = from.u + h * (point.theta * from.v + h * at_.u);
  at_.v = from.v + h * at_.v;
  at_.x = from.x + h * at_.x;
  return filter_.filtered(at_, h);
}

// At the start or the end of the step, where u, v, x are known and K has these weights.
template <class Real>
auto Defect<Real>::atEnd(const State<Real>& end, const Real& t, const Vec<Real>& d, const Vec<Real>& weights,
                         const StagePolynomial<Real>& stages) -> Result {
  at_.t = t;
  at_.d = d;
  at_.u = end.u;
  at_.v = end.v;
  at_.x = end.x;
  inlinedProduct(stages.W.data(), sizes_.n(), sizes_.n(), weights, at_.w.data(), sizes_.n());
  return filter_.filtered(at_, stages.h);
}

template <class Real>
auto Defect<Real>::largest(const State<Real>& from, const StagePolynomial<Real>& stages, const State<Real>& to)
    -> Result {
  Result largest;
  const auto add = [&largest](const Result& one) {
    if (largest.outcome == Outcome::kSuccess) largest.outcome = one.outcome;
    largest.error = std::max(largest.error, one.error);
  };
  for (int i = looks(static_cast<double>(stages.h), length_); i > 0; --i) add(at(points_[next_++], from, stages));
  if (looks_at_start_) add(atEnd(from, from.t, from.d, scheme_.start, stages));
  if (looks_at_end_) add(atEnd(to, from.t + stages.h, from.d, scheme_.end, stages));
  return largest;
}

template class MovingPoints<double>;
template class MovingPoints<mp50>;
template class MovingPoints<mp100>;
IRK_INSTANTIATE_CLASS(Defect)

}  // namespace irk
