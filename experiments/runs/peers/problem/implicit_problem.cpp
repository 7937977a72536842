#include "experiments/runs/peers/problem/implicit_problem.h"

#include <algorithm>

namespace irk {

ImplicitProblem::ImplicitProblem(const System<double>& system, const ProblemOptions& options)
    : SceneProblem(system),
      derivatives_(options.derivatives),
      determined_(options.determined),
      scale_(options.scale),
      dense_(isDense(options.storage, sizes_.n())),
      differentiator_(counting_, options.derivatives, JacobianTerms::kFull, options.storage) {}

int ImplicitProblem::indexOf(Index i) const {
  return std::max(1 + system_.errorPowers().z[static_cast<std::size_t>(i)], determined_ ? 1 : 2);
}

void ImplicitProblem::setLayout(bool rates) {
  const Index n = sizes_.components() + (rates ? sizes_.nu + sizes_.nx : 0);
  layout_ = {.n = n,
             .second_order = sizes_.nu,
             .switches = sizes_.switches,
             .unknowns = std::vector(static_cast<std::size_t>(n), PeerUnknown::kDifferential),
             .index = {}};
  const auto& powers = system_.errorPowers();
  for (const auto* part : {&powers.u, &powers.v, &powers.x}) {
    for (const int power : *part) layout_.index.push_back(1 + power);
  }
  int highest = 1;
  for (Index i = 0; i < sizes_.nz; ++i) highest = std::max(highest, indexOf(i));
  if (rates) {  // accelerations contain the multipliers
    layout_.index.resize(static_cast<std::size_t>(n - sizes_.nz), highest);
    std::fill(layout_.unknowns.begin() + sizes_.components() - sizes_.nz, layout_.unknowns.end(),
              PeerUnknown::kAlgebraic);
  }
  for (Index i = 0; i < sizes_.nz; ++i) {
    layout_.index.push_back(indexOf(i));
    layout_.unknowns[static_cast<std::size_t>(n - sizes_.nz + i)] =
        i < sizes_.constraints ? PeerUnknown::kMultiplier : PeerUnknown::kAlgebraic;
  }
}

StartReport ImplicitProblem::makeConsistent(State<double>& state, bool new_run) {
  const auto check = new_run ? StartCheck::kConstraints : StartCheck::kNone;
  const StartReport report =
      ConsistentStart<double>(counting_, derivatives_, true, nullptr, scale_).apply(state, check);
  d_ = state.d;
  if (new_run) differentiator_.forgetPattern();
  return report;
}

Point<double> ImplicitProblem::point(double t, const double* y, const double* a, const double* k,
                                     const double* z) const {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  return {t, {y, nu}, {y + nu, nu}, {y + 2 * nu, nx}, {a, nu}, {k, nx}, {z, sizes_.nz}, {d_.data(), d_.size()}};
}

// --- F(t, y, y') = 0

namespace {

// Columns u, v, x, z of the rows u' - v and r: dr/du = D2, dr/d(v, x) = D1 + c D0, dr/dz = D0.
std::vector<AssembledColumn> daeColumns(const Sizes& n) {
  std::vector<AssembledColumn> all;
  for (Index j = 0; j < n.nu; ++j) all.push_back({.core = j, .d2 = 1, .top_row = j, .top = kTimesC});
  for (Index j = 0; j < n.nu; ++j) all.push_back({.core = j, .d0 = kTimesC, .d1 = 1, .top_row = j, .top = -1});
  for (Index j = n.nu; j < n.nu + n.nx; ++j) all.push_back({.core = j, .d0 = kTimesC, .d1 = 1});
  for (Index j = n.nu + n.nx; j < n.n(); ++j) all.push_back({.core = j, .d0 = 1});
  return all;
}

}  // namespace

DaeProblem::DaeProblem(const System<double>& system, const ProblemOptions& options)
    : ImplicitProblem(system, options),
      at_once_(dense_ && options.derivatives == DerivativeSource::kAutomatic),
      dual_(sizes_),
      dual_residual_(sizes_.n()) {
  setLayout(false);
  assembly_ = Assembly(sizes_.nu, daeColumns(sizes_));
  pattern_ = fullPattern(layout_.n);
}

StartReport DaeProblem::begin(State<double>& state, bool new_run, PeerValues& to) {
  StartReport report = makeConsistent(state, new_run);
  if (report.outcome != Outcome::kSuccess) return report;
  to.y.resize(layout_.n);
  to.yp.resize(layout_.n);
  to.y << state.u, state.v, state.x, state.z();
  to.yp << state.v, state.a(), state.k(), Vec<double>::Zero(sizes_.nz);
  if (dense_) return report;
  pattern_ = assembly_.pattern(differentiator_.pattern(Level::kFormulated, at(state.t, to.y.data(), to.yp.data())));
  return report;
}

void DaeProblem::read(const PeerStep& step, State<double>& state) const {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  state.t = step.t;
  copyTo(state.u, step.y);
  copyTo(state.v, step.y + nu);
  copyTo(state.x, step.y + 2 * nu);
  copyTo(state.w.head(nu + nx), step.yp + nu);
  copyTo(state.w.tail(sizes_.nz), step.y + 2 * nu + nx);
}

Point<double> DaeProblem::at(double t, const double* y, const double* yp) const {
  return point(t, y, yp + sizes_.nu, yp + 2 * sizes_.nu, y + 2 * sizes_.nu + sizes_.nx);
}

Evaluated DaeProblem::residual(double t, const double* y, const double* yp, double* r) {
  if (over()) return Evaluated::kStop;
  const Index nu = sizes_.nu, n = sizes_.n();
  for (Index i = 0; i < nu; ++i) r[i] = yp[i] - y[nu + i];
  system_.evaluate(Level::kFormulated, at(t, y, yp), {r + nu, n});
  return evaluated(areFinite(r + nu, n));
}

bool DaeProblem::evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double*) {
  if (at_once_) {
    if (J.pattern != pattern_) J.pattern = pattern_;
    J.values.resize(layout_.n * layout_.n);
    return differentiate(t, y, yp, c, J.values.data());
  }
  differentiator_.evaluate(Level::kFormulated, at(t, y, yp), D_);
  const bool finite = assembly_.assemble(D_, c, J);
  pattern_ = J.pattern;
  return finite;
}

