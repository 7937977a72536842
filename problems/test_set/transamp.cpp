// The transistor amplifier (Rentrop). IVP test set, TRANSAMP; HW II (VI.1).
//
// The test set writes M y' = f with a singular M, whose rows are currents of five capacitors. Here x holds the voltages
// of the capacitors and z the other voltages. Sums of two rows in which y' cancels are the algebraic equations. The
// solution is the same.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct TransistorAmplifier {
  Real Ub = 6, UF = decimal<Real>("0.026"), alpha = decimal<Real>("0.99"), beta = decimal<Real>("1e-6");
  Real micro = decimal<Real>("1e-6"), amplitude = decimal<Real>("0.1"), pi = piOf<Real>();
  int R0 = 1000, R = 9000;

  Sizes sizes() const { return {.nx = 5, .nz = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    using std::sin;
    const T &y3 = p.x[1], &y6 = p.x[3], &y2 = p.z[0], &y5 = p.z[1], &y8 = p.z[2];
    const T y1 = p.x[0] + y2, y4 = p.x[2] + y5, y7 = p.x[4] + y8;
    const T Ue = amplitude * sin(200 * pi * p.t);
    const auto g = [&](const T& U) { return T(beta * (exp(U / UF) - 1)); };
    const T g1 = g(y2 - y3), g2 = g(y5 - y6);
    const T f1 = (y1 - Ue) / R0, f4 = (y4 - Ub) / R + alpha * g1, f7 = (y7 - Ub) / R + alpha * g2;
    r.x[0] = f1 + micro * p.k[0];
    r.x[1] = y3 / R - g1 + 2 * micro * p.k[1];
    r.x[2] = f4 + 3 * micro * p.k[2];
    r.x[3] = y6 / R - g2 + 4 * micro * p.k[3];
    r.x[4] = f7 + 5 * micro * p.k[4];
    r.z[0] = f1 + (2 * y2 - Ub) / R + (1 - alpha) * g1;
    r.z[1] = f4 + (2 * y5 - Ub) / R + (1 - alpha) * g2;
    r.z[2] = f7 + y8 / R;
  }
  void start(State<Real>& s) const {
    s.x << Real(-3), Real(3), Real(3), Real(3), Real(6);
    s.z() << Real(3), Real(3), Real(0);
  }
  // y_i is the sum of a capacitor's voltage and another voltage.
  static auto sum(const char* name, Index capacitor, Index other) {
    const auto value = [=](const State<Real>& s) { return Real(s.x[capacitor] + s.z()[other]); };
    return typename Scene<Real>::Output{name, value, "V"};
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 0.2,
            .x = named("V", {"y1-y2", "y3", "y4-y5", "y6", "y7-y8"}),
            .z = named("V", {"y2", "y5", "y8"}),
            .outputs = {sum("y1", 0, 0), sum("y4", 2, 1), sum("y7", 4, 2)}};
  }
  static SceneEntry entry() {
    return {.id = "transamp",
            .title = "amplifier with two transistors",
            .shows = "M y' = f with a singular M; exponentials, Newton near round-off",
            .collections = {"ivp"},
            .literature = "IVP test set, TRANSAMP; HW II (VI.1)",
            .kind = SceneKind::kIndex1,
            .panels = {{"input and output", {"y1", "y8"}}},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(TransistorAmplifier)
