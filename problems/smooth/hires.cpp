// HIRES: high irradiance responses of photomorphogenesis, Schaefer (1975). HW II (IV.10).
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Hires {
  Real c171 = decimal<Real>("1.71"), c043 = decimal<Real>("0.43"), c832 = decimal<Real>("8.32");
  Real c0007 = decimal<Real>("0.0007"), c10_03 = decimal<Real>("10.03");
  Real c0035 = decimal<Real>("0.035"), c112 = decimal<Real>("1.12");
  Real c069 = decimal<Real>("0.69"), c181 = decimal<Real>("1.81"), c1745 = decimal<Real>("1.745");

  Sizes sizes() const { return {.nu = 0, .nx = 8, .nz = 0, .constraints = 0}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const auto& y = p.x;
    const T binding = 280 * (y[5] * y[7]);
    r.x[0] = -c171 * y[0] + c043 * y[1] + c832 * y[2] + c0007 - p.k[0];
    r.x[1] = c171 * y[0] - 8.75 * y[1] - p.k[1];
    r.x[2] = -c10_03 * y[2] + c043 * y[3] + c0035 * y[4] - p.k[2];
    r.x[3] = c832 * y[1] + c171 * y[2] - c112 * y[3] - p.k[3];
    r.x[4] = -c1745 * y[4] + c043 * y[5] + c043 * y[6] - p.k[4];
    r.x[5] = -binding + c069 * y[3] + c171 * y[4] - c043 * y[5] + c069 * y[6] - p.k[5];
    r.x[6] = binding - c181 * y[6] - p.k[6];
    r.x[7] = c181 * y[6] - binding - p.k[7];
  }
  void start(State<Real>& s) const {
    s.x[0] = Real(1);
    s.x[7] = decimal<Real>("0.0057");
  }
  // As in HW II (IV.10): Atol = 1e-4 Rtol.
  SceneFrame<Real> frame() const { return {.t_end = 321.8122, .x = numbered(8, "y", "", 1e-4)}; }
  static SceneEntry entry() {
    return {.id = "hires",
            .title = "HIRES, eight chemical reactions of plant physiology",
            .shows = "a moderately stiff ODE of the standard test sets",
            .collections = {"ivp"},
            .literature = "IVP test set, HIRES; HW II (IV.10)",
            .reference_cases = {
                {.times = "5 32.18122 64.36244 80 96.54366 128.72488 160.9061 193.08732 225.26854 257.44976 289.63098",
                 .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Hires)
