// A spiral whose growth rate t - turn rises through zero, a delayed loss of stability: its radius falls from 1 to
// e^(-turn^2 / 2), far below any tolerance, and is 1 again at t = 2 turn.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct SlowPassage {
  Real turn, frequency;

  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T growth = p.t - turn;
    r.x[0] = growth * p.x[0] - frequency * p.x[1] - p.k[0];
    r.x[1] = frequency * p.x[0] + growth * p.x[1] - p.k[1];
  }
  static SlowPassage with(const Settings& values) {
    return {number<Real>(values, "turn"), number<Real>(values, "frequency")};
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::exp;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    const Real radius = exp(Real(t * (t / 2 - turn))), angle = frequency * t, growth = t - turn;
    s.x[0] = radius * cos(angle);
    s.x[1] = radius * sin(angle);
    s.w[0] = growth * s.x[0] - frequency * s.x[1];
    s.w[1] = frequency * s.x[0] + growth * s.x[1];
    return s;
  }
  SceneFrame<Real> frame() const {
    return {.t_end = static_cast<double>(2 * turn), .time_unit = "", .x = {{"x"}, {"y"}}};
  }
  static SceneEntry entry() {
    return {.id = "slow_passage",
            .title = "spiral with the growth rate t - turn, a delayed loss of stability",
            .shows = "components that fall far below the tolerance and come back",
            .collections = {"foreign"},
            .parameters = {numberParameter("turn", "", "time at which the growth rate is zero", "4", 1, 9),
                           numberParameter("frequency", "", "angle per unit of time", "3", 0.5, 30)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(SlowPassage)
