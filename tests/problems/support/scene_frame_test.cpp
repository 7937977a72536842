// The frame of a problem's struct: parameters, start, end, names, exact solution.
#include <gtest/gtest.h>

#include <string>

#include "irk/misuse.h"
#include "irk/scene_file.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

// u'' = -k u + x, x' = -x, from u = 2 at rest and x = 3; a discrete state that nothing changes.
template <class Real>
struct Plain {
  Real k;

  Sizes sizes() const { return {.nu = 1, .nx = 1, .discrete = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = p.a[0] + k * p.u[0] - p.d[0] * p.x[0];
    r.x[0] = p.k[0] + p.x[0];
  }
  static Plain with(const Settings& values) { return {number<Real>(values, "k")}; }
  void start(State<Real>& s) const {
    s.u[0] = Real(2);
    s.x[0] = Real(3);
    s.d[0] = Real(1);
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 7,
            .time_unit = "ms",
            .u = {{"u", "m", 5, 6}},
            .x = {{"x", "N", 4}},
            .outputs = {{"double", [](const State<Real>& s) { return Real(2 * s.u[0]); }, "m"}}};
  }
};

SceneEntry plainEntry() {
  return sceneEntryOf<Plain>({.id = "plain",
                              .title = "",
                              .shows = "",
                              .parameters = {numberParameter("k", "1/s^2", "stiffness", "10", 0, 100)}});
}

TEST(SceneFrame, FillsTheScene) {
  const auto scene = makeScene<double>(plainEntry(), {{"k", "4"}});
  EXPECT_EQ(scene.t_end, 7);
  EXPECT_EQ(scene.time_unit, "ms");
  EXPECT_EQ(scene.names, (std::vector<std::string>{"u", "u'", "x"}));
  EXPECT_EQ(scene.units, (std::vector<std::string>{"m", "m/ms", "N"}));
  EXPECT_EQ(scene.scale, (Vec<double>(3) << 5, 6, 4).finished());
  EXPECT_EQ(scene.start.t, 0);
  EXPECT_EQ(scene.start.u[0], 2);
  EXPECT_EQ(scene.start.v[0], 0);
  EXPECT_EQ(scene.start.d[0], 1);
  // Completed: u'' = -4 * 2 + 3, x' = -3.
  EXPECT_NEAR(scene.start.w[0], -5, 1e-14);
  EXPECT_NEAR(scene.start.w[1], -3, 1e-14);
  ASSERT_EQ(scene.outputs.size(), 1U);
  EXPECT_EQ(scene.outputs[0].value(scene.start), 4);
  EXPECT_FALSE(scene.exact);
}

TEST(SceneFrame, MakesBothScalars) {
  const SceneEntry entry = plainEntry();
  EXPECT_EQ(makeScene<BigFloat>(entry, {{"k", "0.1"}}).start.w[0], BigFloat("2.8")) << "all digits of a parameter";
  const WorkingDigits digits(100);
  EXPECT_EQ(makeScene<BigFloat>(entry, {{"k", "0.1"}}).start.w[0], BigFloat("2.8"));
  EXPECT_THROW(makeScene<double>(entry, {{"k", "101"}}), Misuse);
}

// x' = -x; without `start` the start is the exact solution at t = 0, and without parameters there is no `with`.
template <class Real>
struct Decay {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.k[0] + p.x[0];
  }
  State<Real> exact(const Real& t) const {
    using std::exp;
    State<Real> s(sizes());
    s.t = t;
    s.x[0] = 2 * exp(-t);
    s.w[0] = -s.x[0];
    return s;
  }
  SceneFrame<Real> frame() const { return {.x = {{"x"}}}; }
};

TEST(SceneFrame, StartsWithTheExactSolution) {
  const auto scene = makeScene<double>(sceneEntryOf<Decay>({.id = "decay", .title = "", .shows = ""}), {});
  EXPECT_EQ(scene.start.x[0], 2);
  EXPECT_EQ(scene.start.w[0], -2);
  ASSERT_TRUE(scene.exact);
  EXPECT_DOUBLE_EQ(scene.exact(1).x[0], 2 * std::exp(-1.0));
}

// A mass on the unit circle: the first guess of x is drawn to the constraint, y stays.
template <class Real>
struct OnCircle {
  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = p.a[0] + p.u[0] * p.z[0];
    r.u[1] = p.a[1] + p.u[1] * p.z[0] + 1;
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1) * 0.5;
  }
  void start(State<Real>& s) const { s.u << Real(0.7), Real(0.6); }
  SceneFrame<Real> frame() const { return {.u = {{"x"}, {"y"}}, .z = {{"lambda"}}, .unknown = {"x"}}; }
};

