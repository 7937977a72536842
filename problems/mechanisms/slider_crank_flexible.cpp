// Slider-crank with an elastic rod: Simeon (1998), problem "crank" of the IVP test set.
//
// u = (phi1, phi2, x3, q1, q2, q3, q4): angles of crank and rod, position of the slider, lateral sine modes q1, q2,
// longitudinal displacements q3 (middle) and q4 (end). The crank turns at the constant rate omega. The letters are
// those of the source; B is its skew matrix, c.q a dot product. Coulomb friction of the slider can be added.
#include "irk/regularised.h"
#include "irk/scene_file.h"
#include "irk/vanishes.h"

using namespace irk;

namespace {

template <class Real>
struct RodData {
  Real m2, m3, J1, J2;  // kg, kg m^2
  Real l1, l2, b, h;    // m: crank, rod, width and height of the rod
  Real E, rho, omega;   // Pa, kg/m^3, rad/s
  Real Fc, smoothing;   // N, m/s
};

template <class Real>
class FlexibleSliderCrank {
 public:
  explicit FlexibleSliderCrank(const RodData<Real>& data) : d_(data) {
    const Real pi = decimal<Real>("3.1415927");  // no more digits than the program of the reference solution
    const Real FM = d_.rho * d_.b * d_.h * d_.l2, FK = d_.E * d_.b * d_.h / d_.l2;
    const Real slender2 = d_.h * d_.h / (d_.l2 * d_.l2);
    const Real pi2 = pi * pi, pi3 = pi2 * pi, pi4 = pi2 * pi2;
    FM_ = FM;
    K1_ = FK * pi4 / 24 * slender2;
    K2_ = FK * pi4 * 2 / 3 * slender2;
    K33_ = FK * 16 / 3;
    K34_ = -FK * 8 / 3;
    K44_ = FK * 7 / 3;
    // B, c1, c2, c12, c21, each times rho; rho FB = FM.
    B13_ = -16 * FM / pi3;
    B14_ = (8 / pi3 - 1 / pi) * FM;
    B24_ = FM / (2 * pi);
    c1_3_ = FM * 2 / 3;
    c1_4_ = FM / 6;
    c2_1_ = FM * 2 / pi;
    c12_3_ = d_.l2 * FM / 3;
    c12_4_ = d_.l2 * FM / 6;
    c21_1_ = d_.l2 * FM / pi;
    c21_2_ = -d_.l2 * FM / (2 * pi);
  }

  // d = (sign of the slider's velocity); without friction d is empty.
  Sizes sizes() const {
    const Index friction = d_.Fc > 0 ? 1 : 0;
    return {.nu = 7, .nz = 3, .constraints = 3, .discrete = friction, .switches = friction};
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = -p.d[0] * p.v[2];
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = -p.d[0];
  }
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    d[0] = 2 * smoothStep<T>((p.v[2] / d_.smoothing + 1) / 2) - 1;
  }
  std::string switchName(Index) const { return "slider turns"; }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T &q1 = p.u[3], &q2 = p.u[4], &q3 = p.u[5], &q4 = p.u[6];
    const T &w1 = p.v[0], &w2 = p.v[1];
    const T &s1 = p.v[3], &s2 = p.v[4], &s3 = p.v[5], &s4 = p.v[6];  // q'
    const T C = cos(p.u[0] - p.u[1]), S = sin(p.u[0] - p.u[1]);
    const T w11 = w1 * w1, w22 = w2 * w2;

    const T Mq1 = FM_ / 2 * q1, Mq2 = FM_ / 2 * q2;  // Mq q
    const T Mq3 = FM_ * (8 * q3 + q4), Mq4 = FM_ * (q3 + 2 * q4);
    const T sMq = s1 * Mq1 + s2 * Mq2 + s3 * Mq3 + s4 * Mq4;
    const T c1q = c1_3_ * q3 + c1_4_ * q4, c1s = c1_3_ * s3 + c1_4_ * s4;
    const T c2q = c2_1_ * q1, c2s = c2_1_ * s1;
    const T c12s = c12_3_ * s3 + c12_4_ * s4;
    const Real half = d_.l1 * d_.l2 * d_.m2 / 2;

