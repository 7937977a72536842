// The ring modulator: a low-frequency signal mixed with a high-frequency one (Horneber). IVP test set, RINGMOD.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// Cs = 0: the voltages y3 to y6 of the diodes are algebraic, x = (y1, y2, y7, ..., y15). Kirchhoff's law for the four
// nodes implies y10 + y11 + y12 + y13 = 0, a constraint of index 2.
template <class Real>
struct RingModulator {
  static constexpr int kAlgebraicIndex = 2;
  Real Cs;
  Real C = decimal<Real>("1.6e-8"), Cp = decimal<Real>("1e-8"), Lh = decimal<Real>("4.45");
  Real Ls1 = decimal<Real>("0.002"), Ls2 = decimal<Real>("5e-4"), Ls3 = decimal<Real>("5e-4");
  Real gamma = decimal<Real>("40.67286402e-9"), delta = decimal<Real>("17.7493332"), Rg1 = decimal<Real>("36.3");
  Real Rg2 = decimal<Real>("17.3"), Rg3 = Rg2, pi = piOf<Real>();
  int R = 25000, Rp = 50, Ri = 50, Rc = 600;

  bool algebraic() const { return Cs == Real(0); }
  Sizes sizes() const { return algebraic() ? Sizes{.nx = 11, .nz = 4} : Sizes{.nx = 15}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    using std::sin;
    const bool z = algebraic();
    const auto row = [z](Index i) { return i <= 2 || !z ? i - 1 : i - 5; };  // of y_i among x
    const auto y = [&](Index i) -> T { return z && i >= 3 && i <= 6 ? p.z[i - 3] : p.x[row(i)]; };
    const auto diode = [&](const T& U) { return T(gamma * (exp(delta * U) - 1)); };
    const T in1 = 0.5 * sin(2000 * pi * p.t), in2 = 2 * sin(20000 * pi * p.t);
    const T q1 = diode(y(3) - y(5) - y(7) - in2), q2 = diode(y(6) - y(4) - y(7) - in2);
    const T q3 = diode(y(4) + y(5) + y(7) + in2), q4 = diode(y(7) - y(3) - y(6) + in2);
    const std::array<T, 4> current = {y(10) - q1 + q4, q2 - q3 - y(11), y(12) + q1 - q3, q4 - y(13) - q2};
    r.x[row(1)] = (y(8) - 0.5 * y(10) + 0.5 * y(11) + y(14) - y(1) / R) / C;
    r.x[row(2)] = (y(9) - 0.5 * y(12) + 0.5 * y(13) + y(15) - y(2) / R) / C;
    for (Index i = 0; i < 4; ++i) {
      const T& I = current[static_cast<std::size_t>(i)];
      (z ? r.z[i] : r.x[2 + i]) = z ? I : T(I / Cs);
    }
    r.x[row(7)] = (q1 + q2 - q3 - q4 - y(7) / Rp) / Cp;
    r.x[row(8)] = -y(1) / Lh;
    r.x[row(9)] = -y(2) / Lh;
    r.x[row(10)] = (0.5 * y(1) - y(3) - Rg2 * y(10)) / Ls2;
    r.x[row(11)] = (y(4) - 0.5 * y(1) - Rg3 * y(11)) / Ls3;
    r.x[row(12)] = (0.5 * y(2) - y(5) - Rg2 * y(12)) / Ls2;
    r.x[row(13)] = (y(6) - 0.5 * y(2) - Rg3 * y(13)) / Ls3;
    r.x[row(14)] = (in1 - y(1) - (Ri + Rg1) * y(14)) / Ls1;
    r.x[row(15)] = (-y(2) - (Rc + Rg1) * y(15)) / Ls1;
    r.x -= p.k;
  }
  static RingModulator with(const Settings& values) { return {.Cs = number<Real>(values, "Cs")}; }
  SceneFrame<Real> frame() const {
    SceneFrame<Real> frame{.t_end = 1e-3, .x = numbered(15)};
    if (!algebraic()) return frame;
    frame.z.assign(frame.x.begin() + 2, frame.x.begin() + 6);
    frame.x.erase(frame.x.begin() + 2, frame.x.begin() + 6);
    return frame;
  }
  static SceneEntry entry() {
    return {
        .id = "ringmod",
        .title = "ring modulator: four diodes mix two signals",
        .shows = "fast oscillation and stiffness at once; index 2 with Cs = 0",
        .collections = {"ivp"},
        .literature = "IVP test set, RINGMOD",
        .parameters = {numberParameter("Cs", "F", "parasitic capacitance of the diodes; 0: index 2", "2e-12", 0, 1)},
        .panels = {{"signal y1", {"y1"}}, {"output y2", {"y2"}}, {"diode y3", {"y3"}}, {"carrier y7", {"y7"}}},
        .reference_cases = {{.tolerance = kFewDigits}, {.settings = "Cs=0", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(RingModulator)