TEST(SceneFrame, FindsTheComponentsThatTheConstraintsDetermine) {
  const auto scene = makeScene<double>(sceneEntryOf<OnCircle>({.id = "on_circle", .title = "", .shows = ""}), {});
  EXPECT_NEAR(scene.start.u[0], 0.8, 1e-15);
  EXPECT_EQ(scene.start.u[1], 0.6);
  EXPECT_NEAR(scene.start.z()[0], -0.6, 1e-14) << "x x'' + y y'' = -lambda - y = 0";
}

// x' = -x, whose exact solution holds with known = yes only.
template <class Real>
struct PartlyKnown : Decay<Real> {
  bool known;

  static PartlyKnown with(const Settings& values) { return {{}, values.at("known") == "yes"}; }
  SceneFrame<Real> frame() const { return {.exact_holds = known}; }
};

TEST(SceneFrame, AnExactSolutionMayHoldForSomeParametersOnly) {
  const auto entry = sceneEntryOf<PartlyKnown>(
      {.id = "partly", .title = "", .shows = "", .parameters = {wordParameter("known", "", {"yes", "no"})}});
  EXPECT_TRUE(makeScene<double>(entry, {}).exact);
  EXPECT_FALSE(makeScene<double>(entry, {{"known", "no"}}).exact);
}

// u'' = -u, x' = -x, z = u; a frame without names.
template <class Real>
struct Nameless {
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = p.a[0] + p.u[0];
    r.x[0] = p.k[0] + p.x[0];
    r.z[0] = p.z[0] - p.u[0];
  }
  SceneFrame<Real> frame() const { return {.t_end = 1}; }
};

TEST(SceneFrame, NumbersTheComponentsOfAFrameWithoutNames) {
  const auto scene = makeScene<double>(sceneEntryOf<Nameless>({.id = "nameless", .title = "", .shows = ""}), {});
  EXPECT_EQ(scene.names, (std::vector<std::string>{"y1", "y1'", "y2", "y3"}));
  EXPECT_EQ(scene.units, (std::vector<std::string>{"", "1/s", "", ""}));
  EXPECT_EQ(scene.scale, Vec<double>::Ones(4));
}

TEST(SceneFrame, AStructWithConstraintsIsAConstrainedSystem) {
  EXPECT_EQ(sceneEntryOf<OnCircle>({.id = "a", .title = "", .shows = ""}).kind, SceneKind::kConstrained);
  EXPECT_EQ(sceneEntryOf<Nameless>({.id = "b", .title = "", .shows = ""}).kind, SceneKind::kOde);
  EXPECT_EQ(sceneEntryOf<OnCircle>({.id = "c", .title = "", .shows = "", .kind = SceneKind::kIndex3}).kind,
            SceneKind::kIndex3)
      << "a kind that the entry names is kept";
}

// A struct that makes its scene itself is asked first.
template <class Real>
struct Maker : Decay<Real> {
  static Scene<Real> make(const Settings&) {
    auto scene = framedScene<Real>(Decay<Real>{});
    scene.t_end = 99;
    return scene;
  }
};

TEST(SceneFrame, AStructMayMakeItsSceneItself) {
  EXPECT_EQ(makeScene<double>(sceneEntryOf<Maker>({.id = "maker", .title = "", .shows = ""}), {}).t_end, 99);
}

TEST(SceneFrame, AParameterThatIsNoNumberIsRefused) {
  for (const char* value : {"abc", "", "3 m", "1e"}) {
    EXPECT_EQ(refusal([&] {
                static_cast<void>(number<double>({{"k", value}}, "k"));
              }),
              "the parameter k = '" + std::string(value) + "' is not a number");
  }
  EXPECT_EQ(number<double>({{"k", "-2.5e-3"}}, "k"), -2.5e-3);
}

// The same with other names.
template <class Real>
struct NamedInPart : Nameless<Real> {
  SceneFrame<Real> frame() const { return {.t_end = 1, .x = {{"charge"}}}; }
};
template <class Real>
struct NamedTwice : Nameless<Real> {
  SceneFrame<Real> frame() const { return {.t_end = 1, .x = {{"charge"}, {"flux"}}}; }
};

TEST(SceneFrame, MayNameSomeComponentsOnly) {
  const auto scene = makeScene<double>(sceneEntryOf<NamedInPart>({.id = "in_part", .title = "", .shows = ""}), {});
  EXPECT_EQ(scene.names, (std::vector<std::string>{"u1", "u1'", "charge", "z1"}));
  const auto make = [] { makeScene<double>(sceneEntryOf<NamedTwice>({.id = "twice", .title = "", .shows = ""}), {}); };
  EXPECT_TRUE(containsAll(refusal(make), {"the frame names 2 components of x, and sizes() has 1"}));
}

}  // namespace
}  // namespace irk::test
