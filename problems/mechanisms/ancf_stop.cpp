// Two elastic arms of ANCF elements, one hinged and one clamped, that fall from the horizontal until the tip strikes a
// stop.
//
// The stop is a level plane below the support, which acts on the tip only. With the penetration delta its normal force
// is N = k delta (1 + c delta') (Hunt and Crossley): zero where contact begins and ends, and never pulling as long as
// the tip leaves with less than 1 / c. Friction is Coulomb's, mu N against the tip's velocity v along the plane; below
// the speed `creep` it falls in proportion to v, so that the tip creeps instead of sticking.
#include "irk/regularised.h"
#include "irk/scene_file.h"
#include "problems/mechanisms/ancf_beam.h"

using namespace irk;

namespace {

// d = (1 in contact, 0 otherwise; sign of v while sliding, 0 while creeping; 1 while creeping, 0 otherwise).
enum Discrete : Index { kContact, kSign, kCreeping };
enum Switch : Index { kTouches, kSlidesAhead, kSlidesBack, kCreeps };

template <class Real>
struct ArmWithStop {
  AncfBeam<Real> beam;
  Real gap;        // m, of the stop below the support
  Real k, c;       // N/m, s/m
  Real mu, creep;  // 1, m/s
  Real smoothing;  // m

  Sizes sizes() const {
    Sizes n = beam.sizes();
    n.discrete = 3;
    n.switches = 4;
    return n;
  }
  template <class T>
  T penetration(const Point<T>& p) const {
    return -gap - p.u[beam.tipY()];
  }
  /// The normal force of a tip in contact; its velocity along y is `rate`.
  template <class T>
  T normalForce(const T& penetration, const T& rate) const {
    return k * penetration * (1 - c * rate);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    beam.residual(p, r);
    const T normal = p.d[kContact] * normalForce<T>(penetration(p), p.v[beam.tipY()]);
    r.u[beam.tipY()] += normal;
    r.u[beam.tipX()] -= mu * normal * (p.d[kSign] + p.d[kCreeping] * p.v[beam.tipX()] / creep);
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const bool contact = p.d[kContact] > T(0.0), creeping = p.d[kCreeping] > T(0.0);
    const T depth = penetration(p), v = p.v[beam.tipX()];
    due[kTouches] = contact ? T(-depth) : depth;
    due[kSlidesAhead] = due[kSlidesBack] = due[kCreeps] = T(-1.0);
    if (!contact || mu == 0) return;
    if (creeping) {
      due[kSlidesAhead] = v - creep;
      due[kSlidesBack] = -v - creep;
    } else {
      due[kCreeps] = creep - p.d[kSign] * v;
    }
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    if (i == kTouches) {
      d[kContact] = 1 - p.d[kContact];
      const T v = p.v[beam.tipX()];
      d[kSign] = T(v > T(creep) ? 1.0 : v < T(-creep) ? -1.0 : 0.0);
    } else {
      d[kSign] = T(i == kSlidesAhead ? 1.0 : i == kSlidesBack ? -1.0 : 0.0);
    }
    d[kCreeping] = T(d[kSign] == T(0.0) ? 1.0 : 0.0);
  }
  // The stop reaches its full stiffness over the first `smoothing` of the penetration; friction has no kink at `creep`.
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    d[kContact] = smoothStep<T>(penetration(p) / smoothing);
    const T slip = p.v[beam.tipX()] / creep;
    d[kSign] = slip > T(1.0) ? T(1.0) : slip < T(-1.0) ? T(-1.0) : T(slip * (3 - slip * slip) / 2);
    d[kCreeping] = T(0.0);
  }
  std::string switchName(Index i) const {
    constexpr const char* kNames[] = {"contact", "slides ahead", "slides back", "creeps"};
    return kNames[i];
  }
};

