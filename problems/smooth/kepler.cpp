// The planar two-body problem q'' = -q / |q|^3 with eccentricity e, started at the pericentre.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Kepler {
  Real e;

  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T r2 = p.u[0] * p.u[0] + p.u[1] * p.u[1];
    const T inverse_cube = T(1.0) / (r2 * sqrt(r2));
    r.u[0] = -p.u[0] * inverse_cube - p.a[0];
    r.u[1] = -p.u[1] * inverse_cube - p.a[1];
  }

  bool usesVelocity() const { return false; }

  // Solves Kepler's equation M = E - e sin E with M = t by Newton's method from E = M + e sign(sin M). For M in
  // (0, pi) the function is convex between the root and pi, where the iteration is monotone.
  Real eccentricAnomaly(const Real& t) const {
    using std::abs;
    using std::cos;
    using std::floor;
    using std::sin;
    const Real turn = 2 * piOf<Real>();
    const Real revolutions = floor(t / turn) * turn;
    const Real M = t - revolutions;
    Real E = M + (sin(M) < 0 ? -e : e);
    for (int i = 0; i < 50; ++i) {
      const Real step = (E - e * sin(E) - M) / (1 - e * cos(E));
      E -= step;
      if (abs(step) <= 4 * Eigen::NumTraits<Real>::epsilon() * (1 + abs(E))) break;
    }
    return E + revolutions;
  }

  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Real E = eccentricAnomaly(t);
    const Real minor = sqrt(1 - e * e);
    const Real radius = 1 - e * cos(E);
    State<Real> s(sizes());
    s.t = t;
    s.u << cos(E) - e, minor * sin(E);
    s.v << -sin(E) / radius, minor * cos(E) / radius;
    s.w = -s.u / (radius * radius * radius);
    return s;
  }
  static Kepler with(const Settings& values) { return {number<Real>(values, "e")}; }
  SceneFrame<Real> frame() const {
    return {.t_end = 62.83185307179586,  // ten revolutions
            .time_unit = "",
            .u = {{"q1"}, {"q2"}},
            .outputs = {
                {"energy", [](const State<Real>& s) { return Real(s.v.squaredNorm() / 2 - 1 / s.u.norm()); }, "", true},
                {"angular_momentum", [](const State<Real>& s) { return Real(s.u[0] * s.v[1] - s.u[1] * s.v[0]); }, "",
                 true}}};
  }
  static SceneEntry entry() {
    return {.id = "kepler",
            .title = "Kepler's two-body problem",
            .shows = "invariants: energy and angular momentum over many revolutions",
            .collections = {"probes"},
            .parameters = {numberParameter("e", "", "eccentricity", "0.6", 0, 0.99)},
            .panels = {{"orbit", {"q1:q2"}}, {"positions", {"q1", "q2"}}, {"velocities", {"q1'", "q2'"}}},
            .reference_cases = {{.times = "10 30", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Kepler)
