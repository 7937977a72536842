// Heat conduction in a rod whose conductivity grows with the temperature, 1 + u^2, in finite volumes:
// u_i' = N (F_{i+1/2} - F_{i-1/2}) + q_i(t), F_{i+1/2} = N (1 + ((u_i + u_{i+1}) / 2)^2) (u_{i+1} - u_i), N = n + 1,
// u = 0 at both ends. The source q makes u_i = sin(pi x_i) g(t), g = 1 + sin(5 t) / 2, x_i = i / N, the exact solution
// of these equations, for any n.
#include <memory>

#include "irk/scene_file.h"

using namespace irk;

namespace {

// The source is q_i = S_i g' + w S_i g - B_i g^3: with c = cos(pi / (2 N)), s = sin(pi / (2 N)), w = 4 N^2 s^2,
// B_i = N^2 c^2 s (sin(3 pi x_i) sin(3 pi / (2 N)) - S_i s). This is the sum of the differences of S and S^3, written
// without cancellation.
template <class Real>
struct Source {
  Vec<Real> S, B;
  Real w;

  explicit Source(Index n) : S(n), B(n) {
    using std::cos;
    using std::sin;
    const Real N(static_cast<double>(n + 1)), half = piOf<Real>() / (2 * N);
    const Real c = cos(half), s = sin(half), s3 = sin(Real(3 * half));
    w = 4 * N * N * s * s;
    for (Index i = 0; i < n; ++i) {
      const Real angle = 2 * half * Real(static_cast<double>(i + 1));
      S[i] = sin(angle);
      B[i] = N * N * c * c * s * (sin(Real(3 * angle)) * s3 - S[i] * s);
    }
  }
};

template <class Real>
struct Heat {
  Index n;
  std::shared_ptr<const Source<Real>> source;

  Sizes sizes() const { return {.nx = n}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const Real N = static_cast<double>(n + 1);
    const T g = 1 + 0.5 * sin(5 * p.t), rate = 2.5 * cos(5 * p.t);
    const T linear = rate + source->w * g, cubic = g * g * g;
    const auto flux = [N](const T& left, const T& right) {
      const T mean = 0.5 * (left + right);
      return T(N * ((1 + mean * mean) * (right - left)));
    };
    const T end(0.0);
    T before = flux(end, p.x[0]);
    for (Index i = 0; i < n; ++i) {
      const T after = flux(p.x[i], i + 1 < n ? p.x[i + 1] : end);
      r.x[i] = N * (after - before) + source->S[i] * linear - source->B[i] * cubic - p.k[i];
      before = after;
    }
  }
  static Heat with(const Settings& values) {
    const auto n = static_cast<Index>(number<double>(values, "n"));
    return {n, std::make_shared<const Source<Real>>(n)};
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    s.x = source->S * Real(1 + sin(Real(5 * t)) / 2);
    s.w = source->S * Real(cos(Real(5 * t)) * 5 / 2);
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = "", .x = numbered(n, "u")}; }
  static SceneEntry entry() {
    return {.id = "heat",
            .title = "heat conduction in a rod, conductivity 1 + u^2",
            .shows = "a parabolic equation: tridiagonal, nonlinear, exactly solvable, up to 200 000 unknowns",
            .collections = {"probes"},
            .size = {.parameter = "n", .unknowns = 1, .step = 1e-2},
            .parameters = {wholeParameter("n", "interior points = unknowns", "20", 3, 200000, 100)},
            .panels = {{"temperatures", {"u1", "u3"}}},
            .reference_cases = {{.times = "0.5"}}};
  }
};

}  // namespace

IRK_SCENE(Heat)