// One direction per column of dF/dy + c dF/dy': along v_j and x_j those of a_j and k_j move by c.
bool DaeProblem::differentiate(double t, const double* y, const double* yp, double c, double* J) {
  const Index nu = sizes_.nu, nx = sizes_.nx, rows = sizes_.n(), n = layout_.n, chunk = static_cast<Index>(kChunk);
  const Index differential = 2 * nu + nx;
  const auto lift = [](const double* from, auto&& to) {
    for (Index i = 0; i < to.size(); ++i) to[i].value = from[i];
  };
  dual_.t.value = t;
  lift(y, dual_.u);
  lift(y + nu, dual_.v);
  lift(y + 2 * nu, dual_.x);
  lift(yp + nu, dual_.w.head(nu + nx));
  lift(y + differential, dual_.w.tail(sizes_.nz));
  lift(d_.data(), dual_.d);
  const auto move = [&](Index j, std::size_t direction, double by) {
    if (j < nu) dual_.u[j].d[direction] = by;
    if (j >= nu && j < 2 * nu) dual_.v[j - nu].d[direction] = by;
    if (j >= 2 * nu && j < differential) dual_.x[j - 2 * nu].d[direction] = by;
    if (j >= nu) dual_.w[j - nu].d[direction] = j < differential ? c * by : by;
  };
  bool finite = true;
  for (Index first = 0; first < n; first += chunk) {
    const Index count = std::min(chunk, n - first);
    for (Index k = 0; k < count; ++k) move(first + k, static_cast<std::size_t>(k), 1);
    counting_.evaluate(Level::kFormulated, pointOf(dual_), {dual_residual_.data(), rows});
    for (Index k = 0; k < count; ++k) {
      const Index j = first + k;
      double* const column = J + j * n;
      for (Index i = 0; i < nu; ++i) column[i] = j == i ? c : j == nu + i ? -1 : 0;
      for (Index i = 0; i < rows; ++i) column[nu + i] = dual_residual_[i].d[static_cast<std::size_t>(k)];
      finite = areFinite(column + nu, rows) && finite;
      move(j, static_cast<std::size_t>(k), 0);
    }
  }
  return finite;
}

void DaeProblem::switching(double t, const double* y, const double* yp, double* g) {
  system_.switching(at(t, y, yp), {g, sizes_.switches});
}

}  // namespace irk
