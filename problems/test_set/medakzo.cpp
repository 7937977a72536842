// The medical Akzo Nobel problem: antibodies penetrate a tissue, in finite differences. IVP test set, MEDAKZO.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// x = (u_1, v_1, ..., u_N, v_N) at zeta_j = j / N. d[0]: the concentration u_0 at the edge, 2 until t = 5, then 0.
template <class Real>
struct MedicalAkzo {
  Index N;

  Sizes sizes() const { return {.nx = 2 * N, .discrete = 1}; }
  bool nonNegative(Index) const { return true; }
  std::vector<Real> times() const { return {Real(5)}; }
  template <class T>
  void onTime(Index, const Point<T>&, T* d) const {
    d[0] = T(0.0);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const Real n = static_cast<double>(N);
    for (Index j = 1; j <= N; ++j) {
      const T &u = p.x[2 * j - 2], &v = p.x[2 * j - 1], reaction = 100 * (u * v);
      T transport(0.0);
      if (j < N) {
        const Real z = static_cast<double>(j) / n - 1, cube = z * z * z / 16;  // c = 4
        const T &before = j > 1 ? p.x[2 * j - 4] : p.d[0], &after = p.x[2 * j];
        transport = (cube * n) * (after - before) + (cube * z * n * n) * ((before - u) + (after - u));
      }
      r.x[2 * j - 2] = transport - reaction - p.k[2 * j - 2];
      r.x[2 * j - 1] = -reaction - p.k[2 * j - 1];
    }
  }
  static MedicalAkzo with(const Settings& values) { return {static_cast<Index>(number<double>(values, "N"))}; }
  void start(State<Real>& s) const {
    for (Index j = 1; j <= N; ++j) s.x[2 * j - 1] = Real(1);
    s.d[0] = Real(2);
  }
  SceneFrame<Real> frame() const {
    SceneFrame<Real> frame{.t_end = 20};
    for (Index j = 1; j <= N; ++j) {
      for (const char* name : {"u", "v"}) frame.x.push_back({name + std::to_string(j)});
    }
    return frame;
  }
  static SceneEntry entry() {
    return {.id = "medakzo",
            .title = "medical Akzo Nobel: reaction and diffusion in a tissue",
            .shows = "400 unknowns in a band; an input that jumps at t = 5",
            .collections = {"ivp"},
            .literature = "IVP test set, MEDAKZO",
            .size = {.parameter = "N", .unknowns = 2, .step = 1e-2},
            .parameters = {wholeParameter("N", "points of the grid", "200", 3, 20000, 40)},
            .panels = {{"antibodies", {"u3", "u50", "u100"}}, {"substrate", {"v50", "v100", "v150"}}},
            .reference_cases = {{.times = "5", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(MedicalAkzo)
