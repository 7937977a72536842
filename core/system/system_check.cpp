#include "irk/system_check.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/number_text.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

void requireCount(const std::string& what, Index given, Index wanted) {
  if (given == wanted) return;
  throw Misuse(what + ": " + std::to_string(given) + " numbers, " + std::to_string(wanted) + " are expected");
}

// 0 to 2: the index minus 1 of equations of index 1 to 3.
void requirePowers(const char* of, const std::vector<int>& powers, Index wanted) {
  const auto count = static_cast<Index>(powers.size());
  if (count != wanted) requireCount(std::string("powers of the ") + of, count, wanted);
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (powers[i] >= 0 && powers[i] <= 2) continue;
    throw Misuse(std::string("powers of the ") + of + ": number " + std::to_string(i) +
                 " (from 0 on) = " + std::to_string(powers[i]) + ": 0, 1 or 2 is expected");
  }
}

template <class Real>
bool isFinite(const Real& x) {
  using std::isfinite;  // for double; other scalars are found by their namespace
  return isfinite(x);
}

template <class Real>
std::string text(const Real& x) {
  return numberText(static_cast<double>(x));
}

// Where the residual does not depend on v, the v of stages are NaN. Comparisons with NaN are false and leave a residual
// finite, so that it is also evaluated with v of both signs.
template <class Real>
void requireNoVelocity(const System<Real>& system, const State<Real>& start) {
  State<Real> state = system.fromScene(start);
  requireState("System::fromScene", state, system.sizes());
  const Index n = system.sizes().n();
  Vec<Real> given(n), other(n);
  system.evaluate(Level::kFormulated, pointOf(state), VecView<Real>(given.data(), n));
  for (const double v : {std::numeric_limits<double>::quiet_NaN(), 1.0, -1.0}) {
    state.v.setConstant(Real(v));
    system.evaluate(Level::kFormulated, pointOf(state), VecView<Real>(other.data(), n));
    for (Index i = 0; i < n; ++i) {
      if (other[i] == given[i] || !isFinite(given[i])) continue;
      throw Misuse("usesVelocity() is false, but row " + std::to_string(i) + " of the residual (from 0 on) reads v");
    }
  }
}

}  // namespace

void requireSizes(const Sizes& n, const Declared& declared) {
  constexpr Index kMost = 10'000'000;  // vectors of far more do not fit into memory
  const auto requireSize = [](const char* name, Index size) {
    if (size >= 0 && size <= kMost) return;
    throw Misuse("sizes: " + std::string(name) + " = " + std::to_string(size) + ": 0 to " + std::to_string(kMost) +
                 " is expected");
  };
  requireSize("nu", n.nu);
  requireSize("nx", n.nx);
  requireSize("nz", n.nz);
  requireSize("constraints", n.constraints);
  requireSize("discrete", n.discrete);
  requireSize("switches", n.switches);
  if (n.n() == 0) throw Misuse("sizes: nu = nx = nz = 0: a system has at least one unknown");
  if (n.constraints > n.nz) {
    throw Misuse("sizes: constraints = " + std::to_string(n.constraints) + ": up to nz = " + std::to_string(n.nz) +
                 ", each has its multiplier in z");
  }
  if (n.constraints > 0 && !declared.constraints) {
    throw Misuse("sizes: constraints = " + std::to_string(n.constraints) +
                 ", but the problem has no function constraints(t, u, g)");
  }
  if (n.switches > 0 && !declared.switching) {
    throw Misuse("sizes: switches = " + std::to_string(n.switches) +
                 ", but the problem has no function switching(p, g)");
  }
}

void requireScale(const Vec<double>& scale, const Sizes& n) {
  if (scale.size() == 0) return;
  requireCount("scale", scale.size(), n.components());
  for (Index i = 0; i < scale.size(); ++i) {
    if (scale[i] > 0 && std::isfinite(scale[i])) continue;
    throw Misuse("scale[" + std::to_string(i) + "] = " + text(scale[i]) + ": a finite number > 0 is expected");
  }
}

template <class Real>
void requireSystem(const System<Real>* system, const Vec<double>& scale) {
  if (!system) throw Misuse("no system to integrate");
  const Sizes n = system->sizes();
  requireSizes(n);
  requireSizes(system->sceneSizes());
  requirePowers("rows", system->rowPowers(), n.n());
  const ErrorPowers& powers = system->errorPowers();
  requirePowers("errors of u", powers.u, n.nu);
  requirePowers("errors of v", powers.v, n.nu);
  requirePowers("errors of x", powers.x, n.nx);
  requirePowers("errors of z", powers.z, n.nz);
  requireScale(scale, n);
}

template <class Real>
void requireTimes(const std::vector<Real>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (isFinite(times[i]) && (i == 0 || times[i] > times[i - 1])) continue;
    throw Misuse("times of the system: number " + std::to_string(i) + " (from 0 on) = " + text(times[i]) +
                 ": finite numbers are expected, each later than the one before");
  }
}

template <class Real>
void requireState(const char* what, const State<Real>& state, const Sizes& n) {
  const auto require = [what](const char* part, Index given, Index wanted) {
    if (given != wanted) requireCount(std::string(what) + ": " + part, given, wanted);
  };
  require("u", state.u.size(), n.nu);
  require("v", state.v.size(), n.nu);
  require("x", state.x.size(), n.nx);
  require("w = (a, k, z)", state.w.size(), n.n());
  require("discrete state d", state.d.size(), n.discrete);
  require("carry", state.carry.size(), 2 * n.nu + n.nx);
}

template <class Real>
void requireStart(const System<Real>& system, const State<Real>& start, const Real& t_end) {
  requireState("start", start, system.sceneSizes());
  if (!isFinite(start.t)) throw Misuse("start: t = " + text(start.t) + ": a finite number is expected");
  if (!isFinite(t_end)) throw Misuse("t_end = " + text(t_end) + ": a finite number is expected");
  if (start.t > t_end) {
    throw Misuse("t_end = " + text(t_end) + " lies before the start, t = " + text(start.t));
  }
  requireTimes(system.times());
  if (!system.usesVelocity()) requireNoVelocity(system, start);
}

template <class Real>
std::string notFinite(const State<Real>& start) {
  const auto find = [](const char* name, const Vec<Real>& numbers) -> std::string {
    for (Index i = 0; i < numbers.size(); ++i) {
      if (!isFinite(numbers[i])) return name + ("[" + std::to_string(i) + "] = ") + text(numbers[i]);
    }
    return {};
  };
  for (const auto& found :
       {find("u", start.u), find("v", start.v), find("x", start.x), find("w", start.w), find("d", start.d)}) {
    if (!found.empty()) return found;
  }
  return {};
}

#define IRK_CHECKS(Real)                                                            \
  template void requireTimes(const std::vector<Real>&);                             \
  template void requireState(const char*, const State<Real>&, const Sizes&);        \
  template void requireSystem(const System<Real>*, const Vec<double>&);             \
  template void requireStart(const System<Real>&, const State<Real>&, const Real&); \
  template std::string notFinite(const State<Real>&);
IRK_CHECKS(double)
IRK_CHECKS(BigFloat)
#undef IRK_CHECKS

}  // namespace irk
