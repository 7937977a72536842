#include "core/estimates/embedded.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/legendre.h"
#include "core/base/small_product.h"
#include "core/base/threads.h"
#include "core/linear/block_form.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class Real>
StageSolverSetup<Real> filterSetup(const System<Real>& system, const Real& mu) {
  return {Mat<Real>::Constant(1, 1, mu), nullptr, system.rowPowers(), system.sizes()};
}

// Whether the first stage is at the step's start, where it has the same input as the start itself.
template <class Real>
bool beginsAtStart(const Vec<Real>& c) {
  constexpr double kSamePoint = 1e-10;
  return std::abs(static_cast<double>(c[0])) < kSamePoint;
}

// Weights, at the step's start, of the polynomial through all stages but the first.
template <class Real>
Vec<Real> withoutFirst(const Vec<Real>& c) {
  Vec<Real> weights = Vec<Real>::Zero(c.size());
  for (Index j = 1; j < c.size(); ++j) {
    weights[j] = Real(1);
    for (Index i = 1; i < c.size(); ++i) {
      if (i != j) weights[j] *= c[i] / (c[i] - c[j]);
    }
  }
  return weights;
}

}  // namespace

template <class Real>
int EmbeddedEstimate<Real>::order(const Tableau<Real>& tableau) {
  const int stages = static_cast<int>(tableau.stages()) - (beginsAtStart(tableau.c) ? 1 : 0);
  return std::min(stages, tableau.stage_order + 1);
}

template <class Real>
Vec<Real> EmbeddedEstimate<Real>::atStart(const Scheme<Real>& scheme) {
  return beginsAtStart(scheme.c) ? withoutFirst(scheme.c) : scheme.start;
}

template <class Real>
Real EmbeddedEstimate<Real>::weight(const Tableau<Real>& tableau) {
  using std::pow;
  Real determinant(1);
  const auto form = schurForm(tableau.A);
  for (const auto& block : form->blocks) {
    if (block.size == 1 && block.mu.real() > Real(0)) return block.mu.real();
    determinant *= block.mu.real() * block.mu.real() + block.mu.imag() * block.mu.imag();
  }
  return pow(determinant, Real(1) / Real(static_cast<double>(tableau.stages())));
}

template <class Real>
EmbeddedEstimate<Real>::EmbeddedEstimate(const System<Real>& system, const Scheme<Real>& scheme,
                                         const IntegratorOptions& options, NewtonMatrix<Real>& stages,
                                         const ErrorNorm<Real>& norm, Counters& counters)
    : system_(system),
      scheme_(scheme),
      norm_(norm),
      sizes_(system.sizes()),
      threads_(options.threads),
      mu_(weight(scheme.tableau)),
      stages_(stages),
      kind_(options.solver),
      counters_(counters),
      scaled_(scalesRows(system.rowPowers())),
      scales_(scaled_ ? sizes_.n() : 0),
      full_(scheme.s, 2),
      lower_(scheme.s, 2),
      basis_(scheme.s),
      defect_(sizes_.n()),
      predicted_(sizes_.n()),
      slip_(sizes_.nu),
      e_(sizes_.n(), 1),
      inside_(sizes_.n(), kAtOnce) {
  legendre<Real>(Real(0), basis_);
  full_.col(0) = atStart(scheme);
  full_.col(1).noalias() = scheme.A_transposed * full_.col(0);
  for (State<Real>* of : {&at_, &error_, &beside_}) {
    of->u.setZero(sizes_.nu);
    of->v.setZero(sizes_.nu);
    of->x.setZero(sizes_.nx);
  }
  at_.d.setZero(sizes_.discrete);
  for (State<Real>* of : {&error_, &beside_}) of->w.setZero(sizes_.n());
}

template <class Real>
Index EmbeddedEstimate<Real>::worstComponent() const {
  return norm_.worst(*last_, State<Real>(sizes_), 1, Vec<double>::Ones(sizes_.components()));
}

// The point with u, and v, x, d of `state`, and w = K(0).
template <class Real>
Point<Real> EmbeddedEstimate<Real>::pointAt(const Real& t, const Vec<Real>& u, const State<Real>& state) const {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  const Real* const w = defect_.data();
  return {t,       {u.data(), nu}, {state.v.data(), nu},     {state.x.data(), nx},
          {w, nu}, {w + nu, nx},   {w + nu + nx, sizes_.nz}, {state.d.data(), sizes_.discrete}};
}

