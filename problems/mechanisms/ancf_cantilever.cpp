// A cantilever of ANCF elements; a dead tip load 3 EI / L^2 is applied suddenly at t = 0.
#include "irk/scene_file.h"
#include "problems/mechanisms/ancf_beam.h"

using namespace irk;

namespace {

// Defaults that are computed from other parameters.
constexpr const char* kSquare = "A^2/12";
constexpr const char* kStandardLoad = "3EI/L^2";

template <class Real>
struct AncfCantilever {
  static Scene<Real> make(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const bool square = values.at("I") == kSquare, standard = values.at("f") == kStandardLoad;
    const Real L = value("L"), E = value("E"), A = value("A");
    const Real EI = E * (square ? Real(A * A / 12) : value("I"));
    const AncfData<Real> data{.elements = static_cast<Index>(number<double>(values, "elements")),
                              .L = L,
                              .EA = E * A,
                              .EI = EI,
                              .rhoA = value("rho") * A,
                              .g = Real(0),
                              .tip_load = standard ? Real(3 * EI / (L * L)) : value("f"),
                              .support = AncfSupport::kClamped};
    const AncfBeam<Real> beam(data);
    Scene<Real> scene;
    setProblem(scene, beam);
    scene.start = beam.straightStart();
    scene.t_end = 0.1;
    // Velocities have the magnitude of the first bending mode, omega = 3.5 sqrt(EI / (rhoA L^4)).
    using std::sqrt;
    const Real omega = 3.5 * sqrt(EI / (data.rhoA * L * L)) / L;
    setComponents(scene, beam.coordinates(static_cast<double>(omega)));
    const Index x = beam.tipX(), y = beam.tipY();
    scene.outputs = {{"u_x", [x, L](const State<Real>& s) { return Real(s.u[x] - L); }, "m"},
                     {"u_y", [y](const State<Real>& s) { return s.u[y]; }, "m"},
                     {"energy", [beam](const State<Real>& s) { return beam.energy(s.u, s.v); }, "J"}};
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "ancf_cantilever",
            .title = "cantilever of ANCF cable elements under a stepped tip load",
            .shows = "large bending, constant M: a Jacobian without derivatives of M must give the same results",
            .collections = {"multibody"},
            .parameters = {elementsParameter("2"), positiveParameter("L", "m", "length", "2"),
                           positiveParameter("E", "Pa", "Young's modulus", "2.07e11"),
                           positiveParameter("A", "m^2", "area of the section", "0.01"),
                           positiveParameter("I", "m^4", "second moment of area", kSquare),
                           positiveParameter("rho", "kg/m^3", "density", "7800"),
                           numberParameter("f", "N", "dead tip load, down", kStandardLoad, -1e15, 1e15)},
            .panels = {{"tip displacement", {"u_x", "u_y"}}, {"path of the tip", {"tip_x:tip_y"}}},
            .reference_cases = {{.times = "0.02 0.05", .tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(AncfCantilever)
