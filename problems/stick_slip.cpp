// A mass on a spring and a moving belt with set-valued Coulomb friction; with the belt at rest,
// free Coulomb decay.
#include <cmath>

#include "problems/build.h"
#include "problems/entries.h"

namespace irk {
namespace {

template <class Real>
struct StickSlip {
  Real m, k;    // kg, N/m
  Real Fs, Fd;  // N: largest sticking force, slip force
  Real vb;      // m/s
  Real x0, v0;  // m, m/s

  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0}; }

  // The law as it stands: slip force Fd sign(vb - x'); at relative velocity 0, where Coulomb's
  // force is a set, the mass sticks as far as Fs allows, and else has begun to slip. Velocity 0 is
  // met only exactly, so that a plain integrator rarely sees it.
  template <class T>
  T friction(const T& x, const T& v) const {
    const T slip = vb - v;
    const T spring = k * x;
    if (slip > T(0.0)) return T(Fd);
    if (slip < T(0.0)) return T(-Fd);
    if (spring > T(Fs)) return T(Fd);
    if (spring < T(-Fs)) return T(-Fd);
    return spring;
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = friction<T>(p.u[0], p.v[0]) - k * p.u[0] - m * p.a[0];
  }
};

// The solution, event by event: stick until |k x| = Fs, slip until x' = vb again. Between them
// x = c + X cos omega tau + (V / omega) sin omega tau, c = +-Fd / k.
template <class Real>
class ExactStickSlip {
 public:
  explicit ExactStickSlip(const StickSlip<Real>& problem) : p_(problem) {}

  State<Real> at(const Real& t) const {
    using std::abs;
    Real x = p_.x0, v = p_.v0, left = t;
    bool slips_off = false;  // leaves sticking: |k x| is Fs, up to rounding
    while (true) {
      if (v == p_.vb && !slips_off && abs(p_.k * x) <= p_.Fs) {
        const Real duration = stickDuration(x);
        if (!(left > duration)) return state(t, x + p_.vb * left, v, 0);
        left -= duration;
        x = (p_.vb > 0 ? p_.Fs : -p_.Fs) / p_.k;
        slips_off = true;
        continue;
      }
      const Real side = v == p_.vb ? Real(x > 0 ? 1 : -1) : Real(v < p_.vb ? 1 : -1);
      const Slip slip(p_, x, v, side);
      if (!(left > slip.duration)) return slip.state(*this, t, left);
      left -= slip.duration;
      x = slip.position(slip.duration);
      v = p_.vb;
      slips_off = false;
    }
  }

 private:
  struct Slip {
    Real omega, centre, X, V, duration;

    Slip(const StickSlip<Real>& p, const Real& x, const Real& v, const Real& side) {
      using std::acos;
      using std::atan2;
      using std::sqrt;
      omega = sqrt(p.k / p.m);
      centre = side * p.Fd / p.k;
      X = x - centre;
      V = v;
      // x' = R cos(omega tau - delta) = vb. From x' = vb on, tau = 0 is one root, 2 delta the
      // other.
      const Real R = sqrt(V * V + omega * omega * X * X);
      const Real delta = atan2(-omega * X, V);
      const Real turn = 2 * piOf<Real>();
      const auto positive = [&](Real angle) { return angle > 0 ? angle : Real(angle + turn); };
      if (v == p.vb) {
        duration = positive(2 * delta) / omega;
      } else if (p.vb > R || p.vb < -R) {
        duration = std::numeric_limits<Real>::infinity();
      } else {
        const Real width = acos(p.vb / R);
        const Real first = positive(delta - width), second = positive(delta + width);
        duration = (first < second ? first : second) / omega;
      }
    }
    Real position(const Real& tau) const {
      using std::cos;
      using std::sin;
      return centre + X * cos(omega * tau) + V / omega * sin(omega * tau);
    }
    State<Real> state(const ExactStickSlip& of, const Real& t, const Real& tau) const {
      using std::cos;
      using std::sin;
      const Real x = position(tau);
      const Real v = V * cos(omega * tau) - X * omega * sin(omega * tau);
      return of.state(t, x, v, -omega * omega * (x - centre));
    }
  };

  Real stickDuration(const Real& x) const {
    const Real edge = p_.Fs / p_.k;
    if (p_.vb == 0) return std::numeric_limits<Real>::infinity();
    return (p_.vb > 0 ? Real(edge - x) : Real(edge + x)) / (p_.vb > 0 ? p_.vb : Real(-p_.vb));
  }
  State<Real> state(const Real& t, const Real& x, const Real& v, const Real& a) const {
    State<Real> s(p_.sizes());
    s.t = t;
    s.u[0] = x;
    s.v[0] = v;
    s.w[0] = a;
    return s;
  }

  StickSlip<Real> p_;
};

template <class Real>
Scene<Real> make(const Settings& settings) {
  const auto value = [&](const std::string& name) { return number<Real>(settings, name); };
  const StickSlip<Real> problem{.m = value("m"),
                                .k = value("k"),
                                .Fs = value("Fs"),
                                .Fd = value("Fd"),
                                .vb = value("vb"),
                                .x0 = value("x0"),
                                .v0 = value(settings.at("v0") == "vb" ? "vb" : "v0")};
  Scene<Real> scene;
  scene.id = "stick_slip";
  setProblem(scene, problem);
  scene.start.u[0] = problem.x0;
  scene.start.v[0] = problem.v0;
  completeStart(scene);
  scene.t_end = 50;
  scene.names = componentNames({"x"}, {}, {});
  scene.scale = scales({static_cast<double>(Real(problem.Fs / problem.k)), 1});
  if (problem.Fd <= problem.Fs) {
    scene.exact = [exact = ExactStickSlip<Real>(problem)](const Real& t) { return exact.at(t); };
  }
  return scene;
}

}  // namespace

SceneEntry stickSlipEntry() {
  return {.id = "stick_slip",
          .title = "mass on a belt with Coulomb friction",
          .shows =
              "set-valued friction against an exact solution: what each way to treat a "
              "discontinuity costs",
          .parameters = {positiveParameter("m", "kg", "mass", "1"),
                         positiveParameter("k", "N/m", "spring", "1"),
                         positiveParameter("Fs", "N", "largest sticking force", "1.5"),
                         positiveParameter("Fd", "N", "slip force", "1"),
                         numberParameter("vb", "m/s", "belt speed", "0.1", -1e3, 1e3),
                         numberParameter("x0", "m", "position at the start", "0", -1e6, 1e6),
                         numberParameter("v0", "m/s", "velocity at the start; vb = on the belt",
                                         "vb", -1e6, 1e6)},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