// e_ = (D0 + h mu D1 + h^2 mu^2 D2)^-1 e_
template <class Real>
Outcome EmbeddedEstimate<Real>::solve(const Real& h) {
  if (stages_.solveReal(h, mu_, e_.data())) return Outcome::kSuccess;
  if (!own_) own_.emplace(stages_.shared(), kind_, filterSetup(system_, mu_), counters_, SolverOf::kFilter);
  const Outcome outcome = own_->prepare(h);
  if (outcome == Outcome::kSuccess) own_->solve(e_);
  return outcome;
}

// Scales the rows of a residual r, and sets those to zero that say nothing about the error at the step's end. Inside,
// these are the rows of constraints of index 2 and 3, which the continuous solution satisfies at the stages only. At
// the start it is g(u0) of index 3. Newton's method leaves a residual delta in it, which changes the accelerations
// normal to the constraint by delta / h^2 and would appear in the estimate of velocities as delta / h, however small h
// is. Without this row the estimate is that of the motion along the constraint.
template <class Real>
Outcome EmbeddedEstimate<Real>::scaleAndCheck(Real* r, EquationsAt at) const {
  VecView<Real> rows(r, sizes_.n());
  if (scaled_) rows.array() *= scales_.array();
  if (!rows.allFinite()) return Outcome::kNotFinite;
  if (sizes_.nz == 0) return Outcome::kSuccess;
  const int least = at == EquationsAt::kInside ? 1 : 2;
  const auto& powers = system_.errorPowers().z;
  for (Index i = 0; i < sizes_.nz; ++i) {
    if (powers[static_cast<std::size_t>(i)] >= least) rows[sizes_.nu + sizes_.nx + i] = Real(0);
  }
  return Outcome::kSuccess;
}

// Sets e_ to the residual at `p`.
template <class Real>
Outcome EmbeddedEstimate<Real>::evaluateAt(const Point<Real>& p, EquationsAt at) {
  system_.evaluate(Level::kFormulated, p, VecView<Real>(e_.data(), e_.rows()));
  return scaleAndCheck(e_.data(), at);
}

// Solves for e with the residual e_, and sets `error` to the error of the state that follows from e.
template <class Real>
Outcome EmbeddedEstimate<Real>::filter(const Real& h, State<Real>& error) {
  last_ = &error;
  const Outcome solved = solve(h);
  if (solved != Outcome::kSuccess) return solved;
  const Real step = h * mu_;
  const Real* const e = e_.data();
  inParts(threads_, sizes_.nu, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      error.v[i] = -step * e[i];
      error.u[i] = slip_[i] + step * error.v[i];
    }
  });
  inParts(threads_, sizes_.nx, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) error.x[i] = -step * e[sizes_.nu + i];
  });
  const auto& powers = system_.errorPowers().z;
  for (Index i = 0; i < sizes_.nz; ++i) {
    error.z()[i] = powers[static_cast<std::size_t>(i)] == 2 ? Real(0) : Real(-e[sizes_.nu + sizes_.nx + i]);
  }
  return Outcome::kSuccess;
}

template <class Real>
auto EmbeddedEstimate<Real>::estimate(const State<Real>& from, const StagePolynomial<Real>& stages,
                                      const AtStart& polynomial, double again_above, State<Real>& error) -> Result {
  const Real& h = stages.h;
  Result result;
  if (scaled_) rowScales(system_.rowPowers(), h, scales_);
  const auto column = [&](Index i) { return Eigen::Map<const Vec<Real>>(polynomial.col(i).data(), scheme_.s); };
  productOnThreads(threads_, stages.W.data(), sizes_.n(), sizes_.n(), column(0), defect_.data(), sizes_.n());
  // v0 - V(0) = -h sum_j (A^T l)_j a_j
  productOnThreads(threads_, stages.W.data(), sizes_.n(), sizes_.nu, column(1), slip_.data(), sizes_.nu);
  const Real factor = -mu_ * h * h;
  for (Index i = 0; i < sizes_.nu; ++i) {
    slip_[i] *= factor;
    at_.u[i] = from.u[i] + slip_[i];
  }
  result.outcome = evaluateAt(pointAt(from.t, at_.u, from), EquationsAt::kStart);
  if (result.outcome == Outcome::kSuccess) result.outcome = filter(h, error);
  if (result.outcome != Outcome::kSuccess) return result;
  result.error = norm_.magnitude(error, static_cast<double>(h));
  if (result.error > again_above) {
    slip_ += (h * mu_) * error.v;
    at_.u = from.u + error.u + slip_;
    at_.v = from.v + error.v;
    at_.x = from.x + error.x;
    at_.d = from.d;
    result.outcome = evaluateAt(pointAt(from.t, at_.u, at_), EquationsAt::kStart);
    if (result.outcome == Outcome::kSuccess) result.outcome = filter(h, error);
    if (result.outcome != Outcome::kSuccess) return result;
    result.error = norm_.magnitude(error, static_cast<double>(h));
  }
  if (!std::isfinite(result.error)) result.outcome = Outcome::kNotFinite;
  return result;
}

