// A mass on a spring and an ideally plastic slider in series, driven by a harmonic force.
//
// u = displacement of the mass, x = displacement of the slider.
#include "irk/regularised.h"
#include "irk/scene_file.h"
#include "problems/support/piecewise_linear.h"

using namespace irk;

namespace {

// d = (1 while the slider moves, 0 otherwise; sign of the force at the last yield, 0 before the first one).
enum Discrete : Index { kPlastic, kSide };
enum Switch : Index { kYieldsPositive, kYieldsNegative, kUnloads };

template <class Real>
struct Elastoplastic {
  Real m, k, Fy;   // kg, N/m, N
  Real P0, Omega;  // N, rad/s
  Real smoothing;  // relative to Fy

  Sizes sizes() const { return {.nu = 1, .nx = 1, .discrete = 2, .switches = 3}; }
  template <class T>
  T force(const Point<T>& p) const {
    return k * (p.u[0] - p.x[0]);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = P0 * sin(Omega * p.t) - force<T>(p) - m * p.a[0];
    r.x[0] = p.d[kPlastic] * p.v[0] - p.k[0];
  }

  // Yield is due when both `above`, the force beyond the yield limit, and the velocity `outwards` are positive. The
  // force alone does not decide: just after unloading it is at the limit up to round-off, but u' has turned.
  template <class T>
  T yields(const T& above, const T& outwards) const {
    return above < outwards ? above : outwards;
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const bool plastic = p.d[kPlastic] > T(0.0);
    const T F = force<T>(p);
    due[kYieldsPositive] = plastic ? T(-1.0) : yields<T>(F - Fy, p.v[0]);
    due[kYieldsNegative] = plastic ? T(-1.0) : yields<T>(-F - Fy, -p.v[0]);
    due[kUnloads] = plastic ? T(-p.d[kSide] * p.v[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[kPlastic] = T(i == kUnloads ? 0.0 : 1.0);
    if (i != kUnloads) d[kSide] = T(i == kYieldsPositive ? 1.0 : -1.0);
  }
  // Sets x such that the force is exactly +-Fy.
  template <class T>
  void snap(Index, const Point<T>& p, T*, T*, T* x) const {
    x[0] = p.u[0] - p.d[kSide] * (Fy / k);
  }
  // The slider starts to move before F reaches Fy. Its velocity is a fraction of u' that grows with F and with u'.
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    using std::sqrt;
    const T F = force<T>(p);
    const bool positive = F > T(0.0);
    const T size = positive ? F : T(-F), outwards = positive ? p.v[0] : T(-p.v[0]);
    const Real velocity = Fy / sqrt(k * m);  // kinetic energy at this velocity = energy of the spring at yield
    d[kPlastic] = smoothStep<T>((size / Fy - 1) / smoothing + 1) * smoothStep<T>(outwards / (smoothing * velocity));
  }
  // The matrix of (v', x') = rates (u, v, x, 1, sin Omega t, cos Omega t).
  Mat<Real> rates(const Vec<Real>& d) const {
    Mat<Real> rows(2, 6);
    rows << -k / m, 0, k / m, 0, P0 / m, 0,  //
        0, d[kPlastic], 0, 0, 0, 0;
    return rows;
  }
  std::string switchName(Index i) const {
    constexpr const char* kNames[] = {"yield at +Fy", "yield at -Fy", "unloading"};
    return kNames[i];
  }
  static Elastoplastic with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.m = value("m"),
            .k = value("k"),
            .Fy = value("Fy"),
            .P0 = value("P0"),
            .Omega = value("Omega"),
            .smoothing = value("smoothing")};
  }
  State<Real> exact(const Real& t) const { return exactBetweenSwitches(*this, t, Omega); }
  SceneFrame<Real> frame() const {
    const double yield = static_cast<double>(Real(Fy / k));
    return {.t_end = 1.8, .u = {{"u", "m", yield, 10 * yield}}, .x = {{"x", "m", yield}}};
  }
  static SceneEntry entry() {
    return {.id = "elastoplastic",
            .title = "driven mass on a spring and an ideal-plastic slider in series",
            .shows = "plasticity: history dependence, a rate that jumps, and a kink at every unloading",
            .collections = {"switching"},
            .parameters = {positiveParameter("m", "kg", "mass", "1"), positiveParameter("k", "N/m", "spring", "100"),
                           positiveParameter("Fy", "N", "yield force", "1"),
                           numberParameter("P0", "N", "amplitude of the load", "1.2", -1e15, 1e15),
                           positiveParameter("Omega", "rad/s", "frequency of the load", "5"),
                           smoothingParameter("", "part of Fy over which the slider starts to move", "1e-3")},
            .panels = {{"displacements", {"u", "x"}}, {"velocity", {"u'"}}},
            .reference_cases = {{.times = "0.5 1"}}};
  }
};

}  // namespace

IRK_SCENE(Elastoplastic)
