// A two-point control: a quantity of any magnitude is kept within a hysteresis that may be far smaller, as a
// temperature in kelvin or a pressure in pascal.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// d = (1 while the supply is on, 0 otherwise). The supply raises x by kRate hystereses per second, else x falls so;
// what exceeds the middle decays with kDecay.
template <class Real>
struct TwoPointControl {
  Real middle, width, begin;
  Real kDecay = decimal<Real>("0.3"), kRate = 1;  // 1/s

  Sizes sizes() const { return {.nx = 2, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = kRate * width * (2 * p.d[0] - 1) - kDecay * (p.x[0] - middle) - p.k[0];
    r.x[1] = p.d[0] - p.k[1];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = p.d[0] > T(0.5) ? T(p.x[0] - (middle + width / 2)) : T(middle - width / 2 - p.x[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1 - p.d[0];
  }
  std::string switchName(Index) const { return "control"; }
  static TwoPointControl with(const Settings& values) {
    return {number<Real>(values, "middle"), number<Real>(values, "width"), number<Real>(values, "begin")};
  }
  void start(State<Real>& s) const {
    s.x[0] = middle + begin * width;
    s.d[0] = 1;
  }
  // In hystereses above the middle, e approaches +-kRate / kDecay exponentially between the switches at +-1/2.
  State<Real> exact(const Real& t) const {
    using std::exp;
    using std::log;
    const Real limit = kRate / kDecay, half = Real(1) / 2;
    Real now = 0, e = begin, on = 0, running = 1;
    for (;;) {
      const Real to = running > 0 ? half : Real(-half), level = running > 0 ? limit : Real(-limit);
      const Real lasts = log(Real((level - e) / (level - to))) / kDecay;
      if (now + lasts > t) {
        State<Real> s(sizes());
        s.t = t;
        e = level + (e - level) * exp(Real(-kDecay * (t - now)));
        s.x << middle + width * e, on + running * (t - now);
        s.w << width * (kRate * (2 * running - 1) - kDecay * e), running;
        s.d[0] = running;
        return s;
      }
      now += lasts;
      on += running * lasts;
      e = to;
      running = 1 - running;
    }
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 10, .x = {{"level", "", static_cast<double>(middle)}, {"on", "s", 1}}};
  }
  static SceneEntry entry() {
    return {.id = "two_point_control",
            .title = "two-point control with hysteresis",
            .shows = "a switching function whose round-off may exceed its changes",
            .collections = {"foreign"},
            .parameters = {numberParameter("middle", "", "middle of the hysteresis", "300", 1, 1e7),
                           numberParameter("width", "", "width of the hysteresis", "0.5", 1e-8, 1),
                           numberParameter("begin", "", "start above the middle, in widths", "0.1", 0.05, 0.4)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(TwoPointControl)
