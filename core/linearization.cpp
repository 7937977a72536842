#include "core/linearization.h"

#include <algorithm>
#include <cmath>

#include "core/multiprecision.h"

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

template <class Real>
template <class T>
Differentiator<Real>::Buffers<T>::Buffers(const Sizes& n)
    : u(n.nu), v(n.nu), x(n.nx), w(n.n()), d(n.discrete), r(n.n()) {}

template <class Real>
template <class T>
Point<T> Differentiator<Real>::Buffers<T>::point(const Sizes& n, const T& t) const {
  return {t,
          {u.data(), n.nu},
          {v.data(), n.nu},
          {x.data(), n.nx},
          {w.data(), n.nu},
          {w.data() + n.nu, n.nx},
          {w.data() + n.nu + n.nx, n.nz},
          {d.data(), n.discrete}};
}

template <class Real>
template <class T>
T& Differentiator<Real>::Buffers<T>::component(const Direction& d, const Sizes& n) {
  if (d.matrix == 0) return w[d.column];
  if (d.matrix == 2) return u[d.column];
  return d.column < n.nu ? v[d.column] : x[d.column - n.nu];
}

template <class Real>
Differentiator<Real>::Differentiator(const System<Real>& system, DerivativeSource source)
    : system_(system),
      source_(source),
      sizes_(system.sizes()),
      dual_(sizes_),
      real_(sizes_),
      base_(sizes_.n()) {
  for (Index j = 0; j < sizes_.n(); ++j) directions_.push_back({0, j});
  for (Index j = 0; j < sizes_.nu + sizes_.nx; ++j) directions_.push_back({1, j});
  for (Index j = 0; j < sizes_.nu; ++j) directions_.push_back({2, j});
}

template <class Real>
void Differentiator<Real>::store(const Direction& d, Index row, const Real& value,
                                 Linearization<Real>& out) const {
  Vec<Real>& values = d.matrix == 0 ? out.d0 : d.matrix == 1 ? out.d1 : out.d2;
  values[d.column * sizes_.n() + row] = value;
}

template <class Real>
void Differentiator<Real>::evaluate(Level level, const Point<Real>& p, Linearization<Real>& out) {
  switch (source_) {
    case DerivativeSource::kAutomatic: return evaluateDual(level, p, out);
    case DerivativeSource::kCentral:
    case DerivativeSource::kForward: return evaluateDifferences(level, p, out);
  }
}

namespace {
// Copies the numbers below a point into buffers of another scalar.
template <class Buffers, class Real>
void copyPoint(const Point<Real>& p, const Sizes& n, Buffers& to) {
  for (Index i = 0; i < n.nu; ++i) to.u[i] = p.u[i];
  for (Index i = 0; i < n.nu; ++i) to.v[i] = p.v[i];
  for (Index i = 0; i < n.nx; ++i) to.x[i] = p.x[i];
  for (Index i = 0; i < n.nu; ++i) to.w[i] = p.a[i];
  for (Index i = 0; i < n.nx; ++i) to.w[n.nu + i] = p.k[i];
  for (Index i = 0; i < n.nz; ++i) to.w[n.nu + n.nx + i] = p.z[i];
  for (Index i = 0; i < n.discrete; ++i) to.d[i] = p.d[i];
}
}  // namespace

template <class Real>
void Differentiator<Real>::evaluateDual(Level level, const Point<Real>& p,
                                        Linearization<Real>& out) {
  copyPoint(p, sizes_, dual_);
  const auto at = dual_.point(sizes_, Dual<Real>(p.t));
  const VecView<Dual<Real>> r(dual_.r.data(), sizes_.n());
  for (std::size_t first = 0; first < directions_.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, directions_.size() - first);
    for (std::size_t c = 0; c < count; ++c) {
      dual_.component(directions_[first + c], sizes_).d[c] = Real(1);
    }
    system_.evaluate(level, at, r);
    for (std::size_t c = 0; c < count; ++c) {
      const Direction& d = directions_[first + c];
      for (Index i = 0; i < sizes_.n(); ++i) store(d, i, r[i].d[c], out);
      dual_.component(d, sizes_).d[c] = Real(0);
    }
  }
}

// Increments: eps^(1/2) (forward) and eps^(1/3) (central) times max(|y|, 1) balance truncation and
// round-off; Dennis & Schnabel, section 5.4.
template <class Real>
void Differentiator<Real>::evaluateDifferences(Level level, const Point<Real>& p,
                                               Linearization<Real>& out) {
  using std::abs;
  using std::cbrt;
  using std::sqrt;
  const bool central = source_ == DerivativeSource::kCentral;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  const Real relative = central ? Real(cbrt(eps)) : Real(sqrt(eps));
  copyPoint(p, sizes_, real_);
  const auto at = real_.point(sizes_, p.t);
  const VecView<Real> r(real_.r.data(), sizes_.n());
  if (!central) {
    system_.evaluate(level, at, r);
    base_ = r;
  }
  for (const Direction& d : directions_) {
    Real& y = real_.component(d, sizes_);
    const Real y0 = y;
    const Real magnitude = abs(y0) > Real(1) ? Real(abs(y0)) : Real(1);
    const Real upper = y0 + relative * magnitude;
    const Real lower = central ? Real(y0 - relative * magnitude) : y0;
    if (central) {
      y = lower;
      system_.evaluate(level, at, r);
      base_ = r;
    }
    y = upper;
    system_.evaluate(level, at, r);
    y = y0;
    for (Index i = 0; i < sizes_.n(); ++i) {
      store(d, i, Real((r[i] - base_[i]) / (upper - lower)), out);
    }
  }
}

IRK_INSTANTIATE_CLASS(Differentiator)

}  // namespace irk
