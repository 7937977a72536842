// A NAND gate of three field-effect transistors (Guenther, Rentrop): C(y) y' = f(t, y). IVP test set, NAND.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// d[0] + d[1] t and d[2] + d[3] t are the inputs V1 and V2, whose kinks are at 5, 10, ..., 75 ns.
enum Input : Index { kV1, kRate1, kV2, kRate2 };

/// Depletion or enhancement transistor.
template <class Real>
struct Transistor {
  Real threshold, gamma, phi, beta, beta_back;  // beta_back: of currents from source to drain

  template <class T>
  T current(const T& UDS, const T& UGS, const T& UBS, const T& UGD, const T& UBD) const {
    return UDS < T(0.0) ? T(-forward(T(-UDS), UGD, UBD, beta_back)) : forward(UDS, UGS, UBS, beta);
  }
  template <class T>
  T forward(const T& UDS, const T& UG, const T& UB, const Real& strength) const {
    using std::sqrt;
    const T x = UG - threshold - gamma * (sqrt(phi - UB) - sqrt(phi));
    if (!(x > T(0.0))) return T(0.0);
    const T square = x < UDS ? T(x * x) : T(UDS * (2 * x - UDS));
    return -strength * square * (1 + UDS / 50);
  }
};

template <class Real>
struct NandGate {
  Transistor<Real> D, E;
  Real CG = decimal<Real>("0.6e-4"), C0 = decimal<Real>("0.24e-4"), CN = decimal<Real>("0.5e-4");
  Real phiB = decimal<Real>("0.87"), iS = decimal<Real>("1e-14"), UT = decimal<Real>("25.85");
  double RG = 4, RB = 10, VDD = 5, VBB = -2.5;

  Sizes sizes() const { return {.nx = 14, .discrete = 4}; }
  std::vector<Real> times() const {
    std::vector<Real> t;
    for (int i = 1; i <= 15; ++i) t.push_back(Real(5 * i));
    return t;
  }
  template <class T>
  void onTime(Index i, const Point<T>&, T* d) const {
    // Corners are at 0, 5, 10, ... An input is 0 V at `half` corners, then 5 V at as many, and so on.
    const auto begin = [i](T* line, Index half) {
      const auto at = [half](Index corner) { return corner / half % 2 == 1 ? 5.0 : 0.0; };
      const double value = at(i + 1), rate = (at(i + 2) - value) / 5;
      line[0] = T(value - rate * 5 * static_cast<double>(i + 1));
      line[1] = T(rate);
    };
    begin(d + kV1, 2);
    begin(d + kV2, 4);
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    using std::sqrt;
    const auto y = [&](Index i) -> T { return p.x[i - 1]; };
    const auto k = [&](Index i) -> T { return p.k[i - 1]; };
    const auto C = [&](const T& U) { return U > T(0.0) ? T(C0 * (1 + U / (2 * phiB))) : T(C0 / sqrt(1 - U / phiB)); };
    const auto iB = [&](const T& U) { return U > T(0.0) ? T(0.0) : T(-iS * (exp(U / UT) - 1)); };
    const T V1 = p.d[kV1] + p.d[kRate1] * p.t, V2 = p.d[kV2] + p.d[kRate2] * p.t;
    const T &V1rate = p.d[kRate1], &V2rate = p.d[kRate2];
    const T U4 = y(4) - VDD;
    const T I1 = D.current(T(y(2) - y(1)), T(y(5) - y(1)), T(y(3) - y(5)), T(y(5) - y(2)), U4);
    const T I2 = E.current(T(y(7) - y(6)), T(V1 - y(6)), T(y(8) - y(10)), T(V1 - y(7)), T(y(9) - y(5)));
    const T I3 = E.current(T(y(12) - y(11)), T(V2 - y(11)), y(13), T(V2 - y(12)), T(y(14) - y(10)));
    // The charging currents and the diodes of the bulks, from nodes 3, 4, 8, 9, 13, 14.
    const T U3 = y(3) - y(5), U8 = y(8) - y(10), U9 = y(9) - y(5), U14 = y(14) - y(10);
    const T q3 = C(U3) * (k(3) - k(5)), q9 = C(U9) * (k(9) - k(5)), q8 = C(U8) * (k(8) - k(10));
    const T q14 = C(U14) * (k(14) - k(10)), i3 = iB(U3), i9 = iB(U9), i8 = iB(U8), i14 = iB(U14);
    const T q1 = CG * (k(1) - k(5)), q2 = CG * (k(2) - k(5));
    const auto bulk = [&](Index i) { return T((y(i) - VBB) / RB); };
    r.x[0] = -(y(1) - y(5)) / RG - I1 - q1;
    r.x[1] = -(y(2) - VDD) / RG + I1 - q2;
    r.x[2] = i3 - bulk(3) - q3;
    r.x[3] = iB(U4) - bulk(4) - C(U4) * k(4);
    r.x[4] = -(y(5) - y(1)) / RG - i3 - (y(5) - y(7)) / RG - i9 - (CN * k(5) - q1 - q2 - q3 - q9);
    r.x[5] = -(y(6) - y(10)) / RG - I2 - CG * (k(6) - V1rate);
    r.x[6] = -(y(7) - y(5)) / RG + I2 - CG * (k(7) - V1rate);
    r.x[7] = i8 - bulk(8) - q8;
    r.x[8] = i9 - bulk(9) - q9;
    r.x[9] = -(y(10) - y(6)) / RG - i8 - (y(10) - y(12)) / RG - i14 - (CN * k(10) - q8 - q14);
    r.x[10] = -y(11) / RG - I3 - CG * (k(11) - V2rate);
    r.x[11] = -(y(12) - y(10)) / RG + I3 - CG * (k(12) - V2rate);
    r.x[12] = iB(y(13)) - bulk(13) - C(y(13)) * k(13);
    r.x[13] = i14 - bulk(14) - q14;
  }
  static NandGate with(const Settings& values) {
    const auto c = [](const char* text) { return decimal<Real>(text); };
    return {.D = {c("-2.43"), c("0.2"), c("1.28"), c("5.35e-4"), c("5.35e-4")},
            .E = {c("0.2"), c("0.035"), c("1.01"), c("1.748e-3"), number<Real>(values, "beta_back")}};
  }
  void start(State<Real>& s) const {
    const Real high = 5, low = -2.5, middle = decimal<Real>("3.62385");
    s.x << high, high, low, low, high, middle, high, low, low, middle, Real(0), middle, low, low;
  }
  SceneFrame<Real> frame() const { return {.t_end = 80, .time_unit = "ns", .x = numbered(14, "y", "V")}; }
  static SceneEntry entry() {
    return {
        .id = "nand",
        .title = "NAND gate of three field-effect transistors",
        .shows = "capacitances that depend on y; fifteen kinks of the inputs at known times",
        .collections = {"ivp"},
        .literature = "IVP test set, NAND",
        .parameters = {numberParameter("beta_back", "mA/V^2",
                                       "factor of an enhancement transistor's current from source to drain; the report "
                                       "of the test set has 1.748e-3, its program the default",
                                       "1.748e-4", 0, 1)},
        .panels = {{"output", {"y5"}}},
        .reference_cases = {{.tolerance = kFewDigits}, {.settings = "beta_back=1.748e-3", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(NandGate)
