// A slider-crank in space: the crank turns in a plane across the slider's path, a rod with a spherical joint at both
// ends connects them. Dimensions, masses and start of E. J. Haug, Computer-Aided Kinematics and Dynamics of Mechanical
// Systems, Allyn and Bacon 1989, chapter 12.
//
// The crank turns about an axis along x through (0, b, c); its end is C(theta) = (0, b + r sin theta, c + r cos theta).
// The slider moves along the x-axis and is at (s, 0, 0). The rod is slender and uniform: with its ends A and B it has
// the kinetic energy m2 (|A'|^2 + A'.B' + |B'|^2) / 6, and half of its weight acts at each end. Its rotation about
// its own axis, which the two spherical joints leave free, is left out; its inertia about this axis (4e-4 kg m^2 in
// Haug's book) is set to 0.
#include "irk/misuse.h"
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Data {
  Real r, L, b, c;    // m
  Real J1, m2, m3;    // kg m^2 (crank, balanced), kg (rod), kg (slider)
  Real g, T;          // m/s^2 along -z, N m on the crank
  Real start, speed;  // rad, rad/s

  template <class U>
  U crankY(const U& theta) const {
    using std::sin;
    return b + r * sin(theta);
  }
  template <class U>
  U crankZ(const U& theta) const {
    using std::cos;
    return c + r * cos(theta);
  }
  Real potential(const Real& z, const Real& theta) const { return m2 * g * z / 2 - T * theta; }
};

/// u = (theta, A, s): the ends of the rod in natural coordinates. Four constraints: A is at the crank's end, the rod
/// keeps its length. The multipliers are the forces of the joint at A and, along the rod, of its length.
template <class Real>
struct Natural {
  Data<Real> d;

  Sizes sizes() const { return {.nu = 5, .nz = 4, .constraints = 4}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const auto &u = p.u, &a = p.a, &z = p.z;
    const T along = z[3] / d.L, dx = u[1] - u[4];
    const Real end = d.m2 / 3, other = d.m2 / 6;
    r.u[0] = d.T - d.J1 * a[0] + d.r * (cos(u[0]) * z[1] - sin(u[0]) * z[2]);
    r.u[1] = -end * a[1] - other * a[4] - z[0] - along * dx;
    r.u[2] = -end * a[2] - z[1] - along * u[2];
    r.u[3] = -end * a[3] - d.m2 * d.g / 2 - z[2] - along * u[3];
    r.u[4] = -(end + d.m3) * a[4] - other * a[1] + along * dx;
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    const auto dx = u[1] - u[4];
    g[0] = u[1];
    g[1] = u[2] - d.crankY(u[0]);
    g[2] = u[3] - d.crankZ(u[0]);
    g[3] = (dx * dx + u[2] * u[2] + u[3] * u[3] - d.L * d.L) / (2 * d.L);
  }
  Real energy(const State<Real>& s) const {
    const auto& v = s.v;
    const Real rod = v[1] * v[1] + v[2] * v[2] + v[3] * v[3] + v[1] * v[4] + v[4] * v[4];
    return d.J1 * v[0] * v[0] / 2 + d.m2 * rod / 6 + d.m3 * v[4] * v[4] / 2 + d.potential(s.u[3], s.u[0]);
  }
};

