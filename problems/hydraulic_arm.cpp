// One rigid arm, one cylinder, one valve with sign-switched flow: the closest reconstruction of the
// paper's example.
//
// u = angle of the arm from the horizontal, x = (p0, p1). The cylinder runs from (0, -L/4) to the
// arm's point at L/4 from the hinge: s = L/4 sqrt(2 + 2 sin angle).
#include <cmath>

#include "problems/build.h"
#include "problems/entries.h"

namespace irk {
namespace {

enum class ArmReference { kKinked, kSmooth };

template <class Real>
struct HydraulicArm {
  Real L, m, g;           // m, kg, m/s^2
  Real A, d;              // m^2, N s/m
  Real V, K, Qn, pS, pT;  // m^3, Pa, m^3/s/sqrt(Pa), Pa
  Real LH0, pi;           // m, length of the cylinder at angle 0
  ArmReference reference;

  Sizes sizes() const { return {.nu = 1, .nx = 2, .nz = 0, .constraints = 0}; }

  template <class T>
  T referenceLength(const T& t) const {
    using std::cos;
    const T wave = 1 - cos(pi * t);
    switch (reference) {
      case ArmReference::kSmooth:
        return LH0 + wave / 20;
      case ArmReference::kKinked:
        break;
    }
    if (wave < 0.5) return T(LH0);
    if (wave > 1.5) return T(LH0 + Real(1) / 10);
    return LH0 + (wave - 0.5) / 10;
  }

  // Flow into a chamber at pressure p: from the supply if the valve opens to that side (opening >
  // 0), else to the tank. sq(y) = sign(y) sqrt|y|.
  template <class T>
  T flow(const T& opening, const T& p) const {
    using std::sqrt;
    const T drop = opening >= T(0.0) ? T(pS - p) : T(p - pT);
    const T root = drop < T(0.0) ? T(-sqrt(-drop)) : T(sqrt(drop));
    return Qn * (opening * root);
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T cosine = cos(p.u[0]);
    const Real lever = L / 4;
    const T s = lever * sqrt(2 + 2 * sin(p.u[0]));
    const T slope = lever * lever * (cosine / s);  // ds/d(angle)
    const T s_rate = slope * p.v[0];
    const T force = A * (p.x[1] - p.x[0]) + d * s_rate;  // tension positive
    // J + m (L/2)^2 = m L^2 / 3 about the hinge
    r.u[0] = -m * g * L / 2 * cosine - force * slope - m * L * L / 3 * p.a[0];
    const T opening = 2 * (referenceLength(p.t) - s);
    const T volume_rate = A * s_rate;
    r.x[0] = K / V * (flow<T>(opening, p.x[0]) - volume_rate) - p.k[0];
    r.x[1] = K / V * (flow<T>(-opening, p.x[1]) + volume_rate) - p.k[1];
  }
};

template <class Real>
Scene<Real> make(const Settings& settings) {
  using std::sqrt;
  const auto value = [&](const char* name) { return number<Real>(settings, name); };
  const Real L = value("L");
  const HydraulicArm<Real> arm{.L = L,
                               .m = value("m"),
                               .g = value("g"),
                               .A = value("A"),
                               .d = value("d"),
                               .V = value("V"),
                               .K = value("K"),
                               .Qn = value("Qn"),
                               .pS = value("pS"),
                               .pT = value("pT"),
                               .LH0 = L / 4 * sqrt(Real(2)),
                               .pi = piOf<Real>(),
                               .reference = settings.at("reference") == "smooth"
                                                ? ArmReference::kSmooth
                                                : ArmReference::kKinked};
  Scene<Real> scene;
  scene.id = "hydraulic_arm";
  setProblem(scene, arm);
  scene.start.x << value("p0"), value("p1");
  completeStart(scene);
  scene.t_end = 2;
  scene.names = componentNames({"angle"}, {"p0", "p1"}, {});
  scene.scale = scales({1, 1, 1e7, 1e7});
  scene.outputs = {{"s", [L](const State<Real>& s) {
                      using std::sin;
                      using std::sqrt;
                      return Real(L / 4 * sqrt(2 + 2 * sin(s.u[0])));
                    }}};
  return scene;
}

}  // namespace

SceneEntry hydraulicArmEntry() {
  return {.id = "hydraulic_arm",
          .title = "rigid arm lifted by a hydraulic cylinder through a proportional valve",
          .shows = "stiff pressures with sign-switched flow and a kinked reference",
          .parameters =
              {wordParameter("reference",
                             "wanted length of the cylinder: 1 - cos pi t with its ends "
                             "cut off, or whole",
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
               numberParameter("p1", "Pa", "pressure in chamber 1 at the start", "2e6", 0, 1e15)},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
