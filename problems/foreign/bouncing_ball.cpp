// A ball that falls on a rigid floor, which returns a part of its speed. The impacts accumulate at a finite time.
#include <limits>

#include "irk/scene_file.h"

using namespace irk;

namespace {

// d = (number of impacts).
template <class Real>
struct BouncingBall {
  Real e, h0;                      // -, m
  Real g = decimal<Real>("9.81");  // m/s^2

  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -g - p.a[0];
  }
  // A ball that rises cannot strike.
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = p.v[0] < T(0.0) ? T(-p.u[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.d[0] + 1;
  }
  template <class T>
  void jump(Index, const Point<T>& p, T*, T* v, T*) const {
    v[0] = -e * p.v[0];
  }
  std::string switchName(Index) const { return "impact"; }
  static BouncingBall with(const Settings& values) { return {number<Real>(values, "e"), number<Real>(values, "h0")}; }
  void start(State<Real>& s) const { s.u[0] = h0; }
  // The flight between the impacts i and i + 1 lasts 2 e^i sqrt(2 h0 / g). From the accumulation of the impacts on
  // these equations have no solution.
  State<Real> exact(const Real& t) const {
    using std::sqrt;
    State<Real> s(sizes());
    s.t = t;
    s.w[0] = -g;
    const Real fall = sqrt(Real(2 * h0 / g));
    if (t <= fall) {
      s.u[0] = h0 - g * t * t / 2;
      s.v[0] = -g * t;
      return s;
    }
    Real begin = fall, speed = e * g * fall;
    for (s.d[0] = 1;; s.d[0] += 1) {
      const Real end = begin + 2 * speed / g;
      if (t <= end) break;
      if (end == begin || t >= fall * (1 + e) / (1 - e)) {
        for (auto* part : {&s.u, &s.v, &s.w}) part->setConstant(std::numeric_limits<Real>::infinity());
        return s;
      }
      begin = end;
      speed *= e;
    }
    const Real since = t - begin;
    s.u[0] = since * (speed - g * since / 2);
    s.v[0] = speed - g * since;
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 2, .u = {{"height", "m", 1, 5}}}; }
  static SceneEntry entry() {
    return {.id = "bouncing_ball",
            .title = "ball on a rigid floor",
            .shows = "a velocity that jumps, and impacts that accumulate",
            .collections = {"foreign"},
            .parameters = {numberParameter("e", "", "part of the speed that an impact returns", "0.8", 0.3, 0.95),
                           numberParameter("h0", "m", "height at the start", "1", 0.1, 10)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(BouncingBall)
