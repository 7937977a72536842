// Invalid systems and starts of a user are refused; valid ones are not.
#include "irk/system_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "irk/multiprecision.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A problem with nothing but its sizes.
struct Sized {
  Sizes n;
  Sizes sizes() const { return n; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < r.u.size(); ++i) r.u[i] = -p.a[i];
    for (Index i = 0; i < r.x.size(); ++i) r.x[i] = -p.k[i];
    for (Index i = 0; i < r.z.size(); ++i) r.z[i] = -p.z[i];
  }
};

TEST(UserSystem, ImpossibleSizesAreRefused) {
  struct Case {
    Sizes n;
    const char* message;
  };
  const Case cases[] = {{{}, "at least one unknown"},
                        {{.nu = -1}, "nu = -1"},
                        {{.nu = 1, .nx = -2}, "nx = -2"},
                        {{.nu = 1, .nz = -3}, "nz = -3"},
                        {{.nu = 1, .constraints = -1}, "constraints = -1"},
                        {{.nu = 1, .discrete = -1}, "discrete = -1"},
                        {{.nu = 1, .switches = -1}, "switches = -1"},
                        {{.nu = 1, .nz = 1, .constraints = 2}, "constraints = 2: up to nz = 1"},
                        {{.nu = 1, .nz = 1, .constraints = 1}, "no function constraints"},
                        {{.nu = 1, .discrete = 1, .switches = 1}, "no function switching"}};
  for (const auto& [n, message] : cases) {
    for (const auto formulation : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
      const auto text = refusal([&, sizes = n] { (void)makeSystem<double>(Sized{sizes}, {formulation}); });
      EXPECT_TRUE(contains(text, message)) << message;
    }
  }
  for (const Sizes n : {Sizes{.nu = 1}, Sizes{.nx = 1}, Sizes{.nz = 1}, Sizes{.nu = 1, .nz = 2, .discrete = 40}}) {
    EXPECT_NO_THROW((void)makeSystem<double>(Sized{n}, {}));
  }
}

/// Gives one part of a start a wrong size.
struct Reshaped {
  const char* part;
  void (*reshape)(State<double>&);
};
constexpr Reshaped kReshaped[] = {{"u", [](State<double>& s) { s.u.conservativeResize(1); }},
                                  {"u", [](State<double>& s) { s.u.setZero(3); }},
                                  {"v", [](State<double>& s) { s.v.resize(0); }},
                                  {"v", [](State<double>& s) { s.v.setZero(5); }},
                                  {"x", [](State<double>& s) { s.x.setZero(1); }},
                                  {"w", [](State<double>& s) { s.w.setZero(2); }},
                                  {"w", [](State<double>& s) { s.w.setZero(4); }},
                                  {"d", [](State<double>& s) { s.d.setZero(1); }},
                                  {"carry", [](State<double>& s) { s.carry.resize(0); }},
                                  {"u", [](State<double>& s) { s = State<double>(); }}};

// Each of these starts once caused a read beyond the end of an array.
TEST(UserSystem, StartsOfOtherSizesAreRefused) {
  for (const auto formulation : {Formulation::kIndex2, Formulation::kIndex3, Formulation::kGgl,
                                 Formulation::kFirstOrder, Formulation::kIndex2Projected}) {
    Integrator<double> integrator(makeSystem<double>(CartesianPendulum{}, {formulation}),
                                  makeTableau<double>("radau_iia_3"), adaptive(1e-6));
    for (const auto& [part, reshape] : kReshaped) {
      auto start = pendulumStart<double>();
      reshape(start);
      const auto text = refusal([&] { (void)integrator.integrate(start, 0.1); });
      EXPECT_TRUE(contains(text, std::string("start: ") + part)) << idOf(formulation);
    }
    EXPECT_EQ(integrator.integrate(pendulumStart<double>(), 0.1).outcome, Outcome::kSuccess) << idOf(formulation);
  }
}

