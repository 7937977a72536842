// A simply supported beam in finite differences: u'' + c K u' + K u = 100 x_i sin 50 t, K = D^2,
// D = tridiag(1, -2, 1) (m + 1)^2, x_i = i / (m + 1). The system is linear; the exact solution is the sum of the
// modes of the discrete system, with frequencies w_k = 4 (m + 1)^2 sin^2(k pi / (2 (m + 1))).
#include <cstddef>

#include "irk/scene_file.h"

using namespace irk;

namespace {

constexpr int kForce = 100, kForceRate = 50;

template <class Real>
class ExactBeamChain;

template <class Real>
struct BeamChain {
  Index m;
  Real damping;  // s

  Sizes sizes() const { return {.nu = m, .nx = 0, .nz = 0, .constraints = 0}; }
  Real intervals() const { return Real(static_cast<double>(m + 1)); }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    const Real n2 = intervals() * intervals();
    const Real n4 = n2 * n2;
    const T force = kForce / intervals() * sin(kForceRate * p.t);
    // Applies K = D D in two steps. Differences of neighbours keep the digits of smooth u and v. The terms of a
    // single fourth difference, 6 (m + 1)^4 u, would cancel and leave their round-off.
    const auto D = [m = m](const auto& y, Index i) {
      const T before = i > 0 ? T(y[i] - y[i - 1]) : T(y[i]);
      const T after = i + 1 < m ? T(y[i + 1] - y[i]) : T(-y[i]);
      return T(after - before);
    };
    const auto moment = [&](Index i) {  // D q with q = u + damping u'; zero beyond the ends
      return i < m ? T(D(p.u, i) + damping * D(p.v, i)) : T(0.0);
    };
    T before(0.0), here = moment(0);
    for (Index i = 0; i < m; ++i) {
      const T after = moment(i + 1);
      const T Kq = n4 * ((after - here) - (here - before));
      r.u[i] = force * static_cast<double>(i + 1) - Kq - p.a[i];
      before = here;
      here = after;
    }
  }
  static Scene<Real> make(const Settings& values) {
    const BeamChain<Real> problem{static_cast<Index>(number<double>(values, "m")), number<Real>(values, "damping")};
    const ExactBeamChain<Real> exact(problem);
    Scene<Real> scene;
    setProblem(scene, problem);
    scene.t_end = 2;
    setComponents(scene, numbered(problem.m, "u", "", 1, 10));  // amplitudes 1 at the frequency pi^2 of the first mode
    scene.exact = [exact](const Real& t) { return exact.at(t); };
    scene.start = exact.start();
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "beam_chain",
            .title = "simply supported beam in finite differences, damped and driven",
            .shows = "cost against the number of unknowns; linear, sparse, exactly solvable",
            .collections = {"multibody"},
            .size = {.parameter = "m", .unknowns = 1, .step = 1e-3},
            .parameters = {wholeParameter("m", "interior points = unknowns", "25", 3, 40000, 100),
                           numberParameter("damping", "s", "stiffness-proportional damping", "1e-3", 0, 1e3)},
            .reference_cases = {{.times = "0.5 1"}}};
  }
};

// One mode: q'' + 2 delta q' + w^2 q = F sin 50 t with 2 delta = c w^2, started at rest from q0.
template <class Real>
struct Mode {
  Real q, rate, acceleration;

