// E5: a chemical pyrolysis to t = 1e13 (Enright, Hull, Lindberg). IVP test set, E5; HW II (IV.10).
//
// y3' is written as y2' - y4': then y2 = y3 + y4 holds up to the round-off of these small numbers. The end values that
// are printed in the IVP test set are wrong from the third digit on: they contradict this sum.
#include "problems/support/numbered.h"

namespace irk {
namespace {

// Of the smallest component that matters: y3 falls to 9e-23. The codes of the test set are run with atol = 1.7e-24.
constexpr double kScale = 1.7e-24;

template <class Real>
struct E5 {
  Real A = decimal<Real>("7.89e-10"), B = decimal<Real>("1.1e7"), CM = decimal<Real>("1.13e9");
  Real C = decimal<Real>("1.13e3");

  Sizes sizes() const { return {.nx = 4}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T decay = A * p.x[0], first = B * (p.x[0] * p.x[2]);
    r.x[0] = -decay - first - p.k[0];
    r.x[1] = decay - CM * (p.x[1] * p.x[2]) - p.k[1];
    r.x[2] = p.k[1] - p.k[3] - p.k[2];
    r.x[3] = first - C * p.x[3] - p.k[3];
  }
};

template <class Real>
Scene<Real> make(const Settings&) {
  Scene<Real> scene;
  setProblem(scene, E5<Real>{});
  scene.start.x[0] = decimal<Real>("1.76e-3");
  completeStart(scene);
  scene.t_end = 1e13;
  setComponents(scene, {}, numbered(4, "", kScale));
  return scene;
}

}  // namespace

SceneEntry e5Entry() {
  return {.id = "e5",
          .title = "E5: chemical pyrolysis to t = 1e13",
          .shows = "components down to 1e-22 over thirteen decades of time, cancellation",
          .parameters = {},
          .reference_cases = {{.times = "10 1e5 1e9 1e11"}},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
