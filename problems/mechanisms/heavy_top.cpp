// A heavy top in Euler parameters: the benchmark of O. Bruels, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012)
// 121-137, after M. Geradin, A. Cardona, Flexible Multibody Dynamics, Wiley 2001.
//
// The equations of the quaternion e stand in irk/rigid.h; here lambda has the other sign, f - lambda e.
#include <algorithm>
#include <vector>

#include "irk/rigid.h"
#include "irk/scene_file.h"
#include "problems/mechanisms/heavy_top_motion.h"

using namespace irk;

namespace {

using heavy_top::Data;
using heavy_top::Motion;

using rigid::bodyRate;
using rigid::product;
using rigid::Vector;

constexpr Vector<double> kAxis{0, 1, 0};  // of symmetry, in the body
/// The same in space, of the length |e|^2.
template <class E>
auto axisOf(const E& e, Index i) {
  return rigid::turned(e, i, kAxis);
}

/// u = (x, y, z, e): position of the centre of mass and Euler parameters. The multipliers are the force on the joint
/// and that of the norm.
template <class Real>
struct Absolute {
  static constexpr Index kFirst = 3;  // of e
  Data<Real> d;

  Sizes sizes() const { return {.nu = 7, .nz = 4, .constraints = 4}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < 3; ++i) r.u[i] = -d.m * p.a[i] - p.z[i];
    r.u[2] -= d.m * d.g;
    for (Index i = kFirst; i < 7; ++i) r.u[i] = -p.u[i] * p.z[3];
    rigid::addTurnedForce(&r.u[kFirst], p.u, kFirst, kAxis, {d.l * p.z[0], d.l * p.z[1], d.l * p.z[2]});
    rigid::subtractTurningInertia(&r.u[kFirst], p, kFirst, Vector<Real>{d.J1, d.J3, d.J1});
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    const auto axis = axisOf(u, kFirst);
    g[0] = u[0] - d.l * axis.x;
    g[1] = u[1] - d.l * axis.y;
    g[2] = u[2] - d.l * axis.z;
    g[3] = rigid::norm(u, kFirst);
  }
};

/// u = e: the top about its fixed point. The multiplier is that of the norm.
template <class Real>
struct FixedPoint {
  static constexpr Index kFirst = 0;
  Data<Real> d;

  Sizes sizes() const { return {.nu = 4, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const Real across = d.transverseInertia();
    for (Index i = 0; i < 4; ++i) r.u[i] = -p.u[i] * p.z[0];
    rigid::addTurnedForce(&r.u[kFirst], p.u, kFirst, kAxis, {T(0.0), T(0.0), T(-d.m * d.g * d.l)});
    rigid::subtractTurningInertia(&r.u[kFirst], p, kFirst, Vector<Real>{across, d.J3, across});
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = rigid::norm(u, kFirst);
  }
};

/// Angular velocity in the body's axes at a state.
template <class Real, class P>
Vector<Real> omegaOf(const P&, const State<Real>& s) {
  const auto half = bodyRate<Real>(s.u, s.v, P::kFirst);
  return {2 * half.x, 2 * half.y, 2 * half.z};
}

/// The vertical in the body's axes.
template <class Real>
Vector<Real> verticalOf(const Vec<Real>& u, Index i) {
  const Real &e0 = u[i], &e1 = u[i + 1], &e2 = u[i + 2], &e3 = u[i + 3];
  return {2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), e0 * e0 - e1 * e1 - e2 * e2 + e3 * e3};
}

/// e, e', e'' of the exact motion. R = Rz(phi) Rx(pi/2 - theta) Ry(psi).
template <class Real>
void setAttitude(const Data<Real>& d, const Motion<Real>& motion, Index first, State<Real>& s) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const auto now = motion.at(s.t);
  const Real q0 = now.half_cosine * cos(now.half_sum), q3 = now.half_cosine * sin(now.half_sum);
  const Real q1 = -now.half_sine * cos(now.half_difference), q2 = -now.half_sine * sin(now.half_difference);
  s.u.segment(first, 4) << q0 - q1, q0 + q1, q2 + q3, q3 - q2;
  s.u.segment(first, 4) *= Real(sqrt(Real(0.5)));

  const Real sine = 2 * now.half_sine * now.half_cosine;
  const Real c = now.half_cosine * now.half_cosine - now.half_sine * now.half_sine;
  const Real rise = now.rate / sine, turn = motion.precession(c) / sine, psi = now.half_sum - now.half_difference;
  const Vector<Real> w{rise * cos(psi) - turn * sin(psi), d.spin, rise * sin(psi) + turn * cos(psi)};
  const Vector<Real> up = verticalOf<Real>(s.u, first);
  const Real Jt = d.transverseInertia(), weight = d.m * d.g * d.l;  // Euler's equations about the fixed point
  const Vector<Real> w_rate{(-weight * up.z - (Jt - d.J3) * w.y * w.z) / Jt, Real(0),
                            (weight * up.x + (Jt - d.J3) * w.x * w.y) / Jt};
  const auto e_rate = product<Real>(s.u, first, w);
  for (Index i = 0; i < 4; ++i) s.v[first + i] = e_rate[static_cast<std::size_t>(i)] / 2;
  const auto turned = product<Real>(s.v, first, w), accelerated = product<Real>(s.u, first, w_rate);
  for (Index i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    s.w[first + i] = (turned[k] + accelerated[k]) / 2;
  }
}

