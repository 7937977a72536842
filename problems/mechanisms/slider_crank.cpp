// The rigid slider-crank: one mechanism in three sets of coordinates.
#include <limits>

#include "irk/scene_file.h"
#include "problems/mechanisms/slider_crank_coordinates.h"

using namespace irk;

namespace {

using slider_crank::Absolute;
using slider_crank::Data;
using slider_crank::Minimal;
using slider_crank::Redundant;
using slider_crank::SwitchedTorque;

// Typical magnitudes over the first two seconds. The crank reaches 40 rad/s, forces reach a few newtons.
constexpr double kAngle = 1, kAngleRate = 10, kForce = 1;
constexpr const char* kNever = "inf";

Component angle(const char* name) { return {name, "rad", kAngle, kAngleRate}; }

template <class Real>
void makeRedundant(const SwitchedTorque<Real>& torque, const Data<Real>& d, Scene<Real>& scene) {
  setProblem(scene, Redundant<Real>{torque, d});
  setComponents(scene, {angle("theta"), angle("phi")}, {}, {{"lambda", "N", kForce}});
  scene.outputs = {{"x3",
                    [d](const State<Real>& s) {
                      using std::cos;
                      return Real(d.L1 * cos(s.u[0]) + d.L2 * cos(s.u[1]));
                    },
                    "m"}};
}

template <class Real>
void makeMinimal(const SwitchedTorque<Real>& torque, const Data<Real>& d, Scene<Real>& scene) {
  setProblem(scene, Minimal<Real>{torque, d});
  setComponents(scene, {angle("theta")});
  const auto phi = [d](const State<Real>& s) {
    using std::asin;
    using std::sin;
    return Real(-asin(d.L1 / d.L2 * sin(s.u[0])));
  };
  scene.outputs = {{"phi", phi, "rad"},
                   {"phi'",
                    [d, phi](const State<Real>& s) {
                      using std::cos;
                      return Real(-d.L1 * cos(s.u[0]) * s.v[0] / (d.L2 * cos(phi(s))));
                    },
                    "rad/s"},
                   {"x3",
                    [d, phi](const State<Real>& s) {
                      using std::cos;
                      return Real(d.L1 * cos(s.u[0]) + d.L2 * cos(phi(s)));
                    },
                    "m"}};
}

template <class Real>
void makeAbsolute(const SwitchedTorque<Real>& torque, const Data<Real>& d, Scene<Real>& scene) {
  setProblem(scene, Absolute<Real>{torque, d});
  const double length = static_cast<double>(d.L1);
  const auto position = [&](const char* name) { return Component{name, "m", length, length * kAngleRate}; };
  std::vector<Component> multipliers;
  for (int i = 1; i <= 7; ++i) multipliers.push_back({"lambda" + std::to_string(i), "N", kForce});
  setComponents(scene,
                {position("x1"), position("y1"), angle("theta"), position("x2"), position("y2"), angle("phi"),
                 position("x3"), position("y3")},
                {}, multipliers);
  scene.start.u[0] = d.L1 / 2;
  scene.start.u[3] = d.L1 + d.L2 / 2;
  scene.start.u[6] = d.L1 + d.L2;
}

std::vector<Parameter> parameters() {
  Parameter off =
      numberParameter("torque_off_at", "s", "time when the torque is switched off; inf = never", kNever, 0, 1e15);
  off.is_time = true;
  Parameter every = numberParameter(
      "torque_every", "s", "time after which the torque changes between T and T2; inf = never", kNever, 1e-6, 1e15);
  every.is_time = true;
  std::vector<Parameter> all = slider_crank::bodyParameters();
  all.insert(all.begin(), descriptionParameter("coordinates", "description of the same mechanism",
                                               {"redundant", "absolute", "minimal"}));
  all.insert(all.end(), {numberParameter("T", "N m", "crank torque", "0.1", -1e6, 1e6), off, every,
                         numberParameter("T2", "N m", "second level of the crank torque", "T", -1e6, 1e6),
                         smoothingParameter("s", "half of the time in which the torque changes", "1e-3")});
  return all;
}

template <class Real>
struct SliderCrank {
  // The start is stretched and at rest: theta = phi = 0.
  static Scene<Real> make(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Data<Real> d = slider_crank::dataFrom<Real>(values);
    const auto ever = [&](const char* name) { return values.at(name) != kNever; };
    const auto time = [&](const char* name) {
      return ever(name) ? value(name) : std::numeric_limits<Real>::infinity();
    };
    const SwitchedTorque<Real> torque{.first = value("T"),
                                      .second = values.at("T2") == "T" ? value("T") : value("T2"),
                                      .ever_off = ever("torque_off_at"),
                                      .ever_alternates = ever("torque_every"),
                                      .off_at = time("torque_off_at"),
                                      .every = time("torque_every"),
                                      .smoothing = value("smoothing")};
    Scene<Real> scene;
    const std::string& coordinates = values.at("coordinates");
    if (coordinates == "minimal") {
      makeMinimal(torque, d, scene);
    } else if (coordinates == "absolute") {
      makeAbsolute(torque, d, scene);
    } else {
      makeRedundant(torque, d, scene);
    }
    scene.start.d.setOnes();  // the torque is on, at its first level; the next change is the first one
    completeStart(scene);
    scene.t_end = 2;
    return scene;
  }
  static SceneEntry entry() {
    return {.id = "slider_crank",
            .title = "rigid slider-crank driven by a constant torque",
            .shows = "M(u) with a constraint: no term of the Jacobian vanishes",
            .collections = {"multibody"},
            .kind = SceneKind::kConstrained,
            .parameters = parameters(),
            .panels = {{"angles", {"theta", "phi"}},
                       {"angular velocities", {"theta'", "phi'"}},
                       {"slider", {"x3"}},
                       {"multiplier", {"lambda"}}},
            .reference_cases = {
                {.times = "0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1 1.2 1.4 1.6 1.8"},
                {.settings = "torque_off_at=0.5", .times = "1"},
                {.settings = "torque_every=0.5 T2=0.05", .times = "0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1"}}};
  }
};

}  // namespace

IRK_SCENE(SliderCrank)
