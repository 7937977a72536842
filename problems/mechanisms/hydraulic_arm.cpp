// One rigid arm, one cylinder, and one valve whose flow depends on the sign of its opening. This is the closest
// reconstruction of the paper's example.
//
// u = angle of the arm from the horizontal, x = (p0, p1), pressures in the chambers. The cylinder runs from (0, -L/4)
// to the point of the arm at L/4 from the hinge; its length is s = L/4 sqrt(2 + 2 sin angle).
#include "irk/regularised.h"
#include "irk/scene_file.h"

using namespace irk;

namespace {

enum class ArmReference { kKinked, kSmooth };

// d: 1 while the valve connects chamber 0 to the supply (and chamber 1 to the tank). For the kinked reference also:
// 1 while it rises or falls; 1 at its upper end.
enum Discrete : Index { kSupply0, kMiddle, kHigh };
// Switches: the valve; the lower and the upper kink.
enum Switch : Index { kValve, kLower, kUpper };

template <class Real>
struct HydraulicArm {
  Real L, m, g;           // m, kg, m/s^2
  Real A, d;              // m^2, N s/m
  Real V, K, Qn, pS, pT;  // m^3, Pa, m^3/s/sqrt(Pa), Pa
  Real p0, p1;            // Pa, at the start
  Real LH0, pi;           // m, length of the cylinder at angle 0
  ArmReference reference;
  Real smoothing;  // m

  Sizes sizes() const {
    const Index switches = reference == ArmReference::kKinked ? 3 : 1;
    return {.nu = 1, .nx = 2, .discrete = switches, .switches = switches};
  }

  template <class T>
  T wave(const T& t) const {
    using std::cos;
    return 1 - cos(pi * t);
  }
  // The kinked reference moves while the wave is between 0.5 and 1.5.
  template <class T>
  T referenceLength(const Point<T>& p) const {
    switch (reference) {
      case ArmReference::kSmooth:
        return LH0 + wave<T>(p.t) / 20;
      case ArmReference::kKinked:
        break;
    }
    return LH0 + (p.d[kMiddle] * (wave<T>(p.t) - 0.5) + p.d[kHigh]) / 10;
  }
  template <class T>
  T length(const T& angle) const {
    using std::sin;
    using std::sqrt;
    return L / 4 * sqrt(2 + 2 * sin(angle));
  }
  // The opening of the valve for chamber 0; that for chamber 1 is its negative.
  template <class T>
  T opening(const Point<T>& p) const {
    return 2 * (referenceLength<T>(p) - length<T>(p.u[0]));
  }

