// A soft pendulum of ANCF elements, hinged at one end and released from the horizontal.
#include "irk/scene_file.h"
#include "problems/mechanisms/ancf_beam.h"

using namespace irk;

namespace {

template <class Real>
struct AncfPendulum {
  static Scene<Real> make(const Settings& values) {
    const auto data = AncfData<Real>::from(values, AncfSupport::kHinged);
    const AncfBeam<Real> beam(data);
    Scene<Real> scene;
    setProblem(scene, beam);
    scene.start = beam.straightStart();
    scene.t_end = 1;
    setComponents(scene, beam.coordinates(data.speed()));
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
