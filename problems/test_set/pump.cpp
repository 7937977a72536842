// A charge pump: one field-effect transistor and two capacitors (Guenther, Denk, Feldmann). IVP test set, PUMP.
//
// The test set's y2' + y3' = 0 and y4' + y5' = 0 are rows for the sums of charges x[1] and x[2]; its time is counted in
// ns here. The input has slopes of 2 V/ns as in the test set's program; its report prints 20.
#include <cmath>

#include "irk/scene_file.h"

namespace irk {
namespace {

template <class Real>
struct ChargePump {
  static constexpr int kAlgebraicIndex = 2;  // y9; y2 to y8 have index 1
  Real CD = decimal<Real>("0.4e-12"), CS = decimal<Real>("1.6e-12"), Cox = decimal<Real>("4e-12");
  Real UT0 = decimal<Real>("0.2"), gamma = decimal<Real>("0.035"), phi = decimal<Real>("1.01");
  Real nano = decimal<Real>("1e-9");

  Sizes sizes() const { return {.nx = 3, .nz = 6, .discrete = 2}; }
  // Kinks of the input d[0] + d[1] t: ten times 0, up, 20 V, down.
  std::vector<Real> times() const {
    std::vector<Real> t;
    for (int period = 0; period < 1200; period += 120) {
      for (const int at : {50, 60, 110, 120}) t.push_back(Real(period + at));
    }
    return t;
  }
  template <class T>
  void onTime(Index i, const Point<T>& p, T* d) const {
    const Index piece = (i + 1) % 4;
    const double rate = piece == 1 ? 2 : piece == 3 ? -2 : 0, begin = piece >= 2 ? 20 : 0;
    d[0] = begin - rate * p.t;
    d[1] = T(rate);
  }

  template <class T>
  struct Charges {
    T gate, channel;  // QG; QS = QD
  };
  template <class T>
  Charges<T> charges(const T& v1, const T& vgs, const T& vgd) const {
    using std::sqrt;
    const bool swapped = !(vgd < vgs);
    const T &ugs = swapped ? vgd : vgs, &ugd = swapped ? vgs : vgd, depth = phi + v1 - ugs;
    const T flat = v1 - (UT0 - gamma * sqrt(phi) - phi);
    if (!(flat > T(0.0))) return {Cox * flat, T(0.0)};
    const T threshold = UT0 + gamma * (sqrt(depth) - sqrt(phi)), a = ugs - threshold;
    if (!(a > T(0.0))) return {Cox * gamma * (sqrt(gamma * gamma / 4 + flat) - gamma / 2), T(0.0)};
    const T b = ugd > threshold ? T(ugd - threshold) : T(0.0), sum = a + b - a * b / (a + b);
    return {Cox * (2 * sum / 3 + gamma * sqrt(depth)), -Cox / 3 * sum};
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y2 = p.z[0], &y4 = p.z[1], &y6 = p.z[2], &y7 = p.z[3], &y8 = p.z[4], &y9 = p.z[5];
    const Charges<T> Q = charges<T>(y6, y6 - y7, y6 - y8);
    r.x[0] = -nano * y9 - p.k[0];
    r.x[1] = -p.k[1];
    r.x[2] = -p.k[2];
    r.z[0] = p.d[0] + p.d[1] * p.t - y6;
    r.z[1] = p.x[0] - Q.gate;
    r.z[2] = y2 - CS * y7;
    r.z[3] = p.x[1] - y2 - Q.channel;
    r.z[4] = y4 - CD * y8;
    r.z[5] = p.x[2] - y4 - Q.channel;
  }
};

template <class Real>
Scene<Real> make(const Settings&) {
  const ChargePump<Real> problem{};
  Scene<Real> scene;
  setProblem(scene, problem);
  scene.start.x[0] = problem.charges(Real(0), Real(0), Real(0)).gate;
  completeStart(scene);
  scene.t_end = 1200;
  scene.time_unit = "ns";
  // As in the test set: the tolerances of charges are 1e-6 of those of voltages.
  setComponents(scene, {}, {{"y1", "C", 1e-6}, {"y2+y3", "C", 1e-6}, {"y4+y5", "C", 1e-6}},
                {{"y2", "C", 1e-6}, {"y4", "C", 1e-6}, {"y6", "V"}, {"y7", "V"}, {"y8", "V"}, {"y9", "A"}});
  scene.outputs = {{"y3", [](const State<Real>& s) { return Real(s.x[1] - s.z()[0]); }, "C"},
                   {"y5", [](const State<Real>& s) { return Real(s.x[2] - s.z()[1]); }, "C"}};
  return scene;
}

}  // namespace

SceneEntry pumpEntry() {
  return {.id = "pump",
          .title = "charge pump: a transistor and two capacitors",
          .shows = "index 2; kinks at known times and where the transistor changes its region",
          .kind = SceneKind::kIndex2,
          .parameters = {},
          .panels = {{"voltages", {"y6", "y7", "y8"}}, {"charges", {"y1", "y2", "y4"}}},
          .reference_cases = {{.tolerance = kFewDigits}},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