template <class Real>
auto EmbeddedEstimate<Real>::evaluate(const State<Real>& from, const StagePolynomial<Real>& stages, double again_above)
    -> Result {
  return estimate(from, stages, full_, again_above, error_);
}

template <class Real>
void EmbeddedEstimate<Real>::residualBehind() {
  const Linearization<Real>& at = stages_.shared().at().front();
  predicted_.setZero();
  for (Index j = 0; j < sizes_.n(); ++j) {
    const auto c = static_cast<std::size_t>(j);
    for (int k = at.pattern->column_start[c]; k < at.pattern->column_start[c + 1]; ++k) {
      predicted_[at.pattern->row[static_cast<std::size_t>(k)]] += at.d0[k] * e_(j, 0);
    }
  }
  if (scaled_) predicted_.array() *= scales_.array();
}

namespace {

// Raises most_i to |r_i| where that is larger; returns whether it was in any row.
template <class Real>
bool raises(const Real* r, Vec<Real>& most) {
  using std::abs;
  bool raised = false;
  for (Index i = 0; i < most.size(); ++i) {
    const Real size = abs(r[i]);
    if (!(size > most[i])) continue;
    most[i] = size;
    raised = true;
  }
  return raised;
}

}  // namespace

template <class Real>
auto EmbeddedEstimate<Real>::largestInside(const StagePoints<Real>& at, Index count, const Real& h, Vec<Real>& most)
    -> Result {
  if (scaled_) rowScales(system_.rowPowers(), h, scales_);
  Result largest;
  const auto fails = [&](Outcome outcome) {
    if (largest.outcome == Outcome::kSuccess) largest.outcome = outcome;
  };
  for (Index j = 0; j < count; ++j) {
    if (j % kAtOnce == 0) system_.evaluatePoints(at, j, std::min(count, j + kAtOnce), inside_.data());
    Real* const r = inside_.col(j % kAtOnce).data();
    const Outcome outcome = scaleAndCheck(r, EquationsAt::kInside);
    if (outcome != Outcome::kSuccess) {
      fails(outcome);
    } else if (raises(r, most)) {
      e_.col(0) = inside_.col(j % kAtOnce);
      const Result one = filteredInside(at[j], h);
      fails(one.outcome);
      largest.error = std::max(largest.error, one.error);
    }
  }
  return largest;
}

// The error at `p`, whose residual is in e_.
template <class Real>
auto EmbeddedEstimate<Real>::filteredInside(const Point<Real>& p, const Real& h) -> Result {
  Result result;
  slip_.setZero();
  const auto measure = [&] {
    result.outcome = filter(h, beside_);
    if (result.outcome != Outcome::kSuccess) return;
    beside_.z().setZero();
    result.error = norm_.magnitude(beside_, static_cast<double>(h));
    if (!std::isfinite(result.error)) result.outcome = Outcome::kNotFinite;
  };
  measure();
  if (result.outcome != Outcome::kSuccess || result.error <= 1) return result;
  at_.u = p.u + beside_.u;
  at_.v = p.v + beside_.v;
  at_.x = p.x + beside_.x;
  residualBehind();
  const Point<Real> behind{
      p.t, {at_.u.data(), sizes_.nu}, {at_.v.data(), sizes_.nu}, {at_.x.data(), sizes_.nx}, p.a, p.k, p.z, p.d};
  result.outcome = evaluateAt(behind, EquationsAt::kInside);
  if (result.outcome == Outcome::kSuccess) measure();
  if (result.outcome != Outcome::kSuccess) return result;
  const double evaluated = result.error;
  e_.col(0) = predicted_;
  measure();
  result.error = std::max(result.error, evaluated);
  return result;
}

template <class Real>
auto EmbeddedEstimate<Real>::evaluateLower(const State<Real>& from, const StagePolynomial<Real>& stages, Index q)
    -> Result {
  const Index terms = beginsAtStart(scheme_.c) ? std::max<Index>(q - 1, 1) : q;
  lower_.col(0).noalias() = scheme_.legendre_inverse.topRows(terms).transpose() * basis_.head(terms);
  lower_.col(1).noalias() = scheme_.A_transposed * lower_.col(0);
  return estimate(from, stages, lower_, std::numeric_limits<double>::infinity(), beside_);
}

IRK_INSTANTIATE_CLASS(EmbeddedEstimate)

}  // namespace irk