// A start with an infinite v once led to 200 000 attempted steps.
TEST(UserSystem, StartsThatAreNotFiniteEndBeforeTheFirstStep) {
  struct Damage {
    const char* place;
    void (*damage)(State<double>&, double);
  };
  const Damage damages[] = {{"u[0]", [](State<double>& s, double x) { s.u[0] = x; }},
                            {"v[1]", [](State<double>& s, double x) { s.v[1] = x; }},
                            {"w[2]", [](State<double>& s, double x) { s.w[2] = x; }}};
  for (const auto formulation : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
    for (const double number : {kInfinity, -kInfinity, kNan}) {
      for (const auto& [place, damage] : damages) {
        auto start = pendulumStart<double>();
        damage(start, number);
        const auto s = integrate<double>(CartesianPendulum{}, start, 0.1, makeTableau<double>("radau_iia_3"),
                                         adaptive(1e-6), formulation);
        EXPECT_EQ(s.outcome, Outcome::kNotFinite) << place;
        EXPECT_TRUE(contains(s.detail, std::string("at the start: ") + place));
        EXPECT_EQ(s.counters.residuals, 0);
      }
    }
  }
}

TEST(UserSystem, TimesAreFiniteAndInOrder) {
  Integrator<double> integrator(makeSystem<double>(Riccati{}), makeTableau<double>("radau_iia_3"), adaptive(1e-6));
  for (const double end : {kInfinity, kNan, -kInfinity}) {
    const auto text = refusal([&] { (void)integrator.integrate(riccatiStart<double>(), end); });
    EXPECT_TRUE(contains(text, "t_end = ")) << end;
  }
  auto start = riccatiStart<double>();
  start.t = -kInfinity;
  EXPECT_TRUE(contains(refusal([&] { (void)integrator.integrate(start, 1.0); }), "start: t = -inf"));
  EXPECT_EQ(integrator.integrate(riccatiStart<double>(), 0.0).outcome, Outcome::kSuccess) << "no time at all";
}

TEST(UserSystem, NamesTheEvaluationThatIsNotFiniteAtTheStart) {
  const FirstOrder root{[](const auto& p) {
    using std::sqrt;
    return sqrt(p.x[0]);
  }};
  const auto start = startOf(root, {.x = {-1}});
  const auto s = integrate<double>(root, start, 1, makeTableau<double>("radau_iia_3"), adaptive(1e-6));
  EXPECT_EQ(s.outcome, Outcome::kNotFinite);
  EXPECT_TRUE(contains(s.detail, "at the start, t = 0: row 0: residual"));
  EXPECT_EQ(s.counters.steps_accepted + s.counters.steps_rejected_error + s.counters.steps_rejected_newton, 0);
}

TEST(UserSystem, ScalesAreChecked) {
  const auto refused = [](const Vec<double>& scale) {
    return refusal([&] {
      Integrator<double>(makeSystem<double>(Riccati{}), makeTableau<double>("radau_iia_3"), adaptive(1e-6), scale);
    });
  };
  EXPECT_EQ(refused(Vec<double>::Constant(1, 2)), "");
  EXPECT_TRUE(contains(refused(Vec<double>::Ones(3)), "scale: 3 numbers, 1 are expected"));
  for (const double scale : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_TRUE(contains(refused(Vec<double>::Constant(1, scale)), "scale[0]")) << scale;
  }
}

TEST(UserSystem, GoodSystemsOfEveryScalarAndFormulationPass) {
  for (const auto& formulation : named<Formulation>()) {
    const auto s = integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 0.1,
                                     makeTableau<double>("radau_iia_3"), adaptive(1e-6), formulation.value);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << formulation.id << s.detail;
  }
  EXPECT_EQ(
      (integrate<BigFloat>(Riccati{}, riccatiStart<BigFloat>(), 0.1, makeTableau<BigFloat>("gauss_3"), fixedSteps(0.1))
           .outcome),
      Outcome::kSuccess);
  // A finite number beyond the range of double.
  State<BigFloat> start(Riccati{}.sizes());
  start.x[0] = BigFloat("1e400");
  EXPECT_EQ(notFinite(start), "");
  start.x[0] = std::numeric_limits<BigFloat>::quiet_NaN();
  EXPECT_NE(notFinite(start), "");
}

}  // namespace
}  // namespace irk::test
