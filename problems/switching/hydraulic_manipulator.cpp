// Two links; a hydraulic cylinder with a spool valve lifts the first one. After Naya et al. (2011).
//
// u = (theta1, theta2), angles from the horizontal; x = (p1, p2), pressures in the chambers. The cylinder runs from
// (sqrt(3)/2 L, 0) to the middle of rod 1, so that it is L/2 long at theta1 = 30 degrees.
#include <cstddef>

#include "irk/misuse.h"
#include "irk/regularised.h"
#include "irk/scene_file.h"
#include "irk/vanishes.h"

using namespace irk;

namespace {

enum class Manoeuvre { kSteps, kSine };

constexpr std::size_t kCorners = 4;

// A polyline: straight between its corners, constant before the first and after the last one.
template <class Real>
struct Polyline {
  std::array<Real, kCorners> t, value;

  /// Slope after the first `passed` corners.
  Real slope(std::size_t passed) const {
    if (passed == 0 || passed == kCorners) return 0;
    return (value[passed] - value[passed - 1]) / (t[passed] - t[passed - 1]);
  }
  template <class T>
  T rounded(const T& at, const Real& width) const {
    T sum = value[0];
    for (std::size_t i = 0; i < kCorners; ++i) {
      sum += (slope(i + 1) - slope(i)) * roundedRamp<T>(at - t[i], width);
    }
    return sum;
  }
};

template <class Real>
Polyline<Real> polylineOf(Manoeuvre manoeuvre) {
  const auto number = [](const char* text) { return decimal<Real>(text); };
  switch (manoeuvre) {
    case Manoeuvre::kSteps:
      return {{2, number("2.001"), 6, number("6.002")}, {0, number("-0.01"), number("-0.01"), number("0.02")}};
    case Manoeuvre::kSine:
      break;
  }
  return {{0, 1, 8, 9}, {0, number("0.1"), number("0.1"), 0}};
}

// d: the number of corners passed; level and slope of the present piece of the polyline, level + slope t; a flag for
// each edge of the valve, 1 while the pressure drops in the direction of the flow.
enum Discrete : Index { kPassed, kLevel, kSlope, kFirstEdge };
constexpr Index kEdges = 4;
// Switches: the next corner, then the edges of the valve.
constexpr Index kCorner = 0, kFirstEdgeSwitch = 1;

std::vector<Parameter> parameters() {
  Parameter smoothing_p = smoothingParameter("Pa", "pressure drop over which an edge of the valve opens", "1e4");
  smoothing_p.name += "_p";
  return {
      wordParameter("manoeuvre", "what the valve does", {"steps", "sine"}),
      positiveParameter("L", "m", "length of rod 1", "1"),
      positiveParameter("L2", "m", "length of rod 2, massless", "0.5"),
      positiveParameter("m1", "kg", "distributed mass of rod 1", "200"),
      numberParameter("mt", "kg", "point mass at the tip of rod 1", "250", 0, 1e15),
      positiveParameter("m2", "kg", "point mass at the end of rod 2", "100"),
      numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
      positiveParameter("A", "m^2", "area of the piston", "0.0065"),
      positiveParameter("Lc", "m", "length of both chambers", "0.442"),
      numberParameter("c", "N s/m", "viscous friction of the cylinder", "1e5", 0, 1e15),
      positiveParameter("Av", "m^2", "area of the valve", "5e-4"),
      positiveParameter("cd", "", "discharge coefficient of the valve", "0.67"),
      positiveParameter("rho", "kg/m^3", "density of the oil", "850"),
      positiveParameter("pP", "Pa", "supply pressure", "7.6e6"),
      numberParameter("pT", "Pa", "tank pressure", "1e5", 0, 1e15),
      numberParameter("a", "1/Pa", "coefficient of the bulk modulus (1 + a p + b p^2) / (a + 2 b p)", "6.53e-10", 0, 1),
      numberParameter("b", "1/Pa^2", "coefficient of the same bulk modulus", "-1.19e-18", -1, 1),
      smoothingParameter("s", "time before and after a corner of the manoeuvre in which it is rounded", "1e-4"),
      smoothing_p};
}

template <class Real>
struct HydraulicManipulator {
  Real L, L2, m1, mt, m2, g;  // m, m, kg, kg, kg, m/s^2
  Real A, Lc, c;              // m^2, m, N s/m
  Real Av, cd, rho, pP, pT;   // m^2, -, kg/m^3, Pa, Pa
  Real a, b;                  // 1/Pa, 1/Pa^2
  Manoeuvre manoeuvre;
  Polyline<Real> polyline;
  Real smoothing, smoothing_p;  // s, Pa
  Real pi, base;                // -, m: distance from the hinge to the foot of the cylinder
  Real kappa0 = 0, p1 = 0;      // opening and pressure in chamber 1 at the start

