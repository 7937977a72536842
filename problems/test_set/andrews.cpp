// Andrews' squeezing mechanism: seven rigid bodies in three loops. IVP test set, ANDREWS; HW II (VII.7).
#include "irk/scene_file.h"

using namespace irk;

namespace {

enum Angle : Index { kBeta, kTheta, kGamma, kPhi, kDelta, kOmega, kEpsilon };

template <class Real>
Real c(const char* text) {
  return decimal<Real>(text);
}

template <class Real>
struct Andrews {
  Real m1 = c<Real>(".04325"), m2 = c<Real>(".00365"), m3 = c<Real>(".02373"), m4 = c<Real>(".00706");
  Real m5 = c<Real>(".07050"), m6 = c<Real>(".00706"), m7 = c<Real>(".05498");
  Real I1 = c<Real>("2.194e-6"), I2 = c<Real>("4.410e-7"), I3 = c<Real>("5.255e-6"), I4 = c<Real>("5.667e-7");
  Real I5 = c<Real>("1.169e-5"), I6 = c<Real>("5.667e-7"), I7 = c<Real>("1.912e-5");
  Real xa = c<Real>("-.06934"), ya = c<Real>("-.00227"), xb = c<Real>("-.03635"), yb = c<Real>(".03273");
  Real xc = c<Real>(".014"), yc = c<Real>(".072"), c0 = c<Real>("4530"), l0 = c<Real>(".07785");
  Real drive = c<Real>(".033"), d = c<Real>(".028"), da = c<Real>(".0115"), e = c<Real>(".02");
  Real ea = c<Real>(".01421"), rr = c<Real>(".007"), ra = c<Real>(".00092"), ss = c<Real>(".035");
  Real sa = c<Real>(".01874"), sb = c<Real>(".01043"), sc = c<Real>(".018"), sd = c<Real>(".02");
  Real ta = c<Real>(".02308"), tb = c<Real>(".00916"), u = c<Real>(".04"), ua = c<Real>(".01228");
  Real ub = c<Real>(".00449"), zf = c<Real>(".02"), zt = c<Real>(".04"), fa = c<Real>(".01421");
  Real ee = e - ea, ff = zf - fa;