/// The multiplier of the norm follows from e^T times the rows of e.
template <class Real>
State<Real> exactOf(const FixedPoint<Real>& problem, const Motion<Real>& motion, const Real& t) {
  const Data<Real>& d = problem.d;
  State<Real> s(problem.sizes());
  s.t = t;
  setAttitude(d, motion, 0, s);
  const auto w = omegaOf(problem, s);
  s.w[4] =
      2 * (d.transverseInertia() * (w.x * w.x + w.z * w.z) + d.J3 * w.y * w.y) - 2 * d.m * d.g * d.l * axisOf(s.u, 0).z;
  return s;
}

/// The symmetric bilinear form of which axisOf is the quadratic one.
template <class Real>
Vector<Real> mixedAxis(const Vec<Real>& a, const Vec<Real>& b, Index i) {
  return {a[i + 1] * b[i + 2] + a[i + 2] * b[i + 1] - a[i] * b[i + 3] - a[i + 3] * b[i],
          a[i] * b[i] - a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2] - a[i + 3] * b[i + 3],
          a[i + 2] * b[i + 3] + a[i + 3] * b[i + 2] + a[i] * b[i + 1] + a[i + 1] * b[i]};
}

template <class Real>
State<Real> exactOf(const Absolute<Real>& problem, const Motion<Real>& motion, const Real& t) {
  const Data<Real>& d = problem.d;
  State<Real> s(problem.sizes());
  s.t = t;
  setAttitude(d, motion, 3, s);
  const auto axis = mixedAxis<Real>(s.u, s.u, 3), rate = mixedAxis<Real>(s.u, s.v, 3);
  const auto turned = mixedAxis<Real>(s.v, s.v, 3), accelerated = mixedAxis<Real>(s.u, s.w, 3);
  s.u.head(3) << d.l * axis.x, d.l * axis.y, d.l * axis.z;
  s.v.head(3) << 2 * d.l * rate.x, 2 * d.l * rate.y, 2 * d.l * rate.z;
  s.w.head(3) << 2 * d.l * (turned.x + accelerated.x), 2 * d.l * (turned.y + accelerated.y),
      2 * d.l * (turned.z + accelerated.z);
  for (Index i = 0; i < 3; ++i) s.w[7 + i] = -d.m * s.w[i];
  s.w[9] -= d.m * d.g;
  const auto w = omegaOf(problem, s);
  s.w[10] = 2 * (d.J1 * (w.x * w.x + w.z * w.z) + d.J3 * w.y * w.y);
  for (Index i = 0; i < 3; ++i) s.w[10] += 2 * s.u[i] * s.w[7 + i];
  return s;
}

template <class Real>
Real rotationEnergy(const Vector<Real>& w, const Real& J1, const Real& J3) {
  return (J1 * (w.x * w.x + w.z * w.z) + J3 * w.y * w.y) / 2;
}

/// Angular momentum about the vertical through the centre of rotation.
template <class Real>
Real verticalMomentum(const Vector<Real>& up, const Vector<Real>& w, const Real& J1, const Real& J3) {
  return J1 * (up.x * w.x + up.z * w.z) + J3 * up.y * w.y;
}

template <class Real>
Real energyOf(const Absolute<Real>& problem, const State<Real>& s) {
  const Data<Real>& d = problem.d;
  return d.m * (s.v.head(3).squaredNorm() / 2 + d.g * s.u[2]) + rotationEnergy(omegaOf(problem, s), d.J1, d.J3);
}
template <class Real>
Real energyOf(const FixedPoint<Real>& problem, const State<Real>& s) {
  const Data<Real>& d = problem.d;
  return d.m * d.g * d.l * axisOf(s.u, 0).z + rotationEnergy(omegaOf(problem, s), d.transverseInertia(), d.J3);
}
template <class Real>
Real momentumOf(const Absolute<Real>& problem, const State<Real>& s) {
  const Data<Real>& d = problem.d;
  return d.m * (s.u[0] * s.v[1] - s.u[1] * s.v[0]) +
         verticalMomentum(verticalOf<Real>(s.u, 3), omegaOf(problem, s), d.J1, d.J3);
}
template <class Real>
Real momentumOf(const FixedPoint<Real>& problem, const State<Real>& s) {
  return verticalMomentum(verticalOf<Real>(s.u, 0), omegaOf(problem, s), problem.d.transverseInertia(), problem.d.J3);
}