  // sq(y) = sign(y) sqrt|y|
  template <class T>
  T signedRoot(const T& y) const {
    using std::sqrt;
    return y < T(0.0) ? T(-sqrt(-y)) : T(sqrt(y));
  }
  // The flow into a chamber at pressure p. It comes from the supply if the valve opens to that side; else the chamber
  // is connected to the tank.
  template <class T>
  T flow(const T& from_supply, const T& opening, const T& p) const {
    return Qn * opening * (from_supply * signedRoot<T>(pS - p) + (1 - from_supply) * signedRoot<T>(p - pT));
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T cosine = cos(p.u[0]);
    const T slope = L * L / 16 * (cosine / length<T>(p.u[0]));  // ds/d(angle)
    const T s_rate = slope * p.v[0];
    const T force = A * (p.x[1] - p.x[0]) + d * s_rate;  // tension positive
    // Inertia about the hinge: J + m (L/2)^2 = m L^2 / 3.
    r.u[0] = -m * g * L / 2 * cosine - force * slope - m * L * L / 3 * p.a[0];
    const T Av0 = opening<T>(p), supply0 = p.d[kSupply0];
    const T volume_rate = A * s_rate;
    r.x[0] = K / V * (flow<T>(supply0, Av0, p.x[0]) - volume_rate) - p.k[0];
    r.x[1] = K / V * (flow<T>(1 - supply0, -Av0, p.x[1]) + volume_rate) - p.k[1];
  }

  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const T Av0 = opening<T>(p);
    due[kValve] = p.d[kSupply0] > T(0.0) ? T(-Av0) : Av0;
    if (reference == ArmReference::kSmooth) return;
    const T w = wave<T>(p.t);
    const bool middle = p.d[kMiddle] > T(0.0), high = p.d[kHigh] > T(0.0);
    due[kLower] = middle ? T(0.5 - w) : high ? T(-1.0) : T(w - 0.5);
    due[kUpper] = middle ? T(w - 1.5) : high ? T(1.5 - w) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* modes) const {
    if (i == kValve) {
      modes[kSupply0] = 1 - p.d[kSupply0];
      return;
    }
    modes[kMiddle] = 1 - p.d[kMiddle];
    modes[kHigh] = i == kUpper ? T(1 - p.d[kHigh]) : T(0.0);
  }
  // Blends over `smoothing`: as the opening of the valve, and as the distance of the reference from its kinks.
  template <class T>
  void smoothed(const Point<T>& p, T* modes) const {
    if (reference == ArmReference::kKinked) {
      const T above = wave<T>(p.t) - 0.5;
      const Real width = 10 * smoothing;
      modes[kMiddle] = T(0.0);
      modes[kHigh] = roundedRamp<T>(above, width) - roundedRamp<T>(above - 1, width);
    }
    const Point<T> at{p.t, p.u, p.v, p.x, p.a, p.k, p.z, {modes, p.d.size()}};
    modes[kSupply0] = smoothStep<T>((opening<T>(at) / smoothing + 1) / 2);
  }
  std::string switchName(Index i) const {
    constexpr const char* kNames[] = {"valve", "lower kink", "upper kink"};
    return kNames[i];
  }
  static HydraulicArm with(const Settings& values) {
    using std::sqrt;
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Real L = value("L");
    return {.L = L,
            .m = value("m"),
            .g = value("g"),
            .A = value("A"),
            .d = value("d"),
            .V = value("V"),
            .K = value("K"),
            .Qn = value("Qn"),
            .pS = value("pS"),
            .pT = value("pT"),
            .p0 = value("p0"),
            .p1 = value("p1"),
            .LH0 = L / 4 * sqrt(Real(2)),
            .pi = piOf<Real>(),
            .reference = values.at("reference") == "smooth" ? ArmReference::kSmooth : ArmReference::kKinked,
            .smoothing = value("smoothing")};
  }
  void start(State<Real>& s) const {
    s.x << p0, p1;
    s.d[kSupply0] = 1;  // the valve is closed; the arm falls first, which opens chamber 0 to the supply
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 2,
            .u = {{"angle", "rad"}},
            .x = {{"p0", "Pa", 1e7}, {"p1", "Pa", 1e7}},
            .outputs = {{"s", [*this](const State<Real>& s) { return length<Real>(s.u[0]); }, "m"}}};
  }
  static SceneEntry entry() {
    return {
        .id = "hydraulic_arm",
        .title = "rigid arm lifted by a hydraulic cylinder through a proportional valve",
        .shows = "stiff pressures with sign-switched flow and a kinked reference",
        .collections = {"multibody", "switching"},
        .parameters =
            {wordParameter("reference", "wanted length of the cylinder: 1 - cos pi t with its ends cut off, or whole",
                           {"kinked", "smooth"}),
             positiveParameter("L", "m", "length of the arm", "1"),
             positiveParameter("m", "kg", "mass of the arm", "120"),
             numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
             positiveParameter("A", "m^2", "area of the piston", "0.01"),
             numberParameter("d", "N s/m", "viscous friction of the cylinder", "2e5", 0, 1e15),
             positiveParameter("V", "m^3", "volume of a chamber", "1"),
             positiveParameter("K", "Pa", "bulk modulus", "1e11"),
             positiveParameter("Qn", "m^3/s/sqrt(Pa)", "nominal flow of the valve", "2e-5"),
             positiveParameter("pS", "Pa", "supply pressure", "2e7"),
             numberParameter("pT", "Pa", "tank pressure", "0", 0, 1e15),
             numberParameter("p0", "Pa", "pressure in chamber 0 at the start", "2e6", 0, 1e15),
             numberParameter("p1", "Pa", "pressure in chamber 1 at the start", "2e6", 0, 1e15),
             smoothingParameter(
                 "m", "opening of the valve over which its flow changes sides, and width over which kinks are rounded",
                 "1e-4")},
        .panels = {{"angle", {"angle"}}, {"angular velocity", {"angle'"}}, {"pressures", {"p0", "p1"}, "MPa", 1e-6}},
        .reference_cases = {{.times = "0.2 0.4 0.6 0.8 1 1.2 1.4 1.6 1.8", .tolerance = kManyDigits},
                            {.settings = "reference=smooth",
                             .times = "0.2 0.4 0.5 0.6 0.8 1 1.2 1.4 1.6 1.8",
                             .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(HydraulicArm)
