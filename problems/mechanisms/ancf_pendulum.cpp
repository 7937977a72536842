// A soft pendulum of ANCF elements, hinged at one end and released from the horizontal.
#include "irk/scene_file.h"
#include "problems/mechanisms/ancf_beam.h"

using namespace irk;

namespace {

template <class Real>
struct AncfPendulum {
  static Scene<Real> make(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Real L = value("L"), E = value("E"), A = value("A");
    const AncfData<Real> data{.elements = static_cast<Index>(number<double>(values, "elements")),
                              .L = L,
                              .EA = E * A,
                              .EI = E * value("I"),
                              .rhoA = value("rho") * A,
                              .g = value("g"),
                              .tip_load = Real(0),
                              .support = AncfSupport::kHinged};
    const AncfBeam<Real> beam(data);
    Scene<Real> scene;
    setProblem(scene, beam);
    scene.start = beam.straightStart();
    scene.t_end = 1;
    // Velocities have the magnitude of those of a rigid rod, sqrt(3 g L) at its tip.
    const double speed = std::sqrt(static_cast<double>(Real(3 * data.g * L)));
    setComponents(scene, beam.coordinates(std::max(speed, 1.0)));
    scene.outputs = {{"energy", [beam](const State<Real>& s) { return beam.energy(s.u, s.v); }, "J", true}};
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "ancf_pendulum",
            .title = "soft pendulum of ANCF cable elements",
            .shows = "large deformations with constant M; conserves its energy",
            .collections = {"multibody"},
            .size = {.parameter = "elements", .unknowns = 4, .step = 1e-4},
            .parameters = {elementsParameter("2"), positiveParameter("L", "m", "length", "1.2"),
                           positiveParameter("A", "m^2", "area of the section", "0.0018"),
                           positiveParameter("I", "m^4", "second moment of area", "1.215e-8"),
                           positiveParameter("E", "Pa", "Young's modulus", "0.7e6"),
                           positiveParameter("rho", "kg/m^3", "density", "5540"),
                           numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6)},
            .panels = {{"tip", {"tip_x", "tip_y"}}, {"path of the tip", {"tip_x:tip_y"}}},
            .reference_cases = {{.times = "0.1 0.2 0.25 0.3 0.4 0.5 0.6 0.7 0.8 0.9"}, {.settings = "elements=4"}}};
  }
};

}  // namespace

IRK_SCENE(AncfPendulum)