    const auto& z = p.z;
    const T cos1 = cos(p.u[0]), sin1 = sin(p.u[0]), cos2 = cos(p.u[1]), sin2 = sin(p.u[1]);
    const T rod = d_.l2 + q4;
    const T f1 = -half * (w22 * S) + d_.l1 * (w22 * (C * c2q - S * c1q)) - 2 * d_.l1 * (w2 * (C * c1s + S * c2s));
    r.u[0] = f1 - d_.l1 * (cos1 * z[0] + sin1 * z[1]) - z[2];
    // q'.B q' vanishes because B is skew.
    const T f2 = half * (w11 * S) + d_.l1 * (w11 * (S * c1q - C * c2q)) - 2 * (w2 * (c12s + sMq));
    r.u[1] = f2 - rod * (cos2 * z[0] + sin2 * z[1]);
    r.u[2] = -z[1];
    if (d_.Fc > 0) r.u[2] -= d_.Fc * p.d[0];
    // fq = w2^2 Mq q + w2^2 c12 + l1 w1^2 (C c1 + S c2) + 2 w2 B q' - Kq q
    const T turn = d_.l1 * w11, spin = 2 * w2;
    r.u[3] = w22 * Mq1 + turn * (c2_1_ * S) + spin * (B13_ * s3 + B14_ * s4) - K1_ * q1;
    r.u[4] = w22 * Mq2 + spin * (B24_ * s4) - K2_ * q2;
    r.u[5] = w22 * (Mq3 + c12_3_) + turn * (c1_3_ * C) - spin * (B13_ * s1) - K33_ * q3 - K34_ * q4;
    r.u[6] = w22 * (Mq4 + c12_4_) + turn * (c1_4_ * C) - spin * (B14_ * s1 + B24_ * s2) - K34_ * q3 - K44_ * q4 -
             sin2 * z[0] + cos2 * z[1];
    if (!vanishes(p.a)) subtractInertia(p, C, S, r);
  }

  template <class T, class U, class G>
  void constraints(const T& t, const U& u, G&& g) const {
    using std::cos;
    using std::sin;
    const auto rod = u[6] + d_.l2;
    g[0] = d_.l1 * sin(u[0]) + rod * sin(u[1]);
    g[1] = u[2] - d_.l1 * cos(u[0]) - rod * cos(u[1]);
    g[2] = u[0] - d_.omega * t;
  }

  static FlexibleSliderCrank with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return FlexibleSliderCrank({.m2 = value("m2"),
                                .m3 = value("m3"),
                                .J1 = value("J1"),
                                .J2 = value("J2"),
                                .l1 = value("l1"),
                                .l2 = value("l2"),
                                .b = value("b"),
                                .h = value("h"),
                                .E = value("E"),
                                .rho = value("rho"),
                                .omega = value("omega"),
                                .Fc = value("Fc"),
                                .smoothing = value("smoothing")});
  }
  // The start of the test set, made consistent: x3(0) and phi2'(0) are computed, since the printed values are rounded
  // to 9 digits.
  void start(State<Real>& s) const {
    s.u[5] = decimal<Real>("0.103339863e-4");
    s.u[6] = decimal<Real>("0.169327969e-4");
    s.u[2] = d_.l1 + d_.l2 + s.u[6];
    s.v[0] = d_.omega;
    s.v[1] = -d_.l1 * d_.omega / (d_.l2 + s.u[6]);
    s.v[3] = decimal<Real>("0.444896105");
    s.v[4] = decimal<Real>("0.463434311e-2");
    s.v[5] = decimal<Real>("-0.178591076e-5");
    s.v[6] = decimal<Real>("-0.268938672e-5");
    s.v[2] = s.v[6];
    s.d.setConstant(-1);  // the slider begins to move towards the crank
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 0.1,
            .u = {{"phi1", "rad", 1, 100},
                  {"phi2", "rad", 1, 100},
                  {"x3", "m", 0.1, 10},
                  {"q1", "m", 1e-4, 0.1},
                  {"q2", "m", 1e-5, 1e-2},
                  {"q3", "m", 1e-5, 1e-2},
                  {"q4", "m", 1e-5, 1e-2}},
            .z = {{"lambda1", "N", 100}, {"lambda2", "N", 100}, {"lambda3", "N m", 100}}};
  }
  static SceneEntry entry() {
    return {
        .id = "slider_crank_flexible",
        .title = "slider-crank with an elastic rod (Simeon; IVP test set 'crank')",
        .shows = "M(u), three multipliers and stiff elastic modes, against a published solution",
        .collections = {"ivp", "multibody"},
        .literature = "IVP test set, CRANK",
        .parameters = {positiveParameter("m2", "kg", "mass of the rod", "0.151104"),
                       positiveParameter("m3", "kg", "mass of the slider", "0.075552"),
                       positiveParameter("J1", "kg m^2", "inertia of the crank", "0.002727"),
                       positiveParameter("J2", "kg m^2", "inertia of the rod", "0.0045339259"),
                       positiveParameter("l1", "m", "crank length", "0.15"),
                       positiveParameter("l2", "m", "rod length", "0.30"),
                       positiveParameter("b", "m", "width of the rod", "0.008"),
                       positiveParameter("h", "m", "height of the rod", "0.008"),
                       positiveParameter("E", "Pa", "Young's modulus", "2e11"),
                       positiveParameter("rho", "kg/m^3", "density of the rod", "7870"),
                       positiveParameter("omega", "rad/s", "rate of the crank", "150"),
                       numberParameter("Fc", "N", "Coulomb friction of the slider", "0", 0, 1e15),
                       smoothingParameter("m/s", "speed from which on friction has its full size", "1e-2")},
        .panels = {{"angles", {"phi1", "phi2"}},
                   {"bending modes", {"q1", "q2"}, "mm", 1e3},
                   {"longitudinal modes", {"q3", "q4"}, "µm", 1e6},
                   {"multipliers", {"lambda1", "lambda2"}},
                   {"multiplier", {"lambda3"}}},
        .reference_cases = {{.times = "0.01 0.02 0.025 0.03 0.04 0.05 0.06 0.07 0.08 0.09", .tolerance = kFewDigits},
                            {.settings = "Fc=20",
                             .times = "0.005 0.01 0.015 0.02 0.025 0.03 0.035 0.04 0.045 0.05",
                             .tolerance = kFewDigits}}};
  }

 private:
  // r -= M(u) a.
  template <class T>
  void subtractInertia(const Point<T>& p, const T& C, const T& S, Rows<T>& r) const {
    const T &q1 = p.u[3], &q2 = p.u[4], &q3 = p.u[5], &q4 = p.u[6];
    const T &a1 = p.a[0], &a2 = p.a[1];
    const T qMq = q1 * (FM_ / 2 * q1) + q2 * (FM_ / 2 * q2) + q3 * (FM_ * (8 * q3 + q4)) + q4 * (FM_ * (q3 + 2 * q4));
    const T c1q = c1_3_ * q3 + c1_4_ * q4, c2q = c2_1_ * q1, c12q = c12_3_ * q3 + c12_4_ * q4;
    // Rows of M that couple the rotations with q: M1q = l1 (-S c1 + C c2), M2q = c21 + q^T B.
    const T M1q1 = d_.l1 * c2_1_ * C, M1q3 = -d_.l1 * c1_3_ * S, M1q4 = -d_.l1 * c1_4_ * S;
    const T M2q1 = c21_1_ - B13_ * q3 - B14_ * q4, M2q2 = c21_2_ - B24_ * q4;
    const T M2q3 = B13_ * q1, M2q4 = B14_ * q1 + B24_ * q2;
    const T M12 = d_.l1 * d_.l2 * d_.m2 / 2 * C + d_.l1 * (S * c2q + C * c1q);
    r.u[0] -= (d_.J1 + d_.m2 * d_.l1 * d_.l1) * a1 + M12 * a2 + M1q1 * p.a[3] + M1q3 * p.a[5] + M1q4 * p.a[6];
    r.u[1] -= M12 * a1 + (d_.J2 + qMq + 2 * c12q) * a2 + M2q1 * p.a[3] + M2q2 * p.a[4] + M2q3 * p.a[5] + M2q4 * p.a[6];
    r.u[2] -= d_.m3 * p.a[2];
    r.u[3] -= M1q1 * a1 + M2q1 * a2 + FM_ / 2 * p.a[3];
    r.u[4] -= M2q2 * a2 + FM_ / 2 * p.a[4];
    r.u[5] -= M1q3 * a1 + M2q3 * a2 + FM_ * (8 * p.a[5] + p.a[6]);
    r.u[6] -= M1q4 * a1 + M2q4 * a2 + FM_ * (p.a[5] + 2 * p.a[6]);
  }

  RodData<Real> d_;
  Real FM_, K1_, K2_, K33_, K34_, K44_;
  Real B13_, B14_, B24_, c1_3_, c1_4_, c2_1_, c12_3_, c12_4_, c21_1_, c21_2_;
};

}  // namespace

IRK_SCENE(FlexibleSliderCrank)
