// A point mass that slides without friction along a cantilever of ANCF elements: the sliding joint of H. Sugiyama,
// J. L. Escalona, A. A. Shabana, Nonlinear Dyn. 31 (2003) 167-195, and of J. Gerstmayr's HOTINT.
//
// The mass is at the arc length s of the undeformed beam: (x, y) = r(s, q). From one element to the next r and its
// slope r' are continuous, r'' jumps, and with it the force on the mass, r'' s'^2: a switch. Beyond the tip the last
// element is extrapolated.
#include <type_traits>

#include "irk/scene_file.h"
#include "problems/mechanisms/ancf_beam.h"

using namespace irk;

namespace {

enum Switch : Index { kNext, kPrevious };

/// The beam, the mass and the element that it is on. d = (number of this element).
template <class Real>
struct Slide {
  AncfBeam<Real> beam;
  Real m, g;    // kg, m/s^2, downwards
  Index place;  // of the coordinate s in u

  Index beamUnknowns() const { return beam.sizes().nu; }
  Index last() const { return beam.elements() - 1; }
  Real startOf(Index element) const { return beam.elementLength() * static_cast<double>(element); }

  template <class T>
  Index elementAt(const T& s) const {
    Index element = 0;
    while (element < last() && s > T(startOf(element + 1))) ++element;
    return element;
  }
  template <class T>
  Index elementOf(const T& d) const {
    Index element = 0;
    while (element < last() && d > T(static_cast<double>(element) + 0.5)) ++element;
    return element;
  }
  template <class T>
  T inside(const T& s, Index element) const {
    return (s - startOf(element)) / beam.elementLength();
  }
  /// Both components of the sum of shape functions times the coordinates of an element.
  template <class T, class Vector>
  std::array<T, 2> sum(const std::array<T, 4>& shapes, const Vector& from, Index element) const {
    const auto q = beam.template gather<T>(from, element);
    return {AncfBeam<Real>::template dot<T>(shapes, q, 0), AncfBeam<Real>::template dot<T>(shapes, q, 1)};
  }
  /// Adds the force f that acts on the beam to its rows.
  template <class T>
  void push(const std::array<T, 4>& shapes, const T& x, const T& y, Index element, Rows<T>& r) const {
    for (std::size_t i = 0; i < 8; ++i) {
      const Index row = beam.unknown(element, i);
      if (row != AncfBeam<Real>::kFixed) r.u[row] += shapes[i / 2] * (i % 2 == 0 ? x : y);
    }
  }

  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const Index element = elementOf(p.d[0]);
    due[kNext] = element < last() ? T(p.u[place] - startOf(element + 1)) : T(-1.0);
    due[kPrevious] = element > 0 ? T(startOf(element) - p.u[place]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    const T next = d[0] + (i == kNext ? 1.0 : -1.0);
    if (next >= T(0.0) && next <= T(static_cast<double>(last()))) d[0] = next;
  }
  std::string switchName(Index i) const { return i == kNext ? "next element" : "previous element"; }
};

/// u = (beam, x, y, s, begin), z = force of the mass on the beam: 0 = (x, y) - r(s, q). The coordinate s has no mass;
/// its row says that the force is normal to the beam. Constraints depend on t and u only and must stay the same within
/// a step. The place where the element begins is therefore a coordinate, too: it is constant, and jumps at a switch.
template <class Real>
struct Joint : Slide<Real> {
  Sizes sizes() const {
    return {.nu = this->beamUnknowns() + 4, .nz = 2, .constraints = 2, .discrete = 1, .switches = 2};
  }
  Index x() const { return this->beamUnknowns(); }
  Index begin() const { return this->beamUnknowns() + 3; }
  template <class T>
  Index elementFrom(const T& begin) const {
    Index element = 0;
    while (element < this->last() && begin > T(this->startOf(element) + this->beam.elementLength() / 2)) ++element;
    return element;
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    this->beam.residual(p, r);
    const Index element = elementFrom(p.u[begin()]);
    const T xi = this->inside(p.u[this->place], element);
    const auto slope = this->sum(this->beam.template firstDerivatives<T>(xi), p.u, element);
    this->push(this->beam.template shapes<T>(xi), p.z[0], p.z[1], element, r);
    r.u[x()] = -this->m * p.a[x()] - p.z[0];
    r.u[x() + 1] = -this->m * (p.a[x() + 1] + this->g) - p.z[1];
    r.u[this->place] = slope[0] * p.z[0] + slope[1] * p.z[1];
    r.u[begin()] = -p.a[begin()];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& c) const {
    const auto at = u[this->place];
    using V = std::decay_t<decltype(at)>;
    const Index element = elementFrom(V(u[begin()]));
    const auto r = this->template sum<V>(this->beam.template shapes<V>(this->inside(at, element)), u, element);
    c[0] = u[x()] - r[0];
    c[1] = u[x() + 1] - r[1];
  }
  template <class T>
  void jump(Index, const Point<T>& p, T* u, T*, T*) const {
    u[begin()] = T(this->startOf(this->elementOf(p.d[0])));
  }
};

/// u = (beam, s): x and y are inserted, (x, y)'' = S q'' + r' s'' + 2 S' q' s' + r'' s'^2.
template <class Real>
struct Inserted : Slide<Real> {
  Sizes sizes() const { return {.nu = this->beamUnknowns() + 1, .discrete = 1, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    this->beam.residual(p, r);
    const Index element = this->elementOf(p.d[0]);
    const T xi = this->inside(p.u[this->place], element);
    const T &rate = p.v[this->place], &acceleration = p.a[this->place];
    const auto shapes = this->beam.template shapes<T>(xi), first = this->beam.template firstDerivatives<T>(xi);
    const auto moved = this->sum(shapes, p.a, element), turned = this->sum(first, p.v, element);
    const auto slope = this->sum(first, p.u, element);
    const auto bend = this->sum(this->beam.template secondDerivatives<T>(xi), p.u, element);
    std::array<T, 2> force;  // of the mass on the beam
    for (std::size_t i = 0; i < 2; ++i) {
      force[i] = -this->m * (moved[i] + slope[i] * acceleration + 2 * (turned[i] * rate) + bend[i] * rate * rate);
    }
    force[1] -= this->m * this->g;
    this->push(shapes, force[0], force[1], element, r);
    r.u[this->place] = slope[0] * force[0] + slope[1] * force[1];
  }
  std::array<Real, 2> position(const State<Real>& state) const {
    const Index element = this->elementAt(state.u[this->place]);
    return this->sum(this->beam.template shapes<Real>(this->inside(state.u[this->place], element)), state.u, element);
  }
  std::array<Real, 2> velocity(const State<Real>& state) const {
    const Index element = this->elementAt(state.u[this->place]);
    const Real xi = this->inside(state.u[this->place], element);
    const auto moved = this->sum(this->beam.template shapes<Real>(xi), state.v, element);
    const auto slope = this->sum(this->beam.template firstDerivatives<Real>(xi), state.u, element);
    const Real& rate = state.v[this->place];
    return {moved[0] + slope[0] * rate, moved[1] + slope[1] * rate};
  }
};

constexpr double kForce = 10;  // N, typical force on the joint

template <class Real>
void setUp(const Joint<Real>& problem, const Real& s0, const Real& v0, double speed, Scene<Real>& scene) {
  setProblem(scene, problem);
  auto u = problem.beam.coordinates(speed);
  for (const char* name : {"x", "y", "s", "begin"}) u.push_back({name, "m", 1, speed});
  setComponents(scene, u, {}, {{"lambda_x", "N", kForce}, {"lambda_y", "N", kForce}});
  scene.start.u.tail(4) << s0, Real(0), s0, problem.startOf(problem.elementAt(s0));
  scene.start.v.tail(4) << v0, Real(0), v0, Real(0);
  const auto energy = [problem](const State<Real>& s) {
    const Real x = s.v[problem.x()], y = s.v[problem.x() + 1];
    return Real(problem.beam.energy(s.u, s.v) + problem.m * ((x * x + y * y) / 2 + problem.g * s.u[problem.x() + 1]));
  };
  scene.outputs = {{"energy", energy, "J", true}};
}

template <class Real>
void setUp(const Inserted<Real>& problem, const Real& s0, const Real& v0, double speed, Scene<Real>& scene) {
  setProblem(scene, problem);
  auto u = problem.beam.coordinates(speed);
  u.push_back({"s", "m", 1, speed});
  setComponents(scene, u);
  scene.start.u.tail(1) << s0;
  scene.start.v.tail(1) << v0;
  const auto energy = [problem](const State<Real>& s) {
    const auto v = problem.velocity(s);
    return Real(problem.beam.energy(s.u, s.v) +
                problem.m * ((v[0] * v[0] + v[1] * v[1]) / 2 + problem.g * problem.position(s)[1]));
  };
  scene.outputs = {{"x", [problem](const State<Real>& s) { return problem.position(s)[0]; }, "m"},
                   {"y", [problem](const State<Real>& s) { return problem.position(s)[1]; }, "m"},
                   {"x'", [problem](const State<Real>& s) { return problem.velocity(s)[0]; }, "m/s"},
                   {"y'", [problem](const State<Real>& s) { return problem.velocity(s)[1]; }, "m/s"},
                   {"energy", energy, "J", true}};
}

std::vector<Parameter> parameters() {
  return {descriptionParameter("coordinates", "the joint by constraints, or the mass inserted into the beam",
                               {"joint", "inserted"}),
          elementsParameter("2"),
          positiveParameter("L", "m", "length of the beam", "1"),
          positiveParameter("A", "m^2", "area of the section", "0.0018"),
          positiveParameter("I", "m^4", "second moment of area", "1.35e-6"),
          positiveParameter("E", "Pa", "Young's modulus", "1e7"),
          positiveParameter("rho", "kg/m^3", "density", "1200"),
          numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
          positiveParameter("m", "kg", "mass that slides", "1"),
          numberParameter("start", "", "where the mass starts, as a part of the beam's length", "0.3", 0, 1),
          numberParameter("v0", "m/s", "velocity of the mass at the start", "1", -1e6, 1e6)};
}

template <class Real>
struct SlidingMass {
  static Scene<Real> make(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const auto data = AncfData<Real>::from(values, AncfSupport::kClamped);
    const Real s0 = value("start") * data.L, v0 = value("v0");
    const AncfBeam<Real> beam(data);
    const bool inserted = values.at("coordinates") == "inserted";
    const Index place = beam.sizes().nu + (inserted ? 0 : 2);
    const Slide<Real> slide{.beam = beam, .m = value("m"), .g = data.g, .place = place};
    const double speed = data.speed();
    Scene<Real> scene;
    if (inserted) {
      setUp(Inserted<Real>{slide}, s0, v0, speed, scene);
    } else {
      setUp(Joint<Real>{slide}, s0, v0, speed, scene);
    }
    const Vec<Real> straight = beam.straightStart().u;
    scene.start.u.head(straight.size()) = straight;
    scene.start.d << static_cast<double>(slide.elementAt(s0));
    completeStart(scene);
    scene.t_end = 0.35;
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "sliding_mass",
            .title = "mass that slides along an ANCF cantilever",
            .shows = "a joint that moves along a deforming body; the force jumps between elements",
            .collections = {"multibody", "switching"},
            .literature = "H. Sugiyama, J. L. Escalona, A. A. Shabana, Nonlinear Dyn. 31 (2003) 167-195",
            .kind = SceneKind::kConstrained,
            .size = {.parameter = "elements", .unknowns = 4, .step = 1e-4},
            .parameters = parameters(),
            .panels = {{"place on the beam", {"s"}},
                       {"mass and tip", {"y", "tip_y"}},
                       {"force of the joint", {"lambda_x", "lambda_y"}},
                       {"path of the mass", {"x:y"}}},
            .reference_cases = {{.times = "0.1 0.2 0.3", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(SlidingMass)