  Sizes sizes() const { return {.nu = 7, .nz = 6, .constraints = 6}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const auto &q = p.u, &v = p.v, &a = p.a, &z = p.z;
    const T sin_theta = sin(q[kTheta]), cos_theta = cos(q[kTheta]), sin_gamma = sin(q[kGamma]);
    const T cos_gamma = cos(q[kGamma]), sin_phi = sin(q[kPhi]), cos_phi = cos(q[kPhi]);
    const T sin_omega = sin(q[kOmega]), cos_omega = cos(q[kOmega]);

    // M a
    const T m12 = m2 * (da * da - da * rr * cos_theta) + I2;
    const T m11 = m1 * ra * ra + m2 * (rr * rr - 2 * da * rr * cos_theta + da * da) + I1 + I2;
    const T m45 = m4 * (ee * ee + zt * ee * sin_phi) + I4;
    const T m55 = m4 * (zt * zt + 2 * zt * ee * sin_phi + ee * ee) + m5 * (ta * ta + tb * tb) + I4 + I5;
    const T m67 = m6 * (ff * ff - u * ff * sin_omega) + I6;
    const T m77 = m6 * (ff * ff - 2 * u * ff * sin_omega + u * u) + m7 * (ua * ua + ub * ub) + I6 + I7;
    const T Ma[] = {m11 * a[0] + m12 * a[1],
                    m12 * a[0] + (m2 * da * da + I2) * a[1],
                    (m3 * (sa * sa + sb * sb) + I3) * a[2],
                    (m4 * ee * ee + I4) * a[3] + m45 * a[4],
                    m45 * a[3] + m55 * a[4],
                    (m6 * ff * ff + I6) * a[5] + m67 * a[6],
                    m67 * a[5] + m77 * a[6]};

    // Forces: the drive, the spring from C to D, and the velocity-dependent terms
    const T dx = sd * cos_gamma + sc * sin_gamma + xb - xc, dy = sd * sin_gamma - sc * cos_gamma + yb - yc;
    const T length = sqrt(dx * dx + dy * dy), force = -c0 * (length - l0) / length;
    const T spring = force * (dx * (sc * cos_gamma - sd * sin_gamma) + dy * (sd * cos_gamma + sc * sin_gamma));
    const T f[] = {drive - m2 * da * rr * (v[1] * (v[1] + 2 * v[0])) * sin_theta,
                   m2 * da * rr * (v[0] * v[0]) * sin_theta,
                   spring,
                   m4 * zt * ee * (v[4] * v[4]) * cos_phi,
                   -m4 * zt * ee * (v[3] * (v[3] + 2 * v[4])) * cos_phi,
                   -m6 * u * ff * (v[6] * v[6]) * cos_omega,
                   m6 * u * ff * (v[5] * (v[5] + 2 * v[6])) * cos_omega};

    // G^T lambda
    const T x = z[0] + z[2] + z[4], y = z[1] + z[3] + z[5];
    const T sum1 = q[0] + q[1], sum2 = q[3] + q[4], sum3 = q[5] + q[6];
    const T both = d * (sin(sum1) * x - cos(sum1) * y);
    const T phi_delta = -e * (cos(sum2) * z[2] + sin(sum2) * z[3]);
    const T omega_epsilon = zf * (sin(sum3) * z[4] - cos(sum3) * z[5]);
    const T Gl[] = {both + rr * (cos(q[0]) * y - sin(q[0]) * x),
                    both,
                    -ss * (cos_gamma * z[0] + sin_gamma * z[1]),
                    phi_delta,
                    phi_delta + zt * (sin(q[4]) * z[2] - cos(q[4]) * z[3]),
                    omega_epsilon,
                    omega_epsilon - u * (cos(q[6]) * z[4] + sin(q[6]) * z[5])};
    for (Index i = 0; i < 7; ++i) r.u[i] = f[i] - Gl[i] - Ma[i];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& q, G&& g) const {
    using std::cos;
    using std::sin;
    const auto x = rr * cos(q[0]) - d * cos(q[0] + q[1]), y = rr * sin(q[0]) - d * sin(q[0] + q[1]);
    const auto sum2 = q[3] + q[4], sum3 = q[5] + q[6];
    g[0] = x - ss * sin(q[2]) - xb;
    g[1] = y + ss * cos(q[2]) - yb;
    g[2] = x - e * sin(sum2) - zt * cos(q[4]) - xa;
    g[3] = y + e * cos(sum2) - zt * sin(q[4]) - ya;
    g[4] = x - zf * cos(sum3) - u * sin(q[6]) - xa;
    g[5] = y - zf * sin(sum3) + u * cos(q[6]) - ya;
  }
  // The digits of the test set. Theta is 0; the constraints determine the other angles.
  void start(State<Real>& s) const {
    s.u << Real(-0.0617138900142765), Real(0), Real(0.455279819163070), Real(0.222668390165886),
        Real(0.487364979543843), Real(-0.222668390165886), Real(1.23054744454982);
  }
  SceneFrame<Real> frame() const {
    SceneFrame<Real> frame{.t_end = 0.03,
                           .u = named("rad", {"beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"}),
                           .z = numbered(6, "lambda", "N"),
                           .unknown = {"beta", "gamma", "Phi", "delta", "Omega", "epsilon"}};
    for (std::size_t i = 0; i < 7; ++i) {
      const auto acceleration = [i](const State<Real>& s) { return Real(s.w[static_cast<Index>(i)]); };
      frame.outputs.push_back({frame.u[i].name + "''", acceleration, "rad/s^2"});
    }
    return frame;
  }
  static SceneEntry entry() {
    return {.id = "andrews",
            .title = "Andrews' squeezing mechanism: seven bodies, six multipliers",
            .shows = "index 3 with M(u): many coupled loops, fast rotation",
            .collections = {"ivp", "multibody"},
            .literature = "IVP test set, ANDREWS; HW II (VII.7)",
            .panels = {{"crank and its rod", {"beta", "Theta"}},
                       {"other angles", {"gamma", "Phi", "delta", "Omega", "epsilon"}}},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(Andrews)