/// u = (theta, s) with the length of the rod as the only constraint. A' is across the slider's path: A'.B' = 0.
template <class Real>
struct Reduced {
  Data<Real> d;

  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  Real inertia() const { return d.J1 + d.m2 * d.r * d.r / 3; }
  Real mass() const { return d.m3 + d.m2 / 3; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T sine = sin(p.u[0]), cosine = cos(p.u[0]), along = p.z[0] / d.L;
    r.u[0] = d.T + d.m2 * d.g * d.r / 2 * sine - inertia() * p.a[0] - along * d.r * (d.b * cosine - d.c * sine);
    r.u[1] = -mass() * p.a[1] - along * p.u[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    const auto y = d.crankY(u[0]), z = d.crankZ(u[0]);
    g[0] = (u[1] * u[1] + y * y + z * z - d.L * d.L) / (2 * d.L);
  }
  Real energy(const State<Real>& s) const {
    return inertia() * s.v[0] * s.v[0] / 2 + mass() * s.v[1] * s.v[1] / 2 + d.potential(d.crankZ(s.u[0]), s.u[0]);
  }
};

/// u = (theta) without constraints: s > 0 follows from the length of the rod.
template <class Real>
struct Minimal {
  Reduced<Real> full;

  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  T slider(const T& theta) const {
    using std::sqrt;
    const T y = full.d.crankY(theta), z = full.d.crankZ(theta);
    return sqrt(full.d.L * full.d.L - y * y - z * z);
  }
  /// ds / dtheta
  template <class T>
  T slope(const T& theta) const {
    using std::cos;
    using std::sin;
    return -full.d.r * (full.d.b * cos(theta) - full.d.c * sin(theta)) / slider<T>(theta);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const auto& d = full.d;
    const T s = slider<T>(p.u[0]), h = slope<T>(p.u[0]), sine = sin(p.u[0]), cosine = cos(p.u[0]);
    // s h = -r (b cos theta - c sin theta), differentiated once more
    const T bend = (d.r * (d.b * sine + d.c * cosine) - h * h) / s;
    const T acceleration = h * p.a[0] + bend * p.v[0] * p.v[0];
    r.u[0] = d.T + d.m2 * d.g * d.r / 2 * sine - full.inertia() * p.a[0] - full.mass() * h * acceleration;
  }
  Real energy(const State<Real>& s) const {
    const Real rate = slope<Real>(s.u[0]) * s.v[0];
    return full.inertia() * s.v[0] * s.v[0] / 2 + full.mass() * rate * rate / 2 +
           full.d.potential(full.d.crankZ(s.u[0]), s.u[0]);
  }
};

// Typical magnitudes: the crank reaches 20 rad/s, the slider 1 m/s, forces 10 N.
const Component kCrank{"theta", "rad", 1, 10}, kSlider{"s", "m", 0.1, 1};
constexpr double kForce = 10;

template <class Real>
void makeNatural(const Data<Real>& d, Scene<Real>& scene) {
  setProblem(scene, Natural<Real>{d});
  setComponents(
      scene, {kCrank, {"Ax", "m", 0.1, 1}, {"Ay", "m", 0.1, 1}, {"Az", "m", 0.1, 1}, kSlider}, {},
      {{"lambda_x", "N", kForce}, {"lambda_y", "N", kForce}, {"lambda_z", "N", kForce}, {"lambda", "N", kForce}});
}

template <class Real>
void makeReduced(const Data<Real>& d, Scene<Real>& scene) {
  setProblem(scene, Reduced<Real>{d});
  setComponents(scene, {kCrank, kSlider}, {}, {{"lambda", "N", kForce}});
}

template <class Real>
void makeMinimal(const Data<Real>& d, Scene<Real>& scene) {
  const Minimal<Real> problem{{d}};
  setProblem(scene, problem);
  setComponents(scene, {kCrank});
  scene.outputs = {
      {"s", [problem](const State<Real>& s) { return problem.template slider<Real>(s.u[0]); }, "m"},
      {"s'", [problem](const State<Real>& s) { return Real(problem.template slope<Real>(s.u[0]) * s.v[0]); }, "m/s"}};
}

/// The start: the crank turns at the given angle and speed, all else follows.
template <class Real>
void setStart(const Data<Real>& d, Scene<Real>& scene) {
  using std::cos;
  using std::sin;
  const Minimal<Real> minimal{{d}};
  const Real s = minimal.template slider<Real>(d.start);
  const Real rate = minimal.template slope<Real>(d.start) * d.speed;
  State<Real>& start = scene.start;
  if (start.u.size() == 1) {
    start.u << d.start;
    start.v << d.speed;
  } else if (start.u.size() == 2) {
    start.u << d.start, s;
    start.v << d.speed, rate;
  } else {
    start.u << d.start, Real(0), d.crankY(d.start), d.crankZ(d.start), s;
    start.v << d.speed, Real(0), d.r * cos(d.start) * d.speed, -d.r * sin(d.start) * d.speed, rate;
  }
  completeStart(scene);
}

template <class Real, class P>
void addEnergy(const P& problem, Scene<Real>& scene) {
  scene.outputs.push_back({"energy", [problem](const State<Real>& s) { return problem.energy(s); }, "J", true});
}

std::vector<Parameter> parameters() {
  return {descriptionParameter("coordinates", "description of the same mechanism: four, one or no constraints",
                               {"natural", "reduced", "minimal"}),
          positiveParameter("r", "m", "length of the crank", "0.08"),
          positiveParameter("L", "m", "length of the rod", "0.3"),
          numberParameter("b", "m", "y of the crank's axis", "0.1", -1e6, 1e6),
          numberParameter("c", "m", "z of the crank's axis", "0.12", -1e6, 1e6),
          positiveParameter("J1", "kg m^2", "moment of inertia of the crank about its axis", "1e-4"),
          positiveParameter("m2", "kg", "mass of the rod", "0.5"),
          positiveParameter("m3", "kg", "mass of the slider", "2"),
          numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
          numberParameter("T", "N m", "torque on the crank", "0", -1e6, 1e6),
          numberParameter("theta0", "rad", "angle of the crank at the start, 0 is upwards", "0", -1e3, 1e3),
          numberParameter("omega0", "rad/s", "speed of the crank at the start", "6.283185307179586", -1e6, 1e6)};
}

template <class Real>
struct SpatialSliderCrank {
  static Scene<Real> make(const Settings& values) {
    using std::sqrt;
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Data<Real> d{.r = value("r"),
                       .L = value("L"),
                       .b = value("b"),
                       .c = value("c"),
                       .J1 = value("J1"),
                       .m2 = value("m2"),
                       .m3 = value("m3"),
                       .g = value("g"),
                       .T = value("T"),
                       .start = value("theta0"),
                       .speed = value("omega0")};
    if (!(d.L > d.r + sqrt(d.b * d.b + d.c * d.c))) {
      throw Misuse("spatial_slider_crank: the crank cannot turn, L must be greater than r + sqrt(b^2 + c^2)");
    }
    Scene<Real> scene;
    const std::string& coordinates = values.at("coordinates");
    if (coordinates == "minimal") {
      makeMinimal(d, scene);
      addEnergy(Minimal<Real>{{d}}, scene);
    } else if (coordinates == "reduced") {
      makeReduced(d, scene);
      addEnergy(Reduced<Real>{d}, scene);
    } else {
      makeNatural(d, scene);
      addEnergy(Natural<Real>{d}, scene);
    }
    setStart(d, scene);
    scene.t_end = 2;
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "spatial_slider_crank",
            .title = "slider-crank in space, a rod between two spherical joints",
            .shows = "a closed chain in three dimensions; four, one or no constraints for the same motion",
            .collections = {"multibody"},
            .literature = "E. J. Haug, Computer-Aided Kinematics and Dynamics, 1989",
            .kind = SceneKind::kConstrained,
            .parameters = parameters(),
            .panels = {{"crank", {"theta"}},
                       {"slider", {"s"}},
                       {"velocity of the slider", {"s'"}},
                       {"force of the joint", {"lambda_x", "lambda_y", "lambda_z"}},
                       {"force along the rod", {"lambda"}},
                       {"path of the rod's end", {"Ay:Az"}}},
            .reference_cases = {{.times = "0.5 1", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(SpatialSliderCrank)