  Sizes sizes() const { return {.nu = 2, .nx = 2, .discrete = kFirstEdge + kEdges, .switches = 1 + kEdges}; }
  Real s0() const { return L / 2; }
  template <class T>
  T length(const T& theta1) const {
    using std::cos;
    using std::sqrt;
    return sqrt(base * base + L * L / 4 - base * L * cos(theta1));
  }
  // ds/d(theta1), where s is the length of the cylinder.
  template <class T>
  T lever(const T& theta1) const {
    using std::sin;
    return base * L / 2 * sin(theta1) / length<T>(theta1);
  }
  // The moment of the weight about the hinge, divided by cos(theta1).
  Real load() const { return g * L * (m1 / 2 + mt + m2); }

  template <class T>
  T kappa(const Point<T>& p) const {
    using std::sin;
    const T line = p.d[kLevel] + p.d[kSlope] * p.t;
    switch (manoeuvre) {
      case Manoeuvre::kSteps:
        return kappa0 + line;
      case Manoeuvre::kSine:
        break;
    }
    return kappa0 * (1 - line * sin(4 * pi * p.t));
  }
  // Pressure drops at the edges: supply to chamber 1, chamber 1 to tank, supply to chamber 2, chamber 2 to tank.
  template <class T>
  std::array<T, kEdges> drops(const Point<T>& p) const {
    return {pP - p.x[0], p.x[0] - pT, pP - p.x[1], p.x[1] - pT};
  }
  // cd sqrt(2 drop / rho), continued as an odd function, since Newton may evaluate a mode beyond its end.
  template <class T>
  T speed(const T& drop) const {
    using std::sqrt;
    return drop < T(0.0) ? T(-cd * sqrt(-2 * drop / rho)) : T(cd * sqrt(2 * drop / rho));
  }
  template <class T>
  T bulkModulus(const T& p) const {
    return (1 + a * p + b * (p * p)) / (a + 2 * b * p);
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T &theta1 = p.u[0], &theta2 = p.u[1];
    const T s = length<T>(theta1), slope = lever<T>(theta1);
    const T s_rate = slope * p.v[0];
    const T F = (p.x[1] - p.x[0]) * A - c * s_rate;
    const Real J1 = L * L * (m1 / 3 + mt + m2), J2 = m2 * L2 * L2, J12 = m2 * L * L2;
    const T sine = J12 * sin(theta1 - theta2);
    r.u[0] = F * slope - load() * cos(theta1) - sine * (p.v[1] * p.v[1]);
    r.u[1] = sine * (p.v[0] * p.v[0]) - m2 * g * L2 * cos(theta2);
    if (!vanishes(p.a)) {
      const T cosine = J12 * cos(theta1 - theta2);
      r.u[0] = r.u[0] - J1 * p.a[0] - cosine * p.a[1];
      r.u[1] = r.u[1] - cosine * p.a[0] - J2 * p.a[1];
    }

    const T Ai = Av * kappa<T>(p), Ao = Av - Ai;
    const std::array<T, kEdges> drop = drops<T>(p);
    const T* const open = p.d.data() + kFirstEdge;
    const T in1 = Ai * (open[0] * speed<T>(drop[0])), out1 = Ao * (open[1] * speed<T>(drop[1]));
    const T in2 = Ao * (open[2] * speed<T>(drop[2])), out2 = Ai * (open[3] * speed<T>(drop[3]));
    const T l1 = Lc / 2 + s0() - s, l2 = Lc / 2 + s - s0();
    r.x[0] = bulkModulus<T>(p.x[0]) / (A * l1) * (A * s_rate + in1 - out1) - p.k[0];
    r.x[1] = bulkModulus<T>(p.x[1]) / (A * l2) * (in2 - out2 - A * s_rate) - p.k[1];
  }

  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const std::size_t next = passed(p);
    due[kCorner] = next < kCorners ? T(p.t - polyline.t[next]) : T(-1.0);
    const std::array<T, kEdges> drop = drops<T>(p);
    for (Index i = 0; i < kEdges; ++i) {
      const T& y = drop[static_cast<std::size_t>(i)];
      due[kFirstEdgeSwitch + i] = p.d[kFirstEdge + i] > T(0.0) ? T(-y) : T(y);
    }
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    if (i == kCorner) return passCorners(passed(p) + 1, d);
    const Index edge = kFirstEdge + i - kFirstEdgeSwitch;
    d[edge] = 1 - p.d[edge];
  }
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    d[kLevel] = polyline.rounded(p.t, smoothing);
    d[kSlope] = T(0.0);
    const std::array<T, kEdges> drop = drops<T>(p);
    for (Index i = 0; i < kEdges; ++i) {
      d[kFirstEdge + i] = smoothStep<T>(drop[static_cast<std::size_t>(i)] / smoothing_p);
    }
  }
  std::string switchName(Index i) const {
    constexpr const char* kNames[] = {"corner of the manoeuvre", "supply to chamber 1", "chamber 1 to tank",
                                      "supply to chamber 2", "chamber 2 to tank"};
    return kNames[i];
  }

  template <class T>
  void passCorners(std::size_t count, T* d) const {
    const std::size_t last = count == 0 ? 0 : count - 1;
    const Real slope = polyline.slope(count);
    d[kPassed] = T(static_cast<double>(count));
    d[kLevel] = T(polyline.value[last] - slope * polyline.t[last]);
    d[kSlope] = T(slope);
  }
  template <class T>
  static std::size_t passed(const Point<T>& p) {
    return static_cast<std::size_t>(valueOf(p.d[kPassed]));
  }
  // The equilibrium at theta1 = 30 degrees: the pressures carry the load, and the net flow into both chambers vanishes.
  // With kappa / (1 - kappa) = q the latter means q^2 = (p1 - pT) / (pP - p1) = (pP - p2) / (p2 - pT), hence
  // p1 + p2 = pP + pT.
  void setEquilibrium() {
    using std::cos;
    using std::sqrt;
    const Real theta1 = pi / 6;
    const Real force = load() * cos(theta1) / lever<Real>(theta1);
    const Real sum = pP + pT, difference = force / A;
    p1 = (sum - difference) / 2;
    if (!(p1 > pT && p1 < pP)) {
      throw Misuse("no equilibrium, the load needs more than pP - pT");
    }
    const Real q = sqrt((p1 - pT) / (pP - p1));
    kappa0 = q / (1 + q);
  }
  static HydraulicManipulator with(const Settings& values) {
    using std::sqrt;
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Manoeuvre manoeuvre = values.at("manoeuvre") == "sine" ? Manoeuvre::kSine : Manoeuvre::kSteps;
    HydraulicManipulator problem{.L = value("L"),
                                 .L2 = value("L2"),
                                 .m1 = value("m1"),
                                 .mt = value("mt"),
                                 .m2 = value("m2"),
                                 .g = value("g"),
                                 .A = value("A"),
                                 .Lc = value("Lc"),
                                 .c = value("c"),
                                 .Av = value("Av"),
                                 .cd = value("cd"),
                                 .rho = value("rho"),
                                 .pP = value("pP"),
                                 .pT = value("pT"),
                                 .a = value("a"),
                                 .b = value("b"),
                                 .manoeuvre = manoeuvre,
                                 .polyline = polylineOf<Real>(manoeuvre),
                                 .smoothing = value("smoothing"),
                                 .smoothing_p = value("smoothing_p"),
                                 .pi = piOf<Real>(),
                                 .base = value("L") * sqrt(Real(3)) / 2};
    problem.setEquilibrium();
    return problem;
  }
  void start(State<Real>& s) const {
    s.u << pi / 6, -pi / 2;
    s.x << p1, pP + pT - p1;
    passCorners(polyline.t[0] > 0 ? 0 : 1, s.d.data());
    s.d.tail(kEdges).setOnes();
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 10,
            .u = {{"theta1", "rad"}, {"theta2", "rad"}},
            .x = {{"p1", "Pa", 1e6}, {"p2", "Pa", 1e6}},
            .outputs = {{"s", [*this](const State<Real>& s) { return length<Real>(s.u[0]); }, "m"}}};
  }
  static SceneEntry entry() {
    return {.id = "hydraulic_manipulator",
            .title = "two links, the first lifted by a hydraulic cylinder behind a spool valve",
            .shows =
                "M(u) with stiff pressures, a bulk modulus that depends on them, and ramps of "
                "a millisecond",
            .collections = {"multibody", "switching"},
            .parameters = parameters(),
            .panels = {{"angles", {"theta1", "theta2"}},
                       {"angular velocities", {"theta1'", "theta2'"}},
                       {"pressures", {"p1", "p2"}, "MPa", 1e-6},
                       {"cylinder", {"s"}}},
            .reference_cases = {{.times = "2 4 6"}, {.settings = "manoeuvre=sine", .times = "2 5"}}};
  }
};

}  // namespace

IRK_SCENE(HydraulicManipulator)
