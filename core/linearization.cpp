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
T& Differentiator<Real>::Buffers<T>::component(const Direction& along, const Sizes& n) {
  if (along.matrix == 0) return w[along.column];
  if (along.matrix == 2) return u[along.column];
  return along.column < n.nu ? v[along.column] : x[along.column - n.nu];
}

template <class Real>
Differentiator<Real>::Differentiator(const System<Real>& system, DerivativeSource source,
                                     JacobianTerms terms)
    : system_(system),
      source_(source),
      sizes_(system.sizes()),
      terms_(terms),
      dual_(sizes_),
      real_(sizes_),
      base_(sizes_.n()),
      zero_a_(Vec<Real>::Zero(sizes_.nu)) {
  const Index nu = sizes_.nu, nx = sizes_.nx, n = sizes_.n();
  const bool no_mass = terms == JacobianTerms::kNoMass;
  const bool no_vxz = no_mass || terms == JacobianTerms::kNoMassVxz;
  for (Index j = 0; j < nu + nx; ++j) at_a_.push_back({0, j});
  for (Index j = nu + nx; j < n; ++j) (no_vxz ? at_zero_ : at_a_).push_back({0, j});
  for (Index j = 0; j < nu + nx; ++j) (no_vxz ? at_zero_ : at_a_).push_back({1, j});
  // Other rows than F2 have no constant stiffness: with them D2 has to be evaluated anyway.
  const bool once = terms == JacobianTerms::kConstantStiffness && n == nu;
  for (Index j = 0; j < nu; ++j) {
    (no_mass ? at_zero_ : once ? stiffness_ : at_a_).push_back({2, j});
  }
}

template <class Real>
void Differentiator<Real>::store(const Direction& d, Index row, const Real& value,
                                 Linearization<Real>& out) const {
  Vec<Real>& values = d.matrix == 0 ? out.d0 : d.matrix == 1 ? out.d1 : out.d2;
  values[d.column * sizes_.n() + row] = value;
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
void Differentiator<Real>::evaluate(Level level, const Point<Real>& p, Linearization<Real>& out) {
  evaluateGroup(at_a_, level, p, out);
  if (!stiffness_known_) evaluateGroup(stiffness_, level, p, out);
  if (!at_zero_.empty()) {
    const ConstVec<Real> zero(zero_a_.data(), sizes_.nu);
    evaluateGroup(at_zero_, level, {p.t, p.u, p.v, p.x, zero, p.k, p.z, p.d}, out);
  }
  if (terms_ == JacobianTerms::kNoConstraintXz) dropConstraintXz(out);
  if (terms_ == JacobianTerms::kConstantStiffness) keepStiffness(out);
}

template <class Real>
void Differentiator<Real>::evaluateGroup(const Directions& group, Level level,
                                         const Point<Real>& p, Linearization<Real>& out) {
  if (group.empty()) return;
  t_ = p.t;
  if (source_ == DerivativeSource::kAutomatic) {
    copyPoint(p, sizes_, dual_);
    evaluateDual(group, level, out);
  } else {
    copyPoint(p, sizes_, real_);
    evaluateDifferences(group, level, out);
  }
}

template <class Real>
void Differentiator<Real>::dropConstraintXz(Linearization<Real>& out) const {
  const Index n = sizes_.n();
  Eigen::Map<Mat<Real>> D0(out.d0.data(), n, n), D1(out.d1.data(), n, n);
  D0.bottomRightCorner(sizes_.nz, sizes_.nz).setZero();
  D1.block(n - sizes_.nz, sizes_.nu, sizes_.nz, sizes_.nx).setZero();
}

template <class Real>
void Differentiator<Real>::keepStiffness(Linearization<Real>& out) {
  Eigen::Map<Mat<Real>> D2(out.d2.data(), sizes_.n(), sizes_.n());
  auto F2_u = D2.topLeftCorner(sizes_.nu, sizes_.nu);
  if (stiffness_known_) {
    F2_u = kept_stiffness_;
  } else {
    kept_stiffness_ = F2_u;
    stiffness_known_ = true;
  }
}

template <class Real>
void Differentiator<Real>::evaluateDual(const Directions& group, Level level,
                                        Linearization<Real>& out) {
  const auto at = dual_.point(sizes_, Dual<Real>(t_));
  const VecView<Dual<Real>> r(dual_.r.data(), sizes_.n());
  for (std::size_t first = 0; first < group.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, group.size() - first);
    for (std::size_t c = 0; c < count; ++c) {
      dual_.component(group[first + c], sizes_).d[c] = Real(1);
    }
    system_.evaluate(level, at, r);
    for (std::size_t c = 0; c < count; ++c) {
      const Direction& d = group[first + c];
      for (Index i = 0; i < sizes_.n(); ++i) store(d, i, r[i].d[c], out);
      dual_.component(d, sizes_).d[c] = Real(0);
    }
  }
}

// Increments: eps^(1/2) (forward) and eps^(1/3) (central) times max(|y|, 1) balance truncation and
// round-off; Dennis & Schnabel, section 5.4.
template <class Real>
void Differentiator<Real>::evaluateDifferences(const Directions& group, Level level,
                                               Linearization<Real>& out) {
  using std::abs;
  using std::cbrt;
  using std::sqrt;
  const bool central = source_ == DerivativeSource::kCentral;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  const Real relative = central ? Real(cbrt(eps)) : Real(sqrt(eps));
  const auto at = real_.point(sizes_, t_);
  const VecView<Real> r(real_.r.data(), sizes_.n());
  if (!central) {
    system_.evaluate(level, at, r);
    base_ = r;
  }
  for (const Direction& d : group) {
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