template <class Real>
void setOutputs(const ArmWithStop<Real>& problem, Scene<Real>& scene) {
  const auto depth = [problem](const State<Real>& s) { return problem.penetration(pointOf(s)); };
  const auto energy = [problem, depth](const State<Real>& s) {
    const Real beam = problem.beam.energy(s.u, s.v), deep = depth(s);
    return s.d[kContact] > 0 ? Real(beam + problem.k / 2 * deep * deep) : beam;
  };
  const auto normal = [problem, depth](const State<Real>& s) {
    const Real rate = s.v[problem.beam.tipY()];
    return Real(s.d[kContact] * problem.template normalForce<Real>(depth(s), rate));
  };
  scene.outputs = {{"gap", [depth](const State<Real>& s) { return Real(-depth(s)); }, "m"},
                   {"N", normal, "N"},
                   {"energy", energy, "J", problem.mu == 0 && problem.c == 0}};
}

template <class Real>
Scene<Real> sceneOf(AncfSupport support, const Settings& settings) {
  const auto value = [&](const char* name) { return number<Real>(settings, name); };
  const auto data = AncfData<Real>::from(settings, support);
  const ArmWithStop<Real> problem{.beam = AncfBeam<Real>(data),
                                  .gap = value("gap"),
                                  .k = value("k"),
                                  .c = value("c"),
                                  .mu = value("mu"),
                                  .creep = value("creep"),
                                  .smoothing = value("smoothing")};
  Scene<Real> scene;
  setProblem(scene, problem);
  const State<Real> straight = problem.beam.straightStart();
  scene.start.u = straight.u;
  scene.start.w = straight.w;
  scene.start.d << 0, 0, 1;
  scene.t_end = 0.3;
  setComponents(scene, problem.beam.coordinates(data.speed()));
  setOutputs(problem, scene);
  return scene;
}

SceneEntry entryOf(const char* id, const char* title, const char* gap) {
  constexpr const char* kTimes = "0.21 0.22 0.23 0.24 0.25 0.26 0.27 0.28 0.29";
  return {.id = id,
          .title = title,
          .shows = "a flexible mechanism with contact and friction",
          .collections = {"multibody", "switching"},
          .size = {.parameter = "elements", .unknowns = 4, .step = 1e-4},
          .parameters = {elementsParameter("2"), positiveParameter("L", "m", "length", "1"),
                         positiveParameter("A", "m^2", "area of the section", "0.0018"),
                         positiveParameter("I", "m^4", "second moment of area", "1.35e-7"),
                         positiveParameter("E", "Pa", "Young's modulus", "1e8"),
                         positiveParameter("rho", "kg/m^3", "density", "1200"),
                         numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
                         positiveParameter("gap", "m", "distance of the stop below the support", gap),
                         positiveParameter("k", "N/m", "stiffness of the stop", "1e5"),
                         numberParameter("c", "s/m", "damping of the stop", "0.1", 0, 1e6),
                         numberParameter("mu", "", "coefficient of friction", "0.3", 0, 1e3),
                         positiveParameter("creep", "m/s", "speed from which on friction has its full size", "0.01"),
                         smoothingParameter("m", "penetration until the stop has its whole stiffness", "1e-5")},
          .panels = {{"tip", {"tip_x", "tip_y"}},
                     {"velocity of the tip", {"tip_x'", "tip_y'"}},
                     {"normal force", {"N"}},
                     {"path of the tip", {"tip_x:tip_y"}}},
          .reference_cases = {{.times = kTimes, .tolerance = kFewDigits},
                              {.settings = "mu=0 c=0", .times = kTimes, .tolerance = kFewDigits}}};
}

// Contact begins at t = 0.205.
template <class Real>
struct AncfStop {
  static Scene<Real> make(const Settings& values) { return sceneOf<Real>(AncfSupport::kHinged, values); }
  static SceneEntry entry() {
    return entryOf("ancf_stop", "hinged elastic arm of ANCF elements that strikes a stop with friction", "0.3");
  }
};

// Contact begins at t = 0.153.
template <class Real>
struct AncfLeafStop {
  static Scene<Real> make(const Settings& values) { return sceneOf<Real>(AncfSupport::kClamped, values); }
  static SceneEntry entry() {
    return entryOf("ancf_leaf_stop", "leaf spring of ANCF elements that strikes a stop with friction", "0.15");
  }
};

}  // namespace

IRK_SCENE(AncfStop)
IRK_SCENE(AncfLeafStop)
