// The inextensible elastica: a clamped beam under a dead tip load, with arbitrarily large deflections. The arc length
// takes the place of time. EI theta'' = f cos theta, r' = (cos theta, sin theta), theta(0) = 0,
// theta'(L) = 0; load = f L^2 / EI. It is the limit of ancf_cantilever at rest when EA and the number of elements
// tend to infinity.
#include "problems/support/boost_math.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <limits>

#include "irk/scene_file.h"
#include "problems/support/elliptic.h"

using namespace irk;

namespace {

template <class Real>
class ExactElastica;

template <class Real>
struct Elastica {
  Real L, load;  // m, 1

  Sizes sizes() const { return {.nu = 1, .nx = 2, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = load / (L * L) * cos(p.u[0]) - p.a[0];
    r.x[0] = cos(p.u[0]) - p.k[0];
    r.x[1] = sin(p.u[0]) - p.k[1];
  }
  bool usesVelocity() const { return false; }
  static Scene<Real> make(const Settings& values) {
    const Elastica<Real> problem{number<Real>(values, "L"), number<Real>(values, "load")};
    const ExactElastica<Real> exact(problem);
    Scene<Real> scene;
    setProblem(scene, problem);
    const Real L = problem.L;
    const double length = static_cast<double>(L);
    scene.t_end = length;
    scene.time_unit = "m";  // t is the arc length
    setComponents(scene, {{"theta", "rad", 1, 1 / length}}, {{"x", "m", length}, {"y", "m", length}});
    scene.exact = [exact](const Real& s) { return exact.at(s); };
    scene.start = scene.exact(Real(0));
    scene.start.u[0] = scene.start.x[0] = scene.start.x[1] = Real(0);  // exact(0) is 0 up to rounding only
    scene.outputs = {{"u_x", [](const State<Real>& s) { return Real(s.x[0] - s.t); }, "m"},
                     {"u_y", [](const State<Real>& s) { return s.x[1]; }, "m"}};
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "elastica",
            .title = "inextensible cantilever under a dead tip load, along its arc length",
            .shows = "large bending against elliptic integrals: the limit of ancf_cantilever at rest",
            .collections = {"probes"},
            .parameters = {positiveParameter("L", "m", "length", "2"),
                           numberParameter("load", "", "f L^2 / EI, down", "3", 1e-2, 100)},
            .panels = {{"angle", {"theta"}}, {"shape", {"x:y"}}},
            .reference_cases = {{.times = "0.5 1", .tolerance = kManyDigits}}};
  }
};

// With theta = -beta and 1 + sin beta = 2 k^2 sin^2 phi the first integral
// beta'^2 = 2 a^2 (sin beta(L) - sin beta), a^2 = f / EI, becomes a ds = dphi / Delta(phi, k):
// phi is the amplitude of a s + F(phi(0), k), and phi(L) = pi / 2. Bisshopp & Drucker 1945.
template <class Real>
class ExactElastica {
 public:
  explicit ExactElastica(const Elastica<Real>& problem)
      : problem_(problem), a_(rootOf(problem.load) / problem.L), k_(modulus(problem.load)) {
    start_ = amplitude(k_);
    F_ = boost::math::ellint_1(k_, start_);
    E_ = boost::math::ellint_2(k_, start_);
  }

  State<Real> at(const Real& s) const {
    using std::atan2;
    using std::cos;
    const auto [sn, cn, dn, am] = jacobiFunctions<Real>(a_ * s + F_, k_ * k_);
    const Real sine = 2 * k_ * k_ * sn * sn - 1, cosine = 2 * k_ * sn * dn;
    State<Real> state(problem_.sizes());
    state.t = s;
    state.u[0] = -atan2(sine, cosine);
    state.v[0] = -2 * a_ * k_ * cn;
    // y = -s + (2 / a) (E(phi, k) - E(phi(0), k)).
    const Real E = boost::math::ellint_2(k_, Real(atan2(sn, cn)));
    state.x << 2 * k_ / a_ * (cos(start_) - cn), 2 / a_ * (E - E_) - s;
    state.w << a_ * a_ * cosine, cosine, -sine;
    return state;
  }

 private:
  static Real rootOf(const Real& x) {
    using std::sqrt;
    return sqrt(x);
  }

  // phi at theta = 0.
  static Real amplitude(const Real& k) {
    using std::asin;
    return asin(rootOf(Real(0.5)) / k);
  }

  // Solves sqrt(load) = K(k) - F(phi(0), k). The right-hand side grows from 0 at k^2 = 1/2 to infinity at 1.
  static Real modulus(const Real& load) {
    const Real wanted = rootOf(load);
    const auto excess = [&](const Real& k) {
      return Real(boost::math::ellint_1(k) - boost::math::ellint_1(k, amplitude(k)) - wanted);
    };
    const Real eps = std::numeric_limits<Real>::epsilon();
    Real low = rootOf(Real(0.5)) * (1 + 4 * eps), high = 1 - eps;
    std::uintmax_t iterations = 200;
    const boost::math::tools::eps_tolerance<Real> tight;
    const auto root = boost::math::tools::toms748_solve(excess, low, high, tight, iterations);
    return (root.first + root.second) / 2;
  }

  Elastica<Real> problem_;
  Real a_, k_, start_, F_, E_;
};

}  // namespace

IRK_SCENE(Elastica)
