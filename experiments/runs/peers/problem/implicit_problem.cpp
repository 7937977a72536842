#include "experiments/runs/peers/problem/implicit_problem.h"

#include <algorithm>

namespace irk {

ImplicitProblem::ImplicitProblem(const System<double>& system, const ProblemOptions& options)
    : SceneProblem(system),
      derivatives_(options.derivatives),
      determined_(options.determined),
      scale_(options.scale),
      dense_(isDense(options.storage, sizes_.n())),
      differentiator_(system_, options.derivatives, JacobianTerms::kFull, options.storage) {}

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
  const StartReport report = ConsistentStart<double>(system_, derivatives_, true, nullptr, scale_).apply(state, check);
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

DaeProblem::DaeProblem(const System<double>& system, const ProblemOptions& options) : ImplicitProblem(system, options) {
  setLayout(false);
  assembly_ = Assembly(sizes_.nu, daeColumns(sizes_));
  pattern_ = fullPattern(layout_.n);
}

Vec<double> DaeProblem::perComponent(const Vec<double>& values, double) const { return values; }

StartReport DaeProblem::begin(State<double>& state, bool new_run, PeerValues& to) {
  StartReport report = makeConsistent(state, new_run);
  if (report.outcome != Outcome::kSuccess) return report;
  to.y.resize(layout_.n);
  to.yp.resize(layout_.n);
  to.y << state.u, state.v, state.x, state.z();
  to.yp << state.v, state.a(), state.k(), Vec<double>::Zero(sizes_.nz);
  if (dense_) return report;
  differentiator_.evaluate(Level::kFormulated, at(state.t, to.y.data(), to.yp.data()), D_);
  pattern_ = assembly_.pattern(D_.pattern);
  return report;
}

void DaeProblem::read(const PeerStep& step, State<double>& state) const {
  const auto p = at(step.t, step.y, step.yp);
  state.t = step.t;
  state.u = p.u;
  state.v = p.v;
  state.x = p.x;
  state.w << p.a, p.k, p.z;
}

Point<double> DaeProblem::at(double t, const double* y, const double* yp) const {
  return point(t, y, yp + sizes_.nu, yp + 2 * sizes_.nu, y + 2 * sizes_.nu + sizes_.nx);
}

bool DaeProblem::evaluateRates(double, const double*, double*) { return false; }

bool DaeProblem::evaluateResidual(double t, const double* y, const double* yp, double* r) {
  const Index nu = sizes_.nu;
  VecView<double>(r, nu) = ConstVec<double>(yp, nu) - ConstVec<double>(y + nu, nu);
  VecView<double> rest(r + nu, sizes_.n());
  system_.evaluate(Level::kFormulated, at(t, y, yp), rest);
  return rest.allFinite();
}

bool DaeProblem::evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double*) {
  differentiator_.evaluate(Level::kFormulated, at(t, y, yp), D_);
  const bool finite = assembly_.assemble(D_, c, J);
  pattern_ = J.pattern;
  return finite;
}

void DaeProblem::switching(double t, const double* y, const double* yp, double* g) {
  system_.switching(at(t, y, yp), {g, sizes_.switches});
}

}  // namespace irk
