// An oscillator under a PD controller whose force is computed at sampling times and held constant in between.
#include "irk/scene_file.h"
#include "problems/support/piecewise_linear.h"

using namespace irk;

namespace {

// d = (the held force F_k, the number k + 1 of the next sample). There is no regularisation, since d depends on the
// past.
enum Discrete : Index { kForce, kNext };

template <class Real>
struct SampledControl {
  Real m, d, c;        // kg, N s/m, N/m
  Real Kp, Kd, r, Ts;  // N/m, N s/m, m, s

  Sizes sizes() const { return {.nu = 1, .discrete = 2, .switches = 1}; }
  template <class T>
  T control(const T& x, const T& v) const {
    return Kp * (r - x) - Kd * v;
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> rows) const {
    rows.u[0] = p.d[kForce] - d * p.v[0] - c * p.u[0] - m * p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = p.t - p.d[kNext] * Ts;
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* modes) const {
    modes[kForce] = control<T>(p.u[0], p.v[0]);
    modes[kNext] = p.d[kNext] + 1;
    // A step may be longer than the time between samples.
    while (p.t >= modes[kNext] * Ts) modes[kNext] = modes[kNext] + 1;
  }
  // The matrix of v' = rates (u, v, 1).
  Mat<Real> rates(const Vec<Real>& modes) const {
    Mat<Real> rows(1, 3);
    rows << -c / m, -d / m, modes[kForce] / m;
    return rows;
  }
  std::string switchName(Index) const { return "sample"; }
  static SampledControl with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.m = value("m"),
            .d = value("d"),
            .c = value("c"),
            .Kp = value("Kp"),
            .Kd = value("Kd"),
            .r = value("r"),
            .Ts = value("Ts")};
  }
  void start(State<Real>& s) const { s.d << control(s.u[0], s.v[0]), 1; }
  State<Real> exact(const Real& t) const { return exactBetweenSwitches(*this, t); }
  SceneFrame<Real> frame() const { return {.t_end = 1, .u = {{"x", "m", 1, 5}}}; }
  static SceneEntry entry() {
    return {.id = "sampled_control",
            .title = "oscillator under a sampled PD controller",
            .shows = "a digital controller: a discrete state that is set at fixed times",
            .collections = {"switching"},
            .parameters = {positiveParameter("m", "kg", "mass", "1"),
                           numberParameter("d", "N s/m", "damping", "0.5", 0, 1e15),
                           numberParameter("c", "N/m", "spring", "20", 0, 1e15),
                           numberParameter("Kp", "N/m", "proportional gain", "60", -1e15, 1e15),
                           numberParameter("Kd", "N s/m", "derivative gain", "5", -1e15, 1e15),
                           numberParameter("r", "m", "wanted position", "1", -1e6, 1e6),
                           positiveParameter("Ts", "s", "time between samples", "0.1")},
            .panels = {{"position", {"x"}}, {"velocity", {"x'"}}},
            .reference_cases = {{.times = "0.1 0.45"}}};
  }
};

}  // namespace

IRK_SCENE(SampledControl)
