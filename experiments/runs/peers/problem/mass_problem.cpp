#include <algorithm>
#include <cmath>

#include "experiments/runs/peers/problem/implicit_problem.h"

namespace irk {
namespace {

// Columns of f = (v, r) or (v, a, k, r) for y = (u, v, x, z) or (u, v, x, a, k, z).
std::vector<AssembledColumn> massColumns(const Sizes& n, bool extended) {
  std::vector<AssembledColumn> all;
  for (Index j = 0; j < n.nu; ++j) all.push_back({.core = j, .d2 = 1});
  for (Index j = 0; j < n.nu; ++j) all.push_back({.core = j, .d1 = 1, .top_row = j, .top = 1});
  for (Index j = n.nu; j < n.nu + n.nx; ++j) all.push_back({.core = j, .d1 = 1});
  for (Index j = 0; extended && j < n.nu + n.nx; ++j) {
    all.push_back({.core = j, .d0 = 1, .top_row = n.nu + j, .top = 1});
  }
  for (Index j = n.nu + n.nx; j < n.n(); ++j) all.push_back({.core = j, .d0 = 1});
  return all;
}

// Moves each number by up to a tenth of 1 + its magnitude.
void move(Vec<double>& values, int& i) {
  for (double& value : values) {
    i = (i * 7 + 3) % 11;
    value += 0.02 * (i - 5) * (1 + std::abs(value));
  }
}

// Whether the columns of (a, k) in D0 are the same at states near `start`. Modes may change them.
bool hasConstantMass(const System<double>& system, const State<double>& start, DerivativeSource derivatives) {
  constexpr int kSamples = 3;
  const Sizes sizes = system.sizes();
  if (sizes.switches > 0) return false;
  Differentiator<double> differentiator(system, derivatives, JacobianTerms::kFull, Storage::kDense, Matrices::kOnlyD0);
  Linearization<double> D(Pattern::dense(sizes.n()));
  differentiator.evaluate(Level::kFormulated, pointOf(start), D);
  const Mat<double> first = D.dense0().leftCols(sizes.nu + sizes.nx);
  for (int sample = 1; sample <= kSamples; ++sample) {
    State<double> at = start;
    int i = sample;
    for (auto* part : {&at.u, &at.v, &at.x, &at.w}) move(*part, i);
    at.t += 0.1 * sample;
    differentiator.evaluate(Level::kFormulated, pointOf(at), D);
    if (D.dense0().leftCols(sizes.nu + sizes.nx) != first) return false;
  }
  return first.allFinite();
}

PeerJacobian fullMatrix(const Mat<double>& M) {
  return {fullPattern(M.rows()), Eigen::Map<const Vec<double>>(M.data(), M.size())};
}

}  // namespace

MassProblem::MassProblem(const System<double>& system, const ProblemOptions& options, const State<double>& start)
    : ImplicitProblem(system, options),
      extended_(!hasConstantMass(system, start, options.derivatives)),
      no_rates_(Vec<double>::Zero(sizes_.nu + sizes_.nx)) {
  setLayout(extended_);
  assembly_ = Assembly(sizes_.nu + (extended_ ? sizes_.nu + sizes_.nx : 0), massColumns(sizes_, extended_));
  pattern_ = fullPattern(layout_.n);
}

Vec<double> MassProblem::perComponent(const Vec<double>& values, double rest) const {
  const Index differential = 2 * sizes_.nu + sizes_.nx;
  Vec<double> all = Vec<double>::Constant(layout_.n, rest);
  all.head(differential) = values.head(differential);
  all.tail(sizes_.nz) = values.tail(sizes_.nz);
  return all;
}

StartReport MassProblem::begin(State<double>& state, bool new_run, PeerValues& to) {
  StartReport report = makeConsistent(state, new_run);
  if (report.outcome != Outcome::kSuccess) return report;
  to.y.resize(layout_.n);
  to.yp.resize(layout_.n);
  if (extended_) {
    to.y << state.u, state.v, state.x, state.w;
  } else {
    to.y << state.u, state.v, state.x, state.z();
  }
  to.yp << state.v, state.a(), state.k(), Vec<double>::Zero(layout_.n - 2 * sizes_.nu - sizes_.nx);
  differentiator_.evaluate(Level::kFormulated, at(state.t, to.y.data()), D_);
  pattern_ = assembly_.pattern(D_.pattern);
  setMass();
  return report;
}

// For the constant form M is the part -D of the matrix D_ that has just been evaluated.
void MassProblem::setMass() {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  Mat<double> M = Mat<double>::Zero(layout_.n, layout_.n);
  if (extended_) {
    M.diagonal().head(2 * nu + nx).setOnes();
  } else {
    M.diagonal().head(nu).setOnes();
    const Pattern& core = *D_.pattern;
    for (Index j = 0; j < nu + nx; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Index first = core.full ? j * core.n : core.column_start[at];
      const Index end = core.full ? first + core.n : core.column_start[at + 1];
      for (Index k = first; k < end; ++k) {
        const Index row = core.full ? k - first : core.row[static_cast<std::size_t>(k)];
        M(nu + row, nu + j) = -D_.d0[k];
      }
    }
  }
  mass_ = fullMatrix(M);
}

void MassProblem::read(const PeerStep& step, State<double>& state) const {
  const auto p = at(step.t, step.y);
  state.t = step.t;
  state.u = p.u;
  state.v = p.v;
  state.x = p.x;
  if (extended_) {
    state.w << p.a, p.k, p.z;
  } else {
    state.w.tail(sizes_.nz) = p.z;
  }
}

Point<double> MassProblem::at(double t, const double* y) const {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  const double* const rest = y + 2 * nu + nx;
  return extended_ ? point(t, y, rest, rest + nu, rest + nu + nx)
                   : point(t, y, no_rates_.data(), no_rates_.data() + nu, rest);
}

Evaluated MassProblem::rates(double t, const double* y, double* f) {
  if (over()) return Evaluated::kStop;
  const Index nu = sizes_.nu, nx = sizes_.nx, n = sizes_.n();
  std::copy_n(y + nu, nu, f);
  if (extended_) std::copy_n(y + 2 * nu + nx, nu + nx, f + nu);
  double* const rest = f + layout_.n - n;
  system_.evaluate(Level::kFormulated, at(t, y), {rest, n});
  return evaluated(areFinite(rest, n));
}

bool MassProblem::evaluateJacobian(double t, const double* y, const double*, double, PeerJacobian& J, double*) {
  differentiator_.evaluate(Level::kFormulated, at(t, y), D_);
  const bool finite = assembly_.assemble(D_, 0, J);
  pattern_ = J.pattern;
  return finite;
}

void MassProblem::switching(double t, const double* y, const double*, double* g) {
  system_.switching(at(t, y), {g, sizes_.switches});
}

}  // namespace irk
