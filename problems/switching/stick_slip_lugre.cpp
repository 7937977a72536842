// Stick-slip with bristles: the LuGre friction model of Canudas de Wit, Olsson, Astrom & Lischinsky (1995).
//
// u = X, position of the mass; x = Z, mean deflection of the bristles. The mass is pulled by a spring whose other end
// moves at the speed vb.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct LuGre {
  Real M, K, vb;                // kg, N/m, m/s
  Real sigma0, sigma1, sigma2;  // N/m, N s/m, N s/m
  Real Fc, Fs, Vs;              // N, N, m/s

  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::abs;
    using std::exp;
    const T& V = p.v[0];
    const T& Z = p.x[0];
    const T ratio = V / Vs;
    const T G = (Fc + (Fs - Fc) * exp(-ratio * ratio)) / sigma0;
    const T Z_rate = V - Z * abs(V) / G;
    const T F_L = sigma0 * Z + sigma1 * Z_rate + sigma2 * V;
    r.u[0] = K * (vb * p.t - p.u[0]) - F_L - M * p.a[0];
    r.x[0] = Z_rate - p.k[0];
  }
  static LuGre with(const Settings& values) {
    using std::sqrt;
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Real sigma0 = value("sigma0");
    return {.M = value("M"),
            .K = value("K"),
            .vb = value("vb"),
            .sigma0 = sigma0,
            .sigma1 = values.at("sigma1") == "sqrt(sigma0)" ? Real(sqrt(sigma0)) : value("sigma1"),
            .sigma2 = value("sigma2"),
            .Fc = value("Fc"),
            .Fs = value("Fs"),
            .Vs = value("Vs")};
  }
  SceneFrame<Real> frame() const {
    const double bristle = static_cast<double>(Real(Fs / sigma0));
    // Friction falls within the velocity Vs, and the mass creeps far more slowly before it slips: an error of a tenth
    // of Vs changes the time of slip. vb is a hundred times as large and would be too coarse a scale.
    const double slow = static_cast<double>(Vs);
    return {.t_end = 25, .u = {{"X", "m", 1, slow}}, .x = {{"Z", "m", bristle}}};
  }
  static SceneEntry entry() {
    return {.id = "stick_slip_lugre",
            .title = "mass pulled over a surface with bristles (LuGre friction)",
            .shows = "stick-slip without switches: smooth and very stiff",
            .collections = {"switching"},
            .parameters = {positiveParameter("M", "kg", "mass", "1"), positiveParameter("K", "N/m", "spring", "2"),
                           numberParameter("vb", "m/s", "speed of the spring's other end", "0.1", -1e3, 1e3),
                           positiveParameter("sigma0", "N/m", "stiffness of the bristles", "1e5"),
                           numberParameter("sigma1", "N s/m", "damping of the bristles", "sqrt(sigma0)", 0, 1e15),
                           numberParameter("sigma2", "N s/m", "viscous friction", "0.4", 0, 1e15),
                           positiveParameter("Fc", "N", "Coulomb friction", "1"),
                           positiveParameter("Fs", "N", "largest sticking force", "1.5"),
                           positiveParameter("Vs", "m/s", "velocity over which friction falls from Fs to Fc", "0.001")},
            .panels = {{"position", {"X"}}, {"velocity", {"X'"}}, {"deflection of the bristles", {"Z"}, "µm", 1e6}},
            .reference_cases = {{.times = "2.5 5 7.5 10 12.5 15 17.5 20 22.5"}}};
  }
};

}  // namespace

IRK_SCENE(LuGre)
