#include "experiments/runs/peers/problem/ode_problem.h"

#include <algorithm>

#include "core/derivatives/first_order.h"

namespace irk {
namespace {

// The columns df/dy = dr/dx.
std::vector<AssembledColumn> columns(Index n) {
  std::vector<AssembledColumn> all;
  for (Index j = 0; j < n; ++j) all.push_back({.core = j, .d1 = 1});
  return all;
}

const System<double>& withoutForm(const System<double>& system) {
  const auto* form = dynamic_cast<const FirstOrderForm<double>*>(&system);
  return form ? form->inner() : system;
}

}  // namespace

OdeProblem::OdeProblem(const System<double>& system, const ProblemOptions& options)
    : SceneProblem(system),
      no_rates_(Vec<double>::Zero(sizes_.nx)),
      dense_(isDense(options.storage, sizes_.nx)),
      direct_(withoutForm(system)),
      dual_(sizes_),
      f_(sizes_.nx),
      differentiator_(counting_, DerivativeSource::kAutomatic, JacobianTerms::kFull, options.storage),
      assembly_(0, columns(sizes_.nx)) {
  const auto n = static_cast<std::size_t>(sizes_.nx);
  const Index nu = system.sceneSizes().nu;
  layout_ = {.n = sizes_.nx,
             .second_order = 2 * nu <= sizes_.nx ? nu : 0,
             .switches = sizes_.switches,
             .unknowns = std::vector(n, PeerUnknown::kDifferential),
             .index = std::vector(n, 1)};
  pattern_ = fullPattern(sizes_.nx);
}

StartReport OdeProblem::begin(State<double>& state, bool new_run, PeerValues& to) {
  d_ = state.d;
  to.y = state.x;
  to.yp.resize(0);
  direct_.look(state.t, to.y.data(), d_);
  if (dense_) return {};
  if (new_run) differentiator_.forgetPattern();
  pattern_ = assembly_.pattern(differentiator_.pattern(Level::kFormulated, point(state.t, to.y.data())));
  return {};
}

void OdeProblem::read(const PeerStep& step, State<double>& state) const {
  state.t = step.t;
  copyTo(state.x, step.y);
}

// The residual is f - k; at k = 0 it equals f.
Point<double> OdeProblem::point(double t, const double* y) const {
  const ConstVec<double> none(nullptr, 0);
  return {t, none, none, {y, sizes_.nx}, none, {no_rates_.data(), sizes_.nx}, none, {d_.data(), sizes_.discrete}};
}

void OdeProblem::setDiscrete(const Vec<double>& d) {
  SceneProblem::setDiscrete(d);
  direct_.forget();
}

bool OdeProblem::evaluateForm(double t, const double* y, double* f) {
  VecView<double> rows(f, sizes_.nx);
  system_.evaluate(Level::kFormulated, point(t, y), rows);
  return rows.allFinite();
}

bool OdeProblem::evaluateJacobian(double t, const double* y, const double*, double, PeerJacobian& J, double* dfdt) {
  if (pattern_->full) {
    if (J.pattern != pattern_) J.pattern = pattern_;
    J.values.resize(sizes_.nx * sizes_.nx);
    return differentiate(t, y, J.values.data(), dfdt);
  }
  if (direct_.known()) direct_.check(t, y);
  differentiator_.evaluate(Level::kFormulated, point(t, y), D_);
  const bool finite = assembly_.assemble(D_, 0, J);
  pattern_ = J.pattern;
  return (!dfdt || differentiate(t, y, nullptr, dfdt)) && finite;
}

bool OdeProblem::differentiate(double t, const double* y, double* dfdy, double* dfdt) {
  if (direct_.known()) {
    const bool finite = direct_.differentiate(t, y, dfdy, dfdt, evaluations_.dual_residuals);
    if (direct_.known()) return finite;
  }
  return differentiateForm(t, y, dfdy, dfdt);
}

// The directions of differentiation are y, unless `dfdy` is null, and, last, t, unless `dfdt` is null.
bool OdeProblem::differentiateForm(double t, const double* y, double* dfdy, double* dfdt) {
  const Index n = sizes_.nx, chunk = static_cast<Index>(kChunk), end = n + (dfdt ? 1 : 0);
  dual_.t = Dual<double>(t);
  for (Index i = 0; i < n; ++i) dual_.x[i] = Dual<double>(y[i]);
  for (Index i = 0; i < sizes_.discrete; ++i) dual_.d[i] = Dual<double>(d_[i]);
  const auto variable = [&](Index i) -> Dual<double>& { return i < n ? dual_.x[i] : dual_.t; };
  const auto column = [&](Index i) { return i < n ? dfdy + i * n : dfdt; };
  bool finite = true;
  for (Index first = dfdy ? 0 : n; first < end; first += chunk) {
    const Index count = std::min(chunk, end - first);
    for (Index c = 0; c < count; ++c) variable(first + c).d[static_cast<std::size_t>(c)] = 1;
    counting_.evaluate(Level::kFormulated, pointOf(dual_), {f_.data(), n});
    for (Index c = 0; c < count; ++c) {
      VecView<double> to(column(first + c), n);
      for (Index i = 0; i < n; ++i) to[i] = f_[i].d[static_cast<std::size_t>(c)];
      finite = finite && to.allFinite();
      variable(first + c).d[static_cast<std::size_t>(c)] = 0;
    }
  }
  return finite;
}

void OdeProblem::switching(double t, const double* y, const double*, double* g) {
  system_.switching(point(t, y), {g, sizes_.switches});
}

}  // namespace irk
