// A mass on a spring and a moving belt with set-valued Coulomb friction. With the belt at rest: free oscillations
// that decay by Coulomb friction.
#include "irk/regularised.h"
#include "irk/scene_file.h"

using namespace irk;

namespace {

// d = (friction force while slipping, Fd sign(vb - x'); 1 while sticking, 0 otherwise).
enum Discrete : Index { kFriction, kSticks };
enum Switch : Index { kSlipsBack, kSlipsAhead, kReachesBelt };

template <class Real>
class ExactStickSlip;

template <class Real>
struct StickSlip {
  Real m, k;       // kg, N/m
  Real Fs, Fd;     // N: largest sticking force, slip force
  Real vb;         // m/s
  Real x0, v0;     // m, m/s
  Real smoothing;  // m/s

  Sizes sizes() const { return {.nu = 1, .discrete = 2, .switches = 3}; }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = (1 - p.d[kSticks]) * (p.d[kFriction] - k * p.u[0]) - m * p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const bool sticks = p.d[kSticks] > T(0.0);
    const T spring = k * p.u[0];
    due[kSlipsBack] = sticks ? T(spring - Fs) : T(-1.0);
    due[kSlipsAhead] = sticks ? T(-spring - Fs) : T(-1.0);
    const T ahead = p.v[0] - vb;
    due[kReachesBelt] = sticks ? T(-1.0) : p.d[kFriction] > T(0.0) ? ahead : T(-ahead);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    const T spring = k * p.u[0];
    const bool holds = spring <= T(Fs) && -spring <= T(Fs);
    d[kSticks] = T(i == kReachesBelt && holds ? 1.0 : 0.0);
    if (i == kReachesBelt) {
      d[kFriction] = -p.d[kFriction];
    } else {
      d[kFriction] = T(i == kSlipsBack ? Fd : Real(-Fd));
    }
  }
  template <class T>
  void snap(Index i, const Point<T>&, T*, T* v, T*) const {
    if (i == kReachesBelt) v[0] = T(vb);
  }
  // Instead of sticking the mass creeps: friction rises to Fs over the first `smoothing` of the relative velocity,
  // and falls to Fd over the next one.
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    const T slip = (vb - p.v[0]) / smoothing;
    const bool back = slip > T(0.0);
    const T size = back ? slip : T(-slip);
    const T rise = size * (3 - size * size) / 2;
    const T friction = size < T(1.0) ? T(Fs * rise) : T(Fs - (Fs - Fd) * smoothStep<T>(size - 1));
    d[kFriction] = back ? friction : T(-friction);
    d[kSticks] = T(0.0);
  }
  std::string switchName(Index i) const {
    constexpr const char* kNames[] = {"slips back", "slips ahead", "reaches the belt"};
    return kNames[i];
  }
  static StickSlip with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.m = value("m"),
            .k = value("k"),
            .Fs = value("Fs"),
            .Fd = value("Fd"),
            .vb = value("vb"),
            .x0 = value("x0"),
            .v0 = value(values.at("v0") == "vb" ? "vb" : "v0"),
            .smoothing = value("smoothing")};
  }
  void start(State<Real>& s) const {
    s.u[0] = x0;
    s.v[0] = v0;
    const Real spring = k * x0;
    const bool back = v0 < vb || (v0 == vb && spring > 0);
    s.d[kFriction] = back ? Fd : Real(-Fd);
    s.d[kSticks] = Real(v0 == vb && spring <= Fs && -spring <= Fs ? 1 : 0);
  }
  State<Real> exact(const Real& t) const { return ExactStickSlip<Real>(*this).at(t); }
  SceneFrame<Real> frame() const {
    // Velocities are measured by the speed of the belt: an error e of x delays a slip by e / vb.
    const double belt = std::abs(static_cast<double>(vb));
    return {.t_end = 50,
            .u = {{"x", "m", static_cast<double>(Real(Fs / k)), belt > 0 ? belt : 1}},
            .exact_holds = Fd <= Fs};
  }
  static SceneEntry entry() {
    return {.id = "stick_slip",
            .title = "mass on a belt with Coulomb friction",
            .shows = "set-valued friction against an exact solution: what each treatment of discontinuities costs",
            .collections = {"switching"},
            .parameters = {positiveParameter("m", "kg", "mass", "1"), positiveParameter("k", "N/m", "spring", "1"),
                           positiveParameter("Fs", "N", "largest sticking force", "1.5"),
                           positiveParameter("Fd", "N", "slip force", "1"),
                           numberParameter("vb", "m/s", "belt speed", "0.1", -1e3, 1e3),
                           numberParameter("x0", "m", "position at the start", "0", -1e6, 1e6),
                           numberParameter("v0", "m/s", "velocity at the start; vb = on the belt", "vb", -1e6, 1e6),
                           smoothingParameter("m/s", "relative velocity at which friction is Fs; Fd from twice that on",
                                              "1e-4")},
            .panels = {{"position", {"x"}}, {"velocity", {"x'"}}},
            .reference_cases = {{.times = "20 30"}, {.settings = "Fs=1 k=100 v0=0 vb=0 x0=0.105"}}};
  }
};

// The exact solution, phase by phase: stick until |k x| = Fs, slip until x' = vb again. While slipping
// x = c + X cos omega tau + (V / omega) sin omega tau, c = +-Fd / k.
template <class Real>
class ExactStickSlip {
 public:
  explicit ExactStickSlip(const StickSlip<Real>& problem) : p_(problem) {}

  State<Real> at(const Real& t) const {
    using std::abs;
    Real x = p_.x0, v = p_.v0, left = t;
    bool slips_off = false;  // sticking has just ended: |k x| is Fs up to rounding
    while (true) {
      if (v == p_.vb && !slips_off && abs(p_.k * x) <= p_.Fs) {
        const Real duration = stickDuration(x);
        if (!(left > duration)) return state(t, x + p_.vb * left, v, 0, 0);
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
    Real omega, centre, X, V, side, duration;

    Slip(const StickSlip<Real>& p, const Real& x, const Real& v, const Real& sign) : side(sign) {
      using std::acos;
      using std::atan2;
      using std::sqrt;
      omega = sqrt(p.k / p.m);
      centre = side * p.Fd / p.k;
      X = x - centre;
      V = v;
      // Slip ends at x' = R cos(omega tau - delta) = vb. If it starts with x' = vb, omega tau = 0 is one root and
      // 2 delta the other.
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
      return of.state(t, x, v, -omega * omega * (x - centre), side);
    }
  };

  Real stickDuration(const Real& x) const {
    const Real edge = p_.Fs / p_.k;
    if (p_.vb == 0) return std::numeric_limits<Real>::infinity();
    return (p_.vb > 0 ? Real(edge - x) : Real(edge + x)) / (p_.vb > 0 ? p_.vb : Real(-p_.vb));
  }
  // `side`: the sign of the friction force; 0 while sticking.
  State<Real> state(const Real& t, const Real& x, const Real& v, const Real& a, const Real& side) const {
    State<Real> s(p_.sizes());
    s.d << side * p_.Fd, Real(side == 0 ? 1 : 0);
    s.t = t;
    s.u[0] = x;
    s.v[0] = v;
    s.w[0] = a;
    return s;
  }

  StickSlip<Real> p_;
};

}  // namespace

IRK_SCENE(StickSlip)
