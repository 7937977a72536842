// The chemical Akzo Nobel problem: two substances are mixed under a flow of carbon dioxide. IVP test set, CHEMAKZO.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct ChemicalAkzo {
  Real k1 = decimal<Real>("18.7"), k2 = decimal<Real>("0.58"), k3 = decimal<Real>("0.09"), k4 = decimal<Real>("0.42");
  Real K = decimal<Real>("34.4"), kla = decimal<Real>("3.3"), Ks = decimal<Real>("115.83");
  Real inflow = decimal<Real>("0.9") / 737;

  Sizes sizes() const { return {.nx = 5, .nz = 1}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T &y1 = p.x[0], &y2 = p.x[1], &y3 = p.x[2], &y4 = p.x[3], &y5 = p.x[4], &y6 = p.z[0];
    const T root = sqrt(y2), square = y1 * y1;
    const T r1 = k1 * (square * square) * root, r2 = k2 * (y3 * y4), r3 = k2 / K * (y1 * y5);
    const T r4 = k3 * (y1 * y4 * y4), r5 = k4 * (y6 * y6) * root, flow = kla * (inflow - y2);
    r.x[0] = -2 * r1 + r2 - r3 - r4 - p.k[0];
    r.x[1] = flow - 0.5 * r1 - r4 - 0.5 * r5 - p.k[1];
    r.x[2] = r1 - r2 + r3 - p.k[2];
    r.x[3] = r3 - r2 - 2 * r4 - p.k[3];
    r.x[4] = r2 - r3 + r5 - p.k[4];
    r.z[0] = Ks * (y1 * y4) - y6;
  }
  void start(State<Real>& s) const {
    s.x << decimal<Real>("0.444"), decimal<Real>("0.00123"), Real(0), decimal<Real>("0.007"), Real(0);
  }
  SceneFrame<Real> frame() const { return {.t_end = 180}; }
  static SceneEntry entry() {
    return {.id = "chemakzo",
            .title = "chemical Akzo Nobel: five reactions, one equilibrium",
            .shows = "an algebraic equation; a square root of a concentration, which must not become negative",
            .collections = {"ivp"},
            .literature = "IVP test set, CHEMAKZO",
            .kind = SceneKind::kIndex1,
            .reference_cases = {{.times = "20", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(ChemicalAkzo)
