#include "core/stages/stage_equations.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/small_product.h"
#include "core/base/threads.h"
#include "core/stage_solvers/stage_solver.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// The part of a step at which the derivatives are evaluated that represent all stages. Measured: 0.5 to 0.7 are
// equally good and save a tenth to a third of the iterations, compared with derivatives at the start.
constexpr double kInner = 0.6;
constexpr Index kFewEntries = 4;

// y1 = y0 + (y1 + carry0), where y1 comes in as the increment; carry1 is the round-off of the last addition. Knuth's
// two-sum: carry1 is exact, whichever operand is larger.
template <class Real>
void addCompensated(const Vec<Real>& from, const Real* __restrict carry0, Vec<Real>& to, Real* __restrict carry1) {
  const Real* const __restrict y0 = from.data();
  Real* const __restrict y1 = to.data();
  withSize<unrolledSizes<Real>(kFewEntries)>(from.size(), [&](auto n) {
    for (Index i = 0; i < n; ++i) {
      const Real a = y0[i], b = y1[i] + carry0[i];
      const Real sum = a + b;
      const Real rounded = sum - a;
      carry1[i] = (a - (sum - rounded)) + (b - rounded);
      y1[i] = sum;
    }
  });
}

// Whether all n numbers are finite. Few numbers are read one by one: a register of them would wait for those that have
// just been written.
template <class Real>
bool areFinite(const Real* r, Index count) {
  return withSize<unrolledSizes<Real>(9)>(count, [&](auto n) {
    if constexpr (std::is_same_v<decltype(n), Index>) {
      return (ConstVec<Real>(r, n).array() * Real(0)).sum() == Real(0);
    } else {
      Real sum(0);
      for (Index i = 0; i < n; ++i) sum += r[i] * Real(0);
      return sum == Real(0);
    }
  });
}

// to = f A, of which a step has few entries.
template <class Real>
void scaled(const Real& f, const Mat<Real>& A, Mat<Real>& to) {
  const Real* const __restrict a = A.data();
  Real* const __restrict out = to.data();
  withSize<unrolledSizes<Real>(9)>(A.size(), [&](auto n) {
    for (Index i = 0; i < n; ++i) out[i] = f * a[i];
  });
}

}  // namespace

template <class Real>
StageEquations<Real>::StageEquations(const System<Real>& system, const Scheme<Real>& scheme, Summation summation,
                                     int threads)
    : system_(system),
      scheme_(scheme),
      summation_(summation),
      sizes_(system.sizes()),
      threads_(threads),
      inner_(scheme.first),
      scaled_(scalesRows(system.rowPowers())),
      uses_velocity_(system.usesVelocity()),
      U_(sizes_.nu, scheme.s),
      V_(sizes_.nu, scheme.s),
      X_(sizes_.nx, scheme.s),
      hA_(scheme.s, scheme.s),
      hhA2_(sizes_.nu > 0 ? scheme.s : 0, scheme.s),
      hA1_(hhA2_.rows()),
      t_(scheme.s),
      scales_(scaled_ ? sizes_.n() : 0) {
  if (!uses_velocity_) V_.setConstant(std::numeric_limits<Real>::quiet_NaN());
  const auto away = [&](Index i) { return std::abs(static_cast<double>(scheme.c[i]) - kInner); };
  for (Index i = inner_; i < scheme.s; ++i) {
    if (away(i) < away(inner_)) inner_ = i;
  }
}

template <class Real>
void StageEquations<Real>::begin(const State<Real>& from, const Real& h) {
  from_ = &from;
  h_ = h;
  for (Index i = 0; i < scheme_.s; ++i) t_[i] = from.t + scheme_.c[i] * h;
  scaled(h, scheme_.A_transposed, hA_);
  if (sizes_.nu > 0) {
    scaled(Real(h * h), scheme_.A2_transposed, hhA2_);
    hA1_ = h * scheme_.A1;
  }
  if (scaled_) rowScales(system_.rowPowers(), h, scales_);
}

// Paper (2.5), (2.6): V = v0 + h A a, U = u0 + h A 1 v0 + h^2 A^2 a, X = x0 + h A k. (A 1 = c, except for methods of
// stage order 0 such as Radau IA with one stage.) Without V, U is all that Nystroem's form of the method needs.
template <class Real>
void StageEquations<Real>::place(const Mat<Real>& W) {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  const Real *const u = from_->u.data(), *const v = from_->v.data(), *const x = from_->x.data();
  if (nu > 0) {
    if (uses_velocity_) {
      productOnThreads(threads_, W.data(), W.rows(), nu, hA_, V_.data(), nu, FromColumn<Real>{v});
    }
    productOnThreads(threads_, W.data(), W.rows(), nu, hhA2_, U_.data(), nu, FromLine<Real>{u, v, hA1_.data()});
  }
  if (nx > 0) {
    productOnThreads(threads_, W.data() + nu, W.rows(), nx, hA_, X_.data(), nx, FromColumn<Real>{x});
  }
}

