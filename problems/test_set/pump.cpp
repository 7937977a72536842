// A charge pump: one field-effect transistor and two capacitors (Guenther, Denk, Feldmann). IVP test set, PUMP.
//
// In ns, V, pC, pF, mA instead of the test set's s, V, C, F, A: all numbers are about 1. Its y2' + y3' = 0 and
// y4' + y5' = 0 are rows for the sums of charges x[1] and x[2]. The input has slopes of 2 V/ns as in the test set's
// program; its report prints 20.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// d = (begin and rate of the present piece of the input; 1 while the transistor has a channel, 0 otherwise). The gate
// voltage is never below that of flat bands, so that this third region of the transistor is left out.
enum Discrete : Index { kBegin, kRate, kOn };

template <class Real>
struct ChargePump {
  static constexpr int kAlgebraicIndex = 2;  // y9; y2 to y8 have index 1
  Real CD = decimal<Real>("0.4"), CS = decimal<Real>("1.6");
  Real Cox = 4;
  Real UT0 = decimal<Real>("0.2"), gamma = decimal<Real>("0.035"), phi = decimal<Real>("1.01");

  Sizes sizes() const { return {.nx = 3, .nz = 6, .discrete = 3, .switches = 1}; }
  // Kinks of the input d[kBegin] + d[kRate] t. Ten times in turn it is 0, rises, is 20 V, and falls.
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
    d[kBegin] = begin - rate * p.t;
    d[kRate] = T(rate);
  }

  // The voltages of the gate over source and drain, less the threshold. On the solution y8 = 4 y7 >= 0, so that
  // source and drain never exchange their roles.
  template <class T>
  struct Voltages {
    T source, drain, depth;
  };
  template <class T>
  Voltages<T> voltages(const Point<T>& p) const {
    using std::sqrt;
    const T &y6 = p.z[2], &y7 = p.z[3], &y8 = p.z[4];
    const T depth = phi + y7, threshold = UT0 + gamma * (sqrt(depth) - sqrt(phi));
    return {y6 - y7 - threshold, y6 - y8 - threshold, depth};
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    const T a = voltages(p).source;
    g[0] = p.d[kOn] > T(0.0) ? T(-a) : a;
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[kOn] = 1 - p.d[kOn];
  }
  std::string switchName(Index) const { return "channel"; }

  template <class T>
  T gateWithoutChannel(const T& y6) const {
    using std::sqrt;
    return Cox * gamma * (sqrt(gamma * gamma / 4 + y6 - UT0 + gamma * sqrt(phi) + phi) - gamma / 2);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T &y2 = p.z[0], &y4 = p.z[1], &y6 = p.z[2], &y7 = p.z[3], &y8 = p.z[4], &y9 = p.z[5];
    const auto [a, b, depth] = voltages(p);
    T gate = gateWithoutChannel(y6), channel(0.0);  // QG; QS = QD
    if (p.d[kOn] > T(0.0)) {
      // Trial steps beyond the switch, where a < 0, follow the equations of a channel that is pinched off, b <= 0.
      const T sum = a > T(0.0) && b > T(0.0) ? T(a + b - a * b / (a + b)) : a;
      gate = Cox * (2 * sum / 3 + gamma * sqrt(depth));
      channel = -Cox / 3 * sum;
    }
    r.x[0] = -y9 - p.k[0];
    r.x[1] = -p.k[1];
    r.x[2] = -p.k[2];
    r.z[0] = p.d[kBegin] + p.d[kRate] * p.t - y6;
    r.z[1] = p.x[0] - gate;
    r.z[2] = y2 - CS * y7;
    r.z[3] = p.x[1] - y2 - channel;
    r.z[4] = y4 - CD * y8;
    r.z[5] = p.x[2] - y4 - channel;
  }
  void start(State<Real>& s) const { s.x[0] = gateWithoutChannel(Real(0)); }
  SceneFrame<Real> frame() const {
    return {.t_end = 1200,
            .time_unit = "ns",
            .x = named("pC", {"y1", "y2+y3", "y4+y5"}),
            .z = {{"y2", "pC"}, {"y4", "pC"}, {"y6", "V"}, {"y7", "V"}, {"y8", "V"}, {"y9", "mA"}},
            .outputs = {{"y3", [](const State<Real>& s) { return Real(s.x[1] - s.z()[0]); }, "pC"},
                        {"y5", [](const State<Real>& s) { return Real(s.x[2] - s.z()[1]); }, "pC"}}};
  }
  static SceneEntry entry() {
    return {.id = "pump",
            .title = "charge pump: a transistor and two capacitors",
            .shows = "index 2; kinks at known times and where the transistor changes its region",
            .collections = {"ivp", "switching"},
            .literature = "IVP test set, PUMP",
            .kind = SceneKind::kIndex2,
            .panels = {{"voltages", {"y6", "y7", "y8"}}, {"charges", {"y1", "y2", "y4"}}},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(ChargePump)