  Mode(const Real& w, const Real& c, const Real& F, const Real& q0, const Real& t) {
    using std::cos;
    using std::exp;
    using std::sin;
    using std::sqrt;
    const Real W = kForceRate, w2 = w * w, delta = c * w2 / 2;
    // The particular solution is P sin W t + Q cos W t.
    const Real a = w2 - W * W, b = 2 * delta * W, size = F / (a * a + b * b);
    const Real P = a * size, Q = -b * size;
    const Real y0 = q0 - Q, v0 = -P * W;  // start of the free part
    Real free, free_rate;
    if (delta < w) {
      const Real s = sqrt(w2 - delta * delta), decay = exp(-delta * t);
      const Real sine = sin(s * t) / s, cosine = cos(s * t);
      free = decay * (y0 * cosine + (v0 + delta * y0) * sine);
      free_rate = decay * (v0 * cosine - (w2 * y0 + delta * v0) * sine);
    } else {
      const Real s = sqrt(delta * delta - w2);
      const Real slow = -w2 / (delta + s), fast = -(delta + s);
      const Real c1 = (v0 - fast * y0) / (slow - fast), c2 = y0 - c1;
      const Real e1 = c1 * exp(slow * t), e2 = c2 * exp(fast * t);
      free = e1 + e2;
      free_rate = slow * e1 + fast * e2;
    }
    const Real sine = sin(W * t), cosine = cos(W * t);
    q = free + P * sine + Q * cosine;
    rate = free_rate + W * (P * cosine - Q * sine);
    acceleration = F * sine - 2 * delta * rate - w2 * q;
  }
};

template <class Real>
class ExactBeamChain {
 public:
  explicit ExactBeamChain(const BeamChain<Real>& problem) : p_(problem) {
    using std::sin;
    const Real step = piOf<Real>() / p_.intervals();
    for (Index i = 0; i < 2 * (p_.m + 1); ++i) sines_.push_back(sin(static_cast<double>(i) * step));
  }

  // Amplitudes of the first three modes at the start: 1, 0.2, 0.05.
  Real startAmplitude(Index k) const {
    return k == 1 ? Real(1) : k == 2 ? Real(1) / 5 : k == 3 ? Real(1) / 20 : Real(0);
  }
  // sin(k pi x_i), i = 1..m
  const Real& shape(Index k, Index i) const { return sines_[static_cast<std::size_t>((k * i) % (2 * (p_.m + 1)))]; }
  Real frequency(Index k) const {
    using std::sin;
    const Real root = 2 * p_.intervals() * sin(angle(k));
    return root * root;
  }

  State<Real> at(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> s(p_.sizes());
    s.t = t;
    for (Index k = 1; k <= p_.m; ++k) {
      // x_i = sum F_k sin(k pi x_i), F_k = (-1)^(k+1) cot(angle) / (m + 1)
      const Real cotangent = cos(angle(k)) / sin(angle(k));
      const Real F = (k % 2 == 1 ? kForce : -kForce) * cotangent / p_.intervals();
      const Mode<Real> mode(frequency(k), p_.damping, F, startAmplitude(k), t);
      // As `shape`, without a division for each of the m^2 terms: it would take most of the time.
      const Index period = 2 * (p_.m + 1);
      for (Index i = 0, place = k; i < p_.m; ++i) {
        const Real& sine = sines_[static_cast<std::size_t>(place)];
        s.u[i] += mode.q * sine;
        s.v[i] += mode.rate * sine;
        s.w[i] += mode.acceleration * sine;
        place = place + k < period ? place + k : place + k - period;
      }
    }
    return s;
  }

  // The start: at rest, bent in the first three modes. There is no force at t = 0.
  State<Real> start() const {
    State<Real> s(p_.sizes());
    for (Index k = 1; k <= std::min<Index>(3, p_.m); ++k) {
      const Real w = frequency(k);
      for (Index i = 1; i <= p_.m; ++i) {
        s.u[i - 1] += startAmplitude(k) * shape(k, i);
        s.w[i - 1] -= w * w * startAmplitude(k) * shape(k, i);
      }
    }
    return s;
  }

 private:
  Real angle(Index k) const { return static_cast<double>(k) * piOf<Real>() / (2 * p_.intervals()); }

  BeamChain<Real> p_;
  std::vector<Real> sines_;  // sin(j pi / (m + 1)) over one period
};

}  // namespace

IRK_SCENE(BeamChain)
