// Air pollution: 25 reactions of 20 substances (Verwer). IVP test set, POLLU.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Pollution {
  std::array<Real, 26> k =
      decimals<Real>({"0",     "0.35",    "26.6",  "12300", "0.00086", "0.00082", "15000",   "0.00013", "24000",
                      "16500", "9000",    "0.022", "12000", "1.88",    "16300",   "4800000", "0.00035", "0.0175",
                      "1e8",   "4.44e11", "1240",  "2.1",   "5.78",    "0.0474",  "1780",    "3.12"});

  Sizes sizes() const { return {.nx = 20}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const auto y = [&](Index i) -> T { return p.x[i - 1]; };
    // The rates of the reactions 1 to 25.
    const std::array<T, 26> w = {T(0.0),
                                 k[1] * y(1),
                                 k[2] * (y(2) * y(4)),
                                 k[3] * (y(5) * y(2)),
                                 k[4] * y(7),
                                 k[5] * y(7),
                                 k[6] * (y(7) * y(6)),
                                 k[7] * y(9),
                                 k[8] * (y(9) * y(6)),
                                 k[9] * (y(11) * y(2)),
                                 k[10] * (y(11) * y(1)),
                                 k[11] * y(13),
                                 k[12] * (y(10) * y(2)),
                                 k[13] * y(14),
                                 k[14] * (y(1) * y(6)),
                                 k[15] * y(3),
                                 k[16] * y(4),
                                 k[17] * y(4),
                                 k[18] * y(16),
                                 k[19] * y(16),
                                 k[20] * (y(17) * y(6)),
                                 k[21] * y(19),
                                 k[22] * y(19),
                                 k[23] * (y(1) * y(4)),
                                 k[24] * (y(19) * y(1)),
                                 k[25] * y(20)};
    r.x[0] = -w[1] - w[10] - w[14] - w[23] - w[24] + w[2] + w[3] + w[9] + w[11] + w[12] + w[22] + w[25];
    r.x[1] = -w[2] - w[3] - w[9] - w[12] + w[1] + w[21];
    r.x[2] = -w[15] + w[1] + w[17] + w[19] + w[22];
    r.x[3] = -w[2] - w[16] - w[17] - w[23] + w[15];
    r.x[4] = -w[3] + 2 * w[4] + w[6] + w[7] + w[13] + w[20];
    r.x[5] = -w[6] - w[8] - w[14] - w[20] + w[3] + 2 * w[18];
    r.x[6] = -w[4] - w[5] - w[6] + w[13];
    r.x[7] = w[4] + w[5] + w[6] + w[7];
    r.x[8] = -w[7] - w[8];
    r.x[9] = -w[12] + w[7] + w[9];
    r.x[10] = -w[9] - w[10] + w[8] + w[11];
    r.x[11] = w[9];
    r.x[12] = -w[11] + w[10];
    r.x[13] = -w[13] + w[12];
    r.x[14] = w[14];
    r.x[15] = -w[18] - w[19] + w[16];
    r.x[16] = -w[20];
    r.x[17] = w[20];
    r.x[18] = -w[21] - w[22] - w[24] + w[23] + w[25];
    r.x[19] = -w[25] + w[24];
    r.x -= p.k;
  }
  void start(State<Real>& s) const {
    const auto set = [&](Index i, const char* value) { s.x[i - 1] = decimal<Real>(value); };
    set(2, "0.2");
    set(4, "0.04");
    set(7, "0.1");
    set(8, "0.3");
    set(9, "0.01");
    set(17, "0.007");
  }
  SceneFrame<Real> frame() const { return {.t_end = 60}; }
  static SceneEntry entry() {
    return {.id = "pollution",
            .title = "air pollution, 25 reactions of 20 substances",
            .shows = "moderate stiffness, components from 1e-18 to 1",
            .collections = {"ivp"},
            .literature = "IVP test set, POLLU; J. G. Verwer, SIAM J. Sci. Comput. 15 (1994) 1243-1250",
            .panels = {{"NO2, NO", {"y1", "y2"}},
                       {"O3", {"y4"}},
                       {"HO2, OH", {"y5", "y6"}, "1e-6", 1e6},
                       {"HCHO, CO", {"y7", "y8"}}},
            .reference_cases = {{.times = "1", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Pollution)
