#include "core/derivatives/first_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "irk/misuse.h"
#include "irk/multiprecision.h"
#include "irk/problem.h"
#include "irk/system_check.h"

namespace irk {
namespace {

constexpr int kRateIterations = 25;

template <class Real>
bool allFinite(const Vec<Real>& x) {
  using std::isfinite;
  return std::all_of(x.begin(), x.end(), [](const Real& value) { return isfinite(value); });
}

}  // namespace

template <class Real>
FirstOrderForm<Real>::FirstOrderForm(std::shared_ptr<const System<Real>> inner, MassFactors factors)
    : inner_((requireSystem(inner.get(), {}), std::move(inner))),
      inner_sizes_(inner_->sizes()),
      factors_(factors),
      at_(inner_sizes_),
      start_w_(at_.w),
      residual_(inner_sizes_.n()),
      column_(inner_sizes_.n()),
      values_(2 * inner_sizes_.nu + inner_sizes_.nx + inner_sizes_.discrete),
      dual_(inner_sizes_),
      dual_residual_(inner_sizes_.n()),
      diagonal_(inner_sizes_.n()) {
  sizes_.nx = 2 * inner_sizes_.nu + inner_sizes_.nx;
  sizes_.discrete = inner_sizes_.discrete;
  sizes_.switches = inner_sizes_.switches;
  row_powers_.assign(static_cast<std::size_t>(sizes_.nx), 0);
  error_powers_.x = row_powers_;
}

template <class Real>
void FirstOrderForm<Real>::evaluate(Level, const Point<Real>& p, VecView<Real> r) const {
  const Index nu = inner_sizes_.nu, rest = nu + inner_sizes_.nx;
  if (!solve(p.t, p.x.data(), p.d.data())) {
    r.setConstant(std::numeric_limits<Real>::quiet_NaN());
    return;
  }
  r.head(nu) = p.x.segment(nu, nu) - p.k.head(nu);
  r.tail(rest) = at_.w.head(rest) - p.k.tail(rest);
}

template <class Real>
void FirstOrderForm<Real>::evaluateStages(const StagePoints<Real>& at, Index first, Index last, Real* r) const {
  const bool renewed = std::exchange(renewed_, false);
  if (at.t[first] != first_time_ || at.t[last - 1] != last_time_) {
    first_time_ = at.t[first];
    last_time_ = at.t[last - 1];
    if (!renewed) renew_ = true;
  }
  System<Real>::evaluateStages(at, first, last, r);
}

template <class Real>
void FirstOrderForm<Real>::evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const {
  const Index nu = inner_sizes_.nu, nx = inner_sizes_.nx, n = inner_sizes_.n();
  for (Index i = 0; i < p.x.size(); ++i) values_[i] = p.x[i].value;
  for (Index i = 0; i < p.d.size(); ++i) values_[p.x.size() + i] = p.d[i].value;
  if (factors_ == MassFactors::kEachStep && !holds(p.t.value, values_.data(), values_.data() + p.x.size())) {
    renew_ = renewed_ = true;  // derivatives take the factors as they are
  }
  if (!solve(p.t.value, values_.data(), values_.data() + p.x.size())) {
    r.setConstant(Dual<Real>(std::numeric_limits<Real>::quiet_NaN()));
    return;
  }
  dual_.t = p.t;
  dual_.u = p.x.head(nu);
  dual_.v = p.x.segment(nu, nu);
  dual_.x = p.x.tail(nx);
  for (Index i = 0; i < n; ++i) dual_.w[i] = Dual<Real>(at_.w[i]);
  for (Index i = 0; i < p.d.size(); ++i) dual_.d[i] = Dual<Real>(at_.d[i]);
  inner_->evaluate(Level::kAcceleration, pointOf(dual_), {dual_residual_.data(), n});
  for (Index i = 0; i < n; ++i) residual_[i] = dual_residual_[i].value;
  if (rates_ != Rates::kNonlinear && !isSolution(residual_)) {  // `classify` was wrong for this point
    rates_ = Rates::kNonlinear;
    solved_ = false;
    return evaluate(level, p, r);
  }
  for (std::size_t c = 0; c < kChunk; ++c) {
    for (Index i = 0; i < n; ++i) column_[i] = -dual_residual_[i].d[c];
    if ((column_.array() != Real(0)).any()) divideByMatrix(column_);
    for (Index i = 0; i < n; ++i) dual_.w[i].d[c] = column_[i];
  }
  for (Index i = 0; i < nu; ++i) r[i] = p.x[nu + i] - p.k[i];
  for (Index i = 0; i < nu + nx; ++i) r[nu + i] = dual_.w[i] - p.k[nu + i];
}

// --- Solves for w = (a, k, z) at a point; at_ keeps the point and w.

template <class Real>
bool FirstOrderForm<Real>::holds(const Real& t, const Real* y, const Real* d) const {
  return at_.t == t && std::equal(at_.u.begin(), at_.u.end(), y) &&
         std::equal(at_.v.begin(), at_.v.end(), y + at_.u.size()) &&
         std::equal(at_.x.begin(), at_.x.end(), y + 2 * at_.u.size()) && std::equal(at_.d.begin(), at_.d.end(), d);
}

// All dual evaluations of one Jacobian are at the same point: w and the factorization are computed once.
template <class Real>
bool FirstOrderForm<Real>::solve(const Real& t, const Real* y, const Real* d) const {
  if (solved_ && holds(t, y, d)) return true;
  const Index nu = inner_sizes_.nu;
  at_.t = t;
  std::copy_n(y, nu, at_.u.begin());
  std::copy_n(y + nu, nu, at_.v.begin());
  std::copy_n(y + 2 * nu, inner_sizes_.nx, at_.x.begin());
  std::copy_n(d, inner_sizes_.discrete, at_.d.begin());
  const bool varies = rates_ == Rates::kLinear || rates_ == Rates::kNonlinear;
  if (factors_ == MassFactors::kEachStep && varies && !std::exchange(renew_, false) && iterate(Factors::kKept)) {
    solved_ = true;
  } else {
    solved_ = rates_ == Rates::kNonlinear ? iterate(Factors::kRenewed) : solveLinear();
    renew_ = !solved_;
  }
  return solved_;
}

// For r linear in w: w solves r(0) + D0 w = 0.
template <class Real>
bool FirstOrderForm<Real>::solveLinear() const {
  at_.w.setZero();
  if (rates_ == Rates::kLinear) {
    evaluateMatrix();
    if (!factorize()) return false;
  } else {
    inner_->evaluate(Level::kAcceleration, pointOf(at_), {residual_.data(), residual_.size()});
  }
  at_.w = -residual_;
  divideByMatrix(at_.w);
  return allFinite(at_.w);
}

// From the w of the last point, until the change is as small as round-off: by Newton's method, or by w -= M^-1 r with
// the factors of another point. The residual is exact, so w is as well.
template <class Real>
bool FirstOrderForm<Real>::iterate(Factors factors) const {
  using std::sqrt;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  Real last = std::numeric_limits<Real>::max();
  for (int i = 0; i < kRateIterations; ++i) {
    if (factors == Factors::kRenewed) {
      evaluateMatrix();
      if (!factorize()) break;
    } else {
      inner_->evaluate(Level::kAcceleration, pointOf(at_), {residual_.data(), residual_.size()});
    }
    divideByMatrix(residual_);
    at_.w -= residual_;
    if (!allFinite(at_.w)) break;
    const Real change = residual_.norm(), size = Real(1) + Real(at_.w.norm());
    const bool stalled = change >= last && change <= Real(sqrt(eps)) * size;
    if (change <= Real(100) * eps * size || stalled) return true;
    if (factors == Factors::kKept && !(change < last / 2)) break;
    last = change;
  }
  at_.w = start_w_;
  return false;
}

// Whether at_.w solves the residual: a Newton step would change it by less than half of its digits.
template <class Real>
bool FirstOrderForm<Real>::isSolution(const Vec<Real>& residual) const {
  using std::sqrt;
  column_ = residual;
  divideByMatrix(column_);
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  return Real(column_.norm()) <= Real(sqrt(eps)) * (Real(1) + Real(at_.w.norm()));
}

// A new integration finds the pattern of D0 anew, so that its results are those of a new object.
template <class Real>
void FirstOrderForm<Real>::forgetPattern() const {
  if (!std::is_same_v<Real, double> || inner_sizes_.n() < kSparseFrom) return;
  sparse_ = std::make_unique<Differentiator<Real>>(*inner_, DerivativeSource::kAutomatic, JacobianTerms::kFull,
                                                   Storage::kAutomatic, Matrices::kOnlyD0);
}

// Evaluates D0 and the residual at at_.
template <class Real>
void FirstOrderForm<Real>::evaluateMatrix() const {
  if (sparse_) {
    sparse_->evaluate(Level::kAcceleration, pointOf(at_), D_);
    if (D_.pattern->full) sparse_.reset();
  }
  if (!sparse_) return evaluateColumns();
  inner_->evaluate(Level::kAcceleration, pointOf(at_), {residual_.data(), residual_.size()});
}

// Both at once, by dual numbers: one direction per column.
template <class Real>
void FirstOrderForm<Real>::evaluateColumns() const {
  const Index n = inner_sizes_.n();
  if (!D_.pattern || !D_.pattern->full) {
    D_.pattern = Pattern::dense(n);
    D_.d0.resize(n * n);
  }
  const auto lift = [](const Vec<Real>& from, Vec<Dual<Real>>& to) {
    for (Index i = 0; i < from.size(); ++i) to[i] = Dual<Real>(from[i]);
  };
  dual_.t = Dual<Real>(at_.t);
  lift(at_.u, dual_.u);
  lift(at_.v, dual_.v);
  lift(at_.x, dual_.x);
  lift(at_.w, dual_.w);
  lift(at_.d, dual_.d);
  const Index chunk = static_cast<Index>(kChunk);
  for (Index first = 0; first < n; first += chunk) {
    const Index count = std::min(chunk, n - first);
    for (Index c = 0; c < count; ++c) dual_.w[first + c].d[static_cast<std::size_t>(c)] = Real(1);
    inner_->evaluate(Level::kAcceleration, pointOf(dual_), {dual_residual_.data(), n});
    for (Index c = 0; c < count; ++c) {
      for (Index i = 0; i < n; ++i) {
        D_.d0[(first + c) * n + i] = dual_residual_[i].d[static_cast<std::size_t>(c)];
      }
      dual_.w[first + c].d[static_cast<std::size_t>(c)] = Real(0);
    }
  }
  for (Index i = 0; i < n; ++i) residual_[i] = dual_residual_[i].value;
}

template <class Real>
bool FirstOrderForm<Real>::factorize() const {
  ++factorizations_;
  return lu_.factorize(D_) == Outcome::kSuccess;
}

template <class Real>
void FirstOrderForm<Real>::divideByMatrix(Vec<Real>& x) const {
  if (rates_ == Rates::kDiagonal) {
    x.array() /= diagonal_.array();
  } else {
    lu_.solve(x);
  }
}

// --- Translates between the scene's unknowns and y.

template <class Real>
void FirstOrderForm<Real>::switching(const Point<Real>& p, VecView<Real> g) const {
  if (solve(p.t, p.x.data(), p.d.data())) return inner_->switching(pointOf(at_), g);
  g.setConstant(std::numeric_limits<Real>::quiet_NaN());
}

template <class Real>
void FirstOrderForm<Real>::switchBy(const char* name, Change change, Index i, State<Real>& state) const {
  State<Real> scene = toScene(state);
  (*inner_.*change)(i, scene);
  takeMode(name, scene, state);
}

template <class Real>
void FirstOrderForm<Real>::jumpBy(const char* name, Change change, Index i, State<Real>& state) const {
  State<Real> scene = toScene(state);
  (*inner_.*change)(i, scene);
  requireState(name, scene, inner_sizes_);
  state.x << scene.u, scene.v, scene.x;
}

template <class Real>
State<Real> FirstOrderForm<Real>::fromScene(const State<Real>& scene) const {
  start_w_ = scene.w;
  forgetPattern();
  if (!classify(scene)) {
    throw Misuse(
        "illegal combination: formulation 'first_order' with a system whose D0 = "
        "dr/d(a,k,z) is singular at the start: (a, k, z) do not follow from (u, v, x)");
  }
  factorizations_ = 0;
  State<Real> state(sizes_);
  state.t = scene.t;
  state.d = scene.d;
  state.x << scene.u, scene.v, scene.x;
  state.w << scene.v, scene.w.head(inner_sizes_.nu + inner_sizes_.nx);
  return state;
}

template <class Real>
State<Real> FirstOrderForm<Real>::toScene(const State<Real>& state) const {
  const bool solved = solve(state.t, state.x.data(), state.d.data());
  State<Real> scene = at_;
  if (!solved) scene.w.setConstant(std::numeric_limits<Real>::quiet_NaN());
  return scene;
}

template <class Real>
std::shared_ptr<const System<Real>> firstOrderForm(std::shared_ptr<const System<Real>> system, MassFactors factors) {
  return std::make_shared<const FirstOrderForm<Real>>(std::move(system), factors);
}

template <class Real>
std::shared_ptr<const System<Real>> firstOrderForm(std::shared_ptr<const System<Real>> system) {
  return firstOrderForm(std::move(system), MassFactors::kEachPoint);
}

IRK_INSTANTIATE_CLASS(FirstOrderForm)
template std::shared_ptr<const System<double>> firstOrderForm(std::shared_ptr<const System<double>>, MassFactors);
template std::shared_ptr<const System<double>> firstOrderForm(std::shared_ptr<const System<double>>);
template std::shared_ptr<const System<BigFloat>> firstOrderForm(std::shared_ptr<const System<BigFloat>>, MassFactors);
template std::shared_ptr<const System<BigFloat>> firstOrderForm(std::shared_ptr<const System<BigFloat>>);

}  // namespace irk