template <class Real>
bool StageEquations<Real>::residual(const Mat<Real>& W, Mat<Real>& R) {
  place(W);
  const Index first = scheme_.first, s = scheme_.s, n = sizes_.n();
  if (first > 0) R.leftCols(first).setZero();
  const StagePoints<Real> at = points(W);
  // Of the stages from i to j - 1; returns whether they are finite.
  const auto evaluate = [&](Index i, Index j) {
    system_.evaluateStages(at, i, j, R.data());
    for (Index k = i; k < j && scaled_; ++k) R.col(k).array() *= scales_.array();
    return areFinite(R.col(i).data(), (j - i) * n);
  };
  if (threads_ <= 1) return evaluate(first, s);
  std::atomic<bool> finite = true;
  onThreads(threads_, static_cast<std::size_t>(s - first), [&](std::size_t k) {
    const Index i = first + static_cast<Index>(k);
    if (!evaluate(i, i + 1)) finite = false;
  });
  return finite;
}

template <class Real>
bool StageEquations<Real>::lastResidual(const Mat<Real>& W, Vec<Real>& r) {
  place(W);
  const Index last = scheme_.s - 1;
  system_.evaluatePoints(points(W), last, last + 1, r.data());
  if (scaled_) r.array() *= scales_.array();
  return areFinite(r.data(), r.size());
}

template <class Real>
StagePoints<Real> StageEquations<Real>::points(const Mat<Real>& W) const {
  return {sizes_, t_.data(), U_.data(), V_.data(), X_.data(), W.data(), from_->d.data()};
}

template <class Real>
Point<Real> StageEquations<Real>::stage(const Mat<Real>& W, Index i) const {
  if (uses_velocity_) return points(W)[i];
  const Point<Real> p = points(W)[i];
  return {p.t, p.u, {from_->v.data(), sizes_.nu}, p.x, p.a, p.k, p.z, p.d};
}

template <class Real>
Point<Real> StageEquations<Real>::start() const {
  return pointOf(*from_);
}

template <class Real>
Point<Real> StageEquations<Real>::predicted(const Mat<Real>& W) {
  place(W);
  return stage(W, inner_);
}

template <class Real>
Point<Real> StageEquations<Real>::middle(State<Real>& at) const {
  const Real half = h_ / Real(2);
  at = *from_;
  at.t += half;
  at.u += half * from_->v + (half * half / Real(2)) * from_->a();
  at.v += half * from_->a();
  at.x += half * from_->k();
  return pointOf(at);
}

template <class Real>
void StageEquations<Real>::finish(const Mat<Real>& W, State<Real>& to) {
  const auto z = W.bottomRows(sizes_.nz);
  to.t = from_->t + h_;
  if (sizes_.discrete > 0) to.d = from_->d;
  const Index n = sizes_.n();
  if (sizes_.nu > 0) {
    productOnThreads(threads_, W.data(), n, sizes_.nu, scheme_.bA, to.u.data(), n);
    productOnThreads(threads_, W.data(), n, sizes_.nu, scheme_.b, to.v.data(), n);
    to.u = (h_ * h_) * to.u + h_ * from_->v;
    to.v *= h_;
  }
  productOnThreads(threads_, W.data() + sizes_.nu, n, sizes_.nx, scheme_.b, to.x.data(), n);
  to.x *= h_;
  if (summation_ == Summation::kCompensated) {
    const Real* const before = from_->carry.data();
    Real* const after = to.carry.data();
    addCompensated(from_->u, before, to.u, after);
    addCompensated(from_->v, before + sizes_.nu, to.v, after + sizes_.nu);
    addCompensated(from_->x, before + 2 * sizes_.nu, to.x, after + 2 * sizes_.nu);
  } else {
    to.u += from_->u;
    to.v += from_->v;
    to.x += from_->x;
  }
  if (scheme_.stiffly_accurate) {
    copyFew(W.data() + (scheme_.s - 1) * n, n, to.w.data());
    return;
  }
  to.w.head(sizes_.nu + sizes_.nx).noalias() = W.topRows(sizes_.nu + sizes_.nx) * scheme_.end;
  if (sizes_.nz > 0) {
    to.z() = (Real(1) - scheme_.d.sum()) * from_->z();
    to.z().noalias() += z * scheme_.d;
  }
}

IRK_INSTANTIATE_CLASS(StageEquations)

}  // namespace irk
