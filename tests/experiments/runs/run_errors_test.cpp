// Errors per group of components, and drift: each is computed from its own difference.
#include "experiments/runs/run_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/run.h"

namespace irk {
namespace {

/// Two positions on the unit circle, one x, one multiplier.
struct OnCircle {
  Sizes sizes() const { return {.nu = 2, .nx = 1, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] - p.u[1] * p.z[0];
    r.x[0] = -p.k[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1.0) * 0.5;
  }
};

State<double> exactState() {
  State<double> s(OnCircle{}.sizes());
  s.t = 2;
  s.u << 0.6, 0.8;
  s.v << -8, 6;
  s.x << 0.5;
  s.z() << 100;
  return s;
}

Scene<double> scene() {
  Scene<double> scene;
  scene.id = "on_circle";
  scene.system = [](const SystemOptions& o) { return makeSystem<double>(OnCircle{}, o); };
  scene.start = State<double>(OnCircle{}.sizes());
  scene.names = {"u1", "u2", "v1", "v2", "x", "lambda"};
  scene.scale = Vec<double>::Ones(6);
  scene.scale[4] = 10;
  scene.outputs = {{"sum", [](const State<double>& s) { return s.u[0] + s.u[1]; }}};
  return scene;
}

// Errors: 2e-3 in u2, 3e-2 of 8 in v1, 4e-1 of the scale 10 in x, 5 of 100 in z.
State<double> off() {
  State<double> s = exactState();
  s.u[1] += 0.8e-1 * 2.5e-2;
  s.v[0] += 0.24;
  s.x[0] += 0.1;
  s.z()[0] += 5;
  return s;
}

void expectGroups(const RunErrors& e) {
  EXPECT_NEAR(e.u, 2e-3, 1e-12);
  EXPECT_NEAR(e.v, 0.03, 1e-12);
  EXPECT_NEAR(e.x, 0.01, 1e-12);
  EXPECT_NEAR(e.z, 0.05, 1e-12);
  EXPECT_NEAR(e.all, 0.05, 1e-12);
  EXPECT_NEAR(e.drift, 0.5 * (0.36 + 0.802 * 0.802 - 1), 1e-12);
}

TEST(RunErrors, OfAClosedForm) {
  Scene<double> known = scene();
  known.exact = [](const double&) { return exactState(); };
  // relative to max(|u|, 1)
  State<double> state = off();
  expectGroups(errorsOf(known, {}, state));
}

TEST(RunErrors, OfReferencesAtTheTime) {
  const auto reference = [](const char* component, double t, const char* value, double accuracy) {
    Reference r;
    r.component = component;
    r.t = t;
    r.value = value;
    r.accuracy = accuracy;
    return r;
  };
  const std::vector<Reference> references = {reference("u1", 2, "0.6", 1e-9),  reference("u2", 2, "0.8", 1e-9),
                                             reference("u2", 2, "0.7", 1e-3),   // a less accurate one
                                             reference("u2", 1, "0.1", 1e-12),  // at another time
                                             reference("v1", 2, "-8", 1e-9),   reference("v2", 2, "6", 1e-9),
                                             reference("x", 2, "0.5", 1e-9),   reference("lambda", 2, "100", 1e-9)};
  expectGroups(errorsOf(scene(), references, off()));
  // An output contributes only to the error over all components.
  const RunErrors output = errorsOf(scene(), {reference("sum", 2, "1.0", 1e-9)}, off());
  EXPECT_NEAR(output.all, 0.402, 1e-12);
  EXPECT_TRUE(std::isnan(output.u) && std::isnan(output.z));
}

TEST(RunErrors, OfNothingAreUnknown) {
  const RunErrors none = errorsOf(scene(), {}, off());
  EXPECT_TRUE(std::isnan(none.all) && std::isnan(none.u) && std::isnan(none.v));
  EXPECT_FALSE(std::isnan(none.drift)) << "needs no reference";
}

// The distances of off() are 0.002 of 0.8 in u2, 0.24 of 8 in v1, 0.1 of 0.5 in x, 5 of 100 in z. With atol / rtol =
// 0.01 and the scales 1 (x: 10) the mixed error is that of x, 0.1 / (0.1 + 0.5); the relative one is 0.1 / 0.5.
TEST(RunErrors, AreCountedInDigitsAsTheIvpTestSetDoes) {
  Scene<double> known = scene();
  known.exact = [](const double&) { return exactState(); };
  const RunErrors errors = errorsOf(known, {}, off(), {0.01, known.scale});
  EXPECT_NEAR(errors.mescd(), 0.778151250383644, 1e-12) << "log10 6";
  EXPECT_NEAR(errors.scd(), 0.698970004336019, 1e-12) << "log10 5";
  expectGroups(errors);
  // With atol / rtol = 10 that of v1 is the largest one but for x, whose scale is 10: 0.24 / 18, 0.1 / 100.5, 5 / 110.
  EXPECT_NEAR(errorsOf(known, {}, off(), {10, known.scale}).mescd(), 1.342422680822206, 1e-12) << "log10 22, of z";
  // Without tolerances there is no mixed error.
  const RunErrors constant = errorsOf(known, {}, off());
  EXPECT_TRUE(std::isnan(constant.mescd()));
  EXPECT_NEAR(constant.scd(), 0.698970004336019, 1e-12);
}

// A reference of 0 has no relative error; no error has infinitely many digits.
TEST(RunErrors, OfAReferenceThatIsZeroOrMet) {
  State<double> state = off();
  state.u[0] = 0.003;
  const RunErrors zero = errorsOf(scene(), {{2, "u1", "0", 1e-9, ""}}, state, {1, {}});
  EXPECT_TRUE(std::isnan(zero.scd()));
  EXPECT_NEAR(zero.mescd(), 2.522878745280338, 1e-12) << "-log10 0.003";
  const RunErrors met = errorsOf(scene(), {{2, "v2", "6", 1e-9, ""}}, off(), {1, {}});
  EXPECT_EQ(met.scd(), std::numeric_limits<double>::infinity());
  // An output counts with the scale 1: |1.402 - 1| / (0.01 + 1).
  const RunErrors output = errorsOf(scene(), {{2, "sum", "1.0", 1e-9, ""}}, off(), {0.01, scene().scale});
  EXPECT_NEAR(output.mescd(), -std::log10(0.402 / 1.01), 1e-12);
}

TEST(RunErrors, DigitsAreKnownOnlyAboveTheAccuracyOfAComputedReference) {
  const auto by = [](double accuracy) {
    return errorsByComputed(scene(), {{2, "x", "0.5", accuracy, ""}}, off(), {1, {}});
  };
  EXPECT_NEAR(by(0.0099).mescd(), -std::log10(0.1 / 1.5), 1e-12);
  EXPECT_TRUE(std::isnan(by(0.0101).mescd()) && std::isnan(by(0.0101).scd())) << "ten times the accuracy is 0.101";
}

// Errors as in off(): u 2e-3, v 3e-2, x 1e-2, z 5e-2. The accuracies of u and x are too low for theirs.
TEST(RunErrors, BelowTenAccuraciesOfAComputedReferenceAreNotMeasurable) {
  const auto by = [](double u, double v, double x, double z) {
    return errorsByComputed(scene(),
                            {{2, "u1", "0.6", u, ""},
                             {2, "u2", "0.8", u, ""},
                             {2, "v1", "-8", v * 8, ""},
                             {2, "x", "0.5", x * 10, ""},
                             {2, "lambda", "100", z * 100, ""}},
                            off());
  };
  const RunErrors good = by(1e-9, 1e-9, 1e-9, 1e-9);
  expectGroups(good);
  EXPECT_EQ(referenceName(good.reference), "computed");
  EXPECT_NEAR(good.accuracy, 1e-9, 1e-15);
  EXPECT_TRUE(good.remark.empty());
  const RunErrors some = by(2.1e-4, 1e-9, 1.1e-3, 1e-9);
  EXPECT_TRUE(std::isnan(some.u) && std::isnan(some.x));
  EXPECT_NEAR(some.v, 0.03, 1e-12);
  EXPECT_NEAR(some.all, 0.05, 1e-12) << "the largest error is above ten times 1.1e-3";
  EXPECT_TRUE(some.remark.empty());
  const RunErrors none = by(1e-9, 1e-9, 1e-9, 6e-3);
  EXPECT_TRUE(std::isnan(none.all) && std::isnan(none.z));
  EXPECT_NEAR(none.v, 0.03, 1e-12);
  EXPECT_EQ(none.remark, "error below 6e-02, ten times the reference's accuracy: not measurable");
  EXPECT_NEAR(none.accuracy, 6e-3, 1e-12);
  EXPECT_EQ(errorsByComputed(scene(), {{1, "u1", "0.6", 1e-9, ""}}, off()).reference, ReferenceKind::kNone)
      << "another time";
}

}  // namespace
}  // namespace irk