template <class Real>
std::vector<Component> eulerParameters(const Data<Real>& d) {
  const double rate = std::max(std::abs(static_cast<double>(d.spin)), 1.0);
  return {{"e0", "", 1, rate}, {"e1", "", 1, rate}, {"e2", "", 1, rate}, {"e3", "", 1, rate}};
}
/// Magnitude of the multiplier of the norm, in J: twice the energy of rotation is about J3 spin^2.
template <class Real>
double normScale(const Data<Real>& d) {
  return static_cast<double>(Real(d.J3 * d.spin * d.spin + 2 * d.m * d.g * d.l));
}

template <class Real>
Absolute<Real> setUp(Absolute<Real> problem, Scene<Real>& scene) {
  const Data<Real>& d = problem.d;
  setProblem(scene, problem);
  const double l = static_cast<double>(d.l), force = static_cast<double>(Real(d.m * d.g));
  const double speed = l * std::max(std::abs(static_cast<double>(d.precession)), 1.0);
  std::vector<Component> u = {{"x", "m", l, speed}, {"y", "m", l, speed}, {"z", "m", l, speed}};
  for (const Component& e : eulerParameters(d)) u.push_back(e);
  setComponents(
      scene, u, {},
      {{"lambda_x", "N", force}, {"lambda_y", "N", force}, {"lambda_z", "N", force}, {"lambda", "J", normScale(d)}});
  scene.start.u << Real(0), d.l, Real(0), Real(1), Real(0), Real(0), Real(0);
  scene.start.v << -d.l * d.precession, Real(0), Real(0), Real(0), Real(0), d.spin / 2, d.precession / 2;
  return problem;
}

template <class Real>
FixedPoint<Real> setUp(FixedPoint<Real> problem, Scene<Real>& scene) {
  const Data<Real>& d = problem.d;
  setProblem(scene, problem);
  setComponents(scene, eulerParameters(d), {}, {{"lambda", "J", normScale(d)}});
  scene.start.u << Real(1), Real(0), Real(0), Real(0);
  scene.start.v << Real(0), Real(0), d.spin / 2, d.precession / 2;
  const auto position = [d](Real Vector<Real>::*along) {
    return [d, along](const State<Real>& s) { return Real(d.l * (axisOf(s.u, 0).*along)); };
  };
  scene.outputs = {{"x", position(&Vector<Real>::x), "m"},
                   {"y", position(&Vector<Real>::y), "m"},
                   {"z", position(&Vector<Real>::z), "m"}};
  return problem;
}

template <class Real, class P>
Scene<Real> sceneOf(const P& plain) {
  Scene<Real> scene;
  const P problem = setUp(plain, scene);
  completeStart(scene);
  scene.t_end = 1;
  const Motion<Real> motion(problem.d);
  if (motion.regular()) {
    scene.exact = [problem, motion](const Real& t) { return exactOf(problem, motion, t); };
  }
  const auto spin = [problem](const State<Real>& s) { return Real(problem.d.J3 * omegaOf(problem, s).y); };
  const auto vertical = [problem](const State<Real>& s) { return momentumOf(problem, s); };
  scene.outputs.push_back({"energy", [problem](const State<Real>& s) { return energyOf(problem, s); }, "J", true});
  scene.outputs.push_back({"Lz", vertical, "N m s", true});
  scene.outputs.push_back({"L_axis", spin, "N m s", true});
  return scene;
}

template <class Real>
struct HeavyTop {
  static Scene<Real> make(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Data<Real> d{.m = value("m"),
                       .l = value("l"),
                       .J1 = value("J1"),
                       .J3 = value("J3"),
                       .g = value("g"),
                       .spin = value("spin"),
                       .precession = value("precession")};
    return values.at("coordinates") == "absolute" ? sceneOf<Real>(Absolute<Real>{d})
                                                  : sceneOf<Real>(FixedPoint<Real>{d});
  }
  static SceneEntry entry() {
    return {
        .id = "heavy_top",
        .title = "heavy top in Euler parameters",
        .shows = "a singular mass matrix M(u), fast rotation in space; against elliptic functions",
        .collections = {"multibody"},
        .literature = "O. Bruels, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121-137",
        .kind = SceneKind::kConstrained,
        .parameters = {descriptionParameter("coordinates",
                                            "position and attitude, or the attitude about the fixed point",
                                            {"absolute", "fixed_point"}),
                       positiveParameter("m", "kg", "mass", "15"),
                       positiveParameter("l", "m", "distance of the centre of mass from the fixed point", "1"),
                       positiveParameter("J1", "kg m^2", "moment of inertia across the axis, about the centre of mass",
                                         "0.234375"),
                       positiveParameter("J3", "kg m^2", "moment of inertia about the axis", "0.46875"),
                       positiveParameter("g", "m/s^2", "gravity", "9.81"),
                       numberParameter("spin", "rad/s", "speed about the axis", "150", -1e6, 1e6),
                       numberParameter("precession", "rad/s",
                                       "speed of the horizontal axis about the vertical, at the start", "-4.61538",
                                       -1e6, 1e6)},
        .panels = {{"centre of mass", {"x", "y", "z"}}, {"path from above", {"x:y"}}, {"path from the front", {"x:z"}}},
        .reference_cases = {{.times = "0.3726 0.5", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(HeavyTop)
