// What Integrator is given and cannot work with: tableaus, methods, options, systems, error bars.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/control/controller.h"
#include "irk/error_bar.h"
#include "irk/multiprecision.h"
#include "tests/core/support.h"
#include "tests/misuse_table.h"

namespace irk::test {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

// --- Tableaus

/// A damage of the tableau radau_iia_2.
struct Damage {
  const char* message;
  void (*damage)(Tableau<double>&);
};
const Damage kDamages[] = {
    {"b has 1 numbers: 2 are expected", [](auto& t) { t.b.conservativeResize(1); }},
    {"b has 3 numbers: 2 are expected", [](auto& t) { t.b.setZero(3); }},
    {"b has 0 numbers: 2 are expected", [](auto& t) { t.b.resize(0); }},
    {"c has 1 numbers: 2 are expected", [](auto& t) { t.c.conservativeResize(1); }},
    {"c has 3 numbers: 2 are expected", [](auto& t) { t.c.setZero(3); }},
    {"c has 0 numbers: 2 are expected", [](auto& t) { t.c.resize(0); }},
    {"A is 2 x 1: a square matrix", [](auto& t) { t.A.conservativeResize(2, 1); }},
    {"A is 1 x 2: a square matrix", [](auto& t) { t.A.conservativeResize(1, 2); }},
    {"b has 2 numbers: 3 are expected", [](auto& t) { t.A.setZero(3, 3); }},
    {"b has 2 numbers: 1 are expected", [](auto& t) { t.A.conservativeResize(1, 1); }},
    {"A is 0 x 0: a square matrix of at least one row", [](auto& t) { t = {}; }},
    {"A[0, 1] = nan: a finite number", [](auto& t) { t.A(0, 1) = kNotANumber; }},
    {"A[1, 0] = inf: a finite number", [](auto& t) { t.A(1, 0) = kEndless; }},
    {"b[1] = nan: a finite number", [](auto& t) { t.b[1] = kNotANumber; }},
    {"b[0] = -inf: a finite number", [](auto& t) { t.b[0] = -kEndless; }},
    {"c[1] = nan: a finite number", [](auto& t) { t.c[1] = kNotANumber; }},
    {"c[0] = inf: a finite number", [](auto& t) { t.c[0] = kEndless; }},
    {"order = 0 is out of range: an integer from 1 to 4", [](auto& t) { t.order = 0; }},
    {"order = -1 is out of range: an integer from 1 to 4", [](auto& t) { t.order = -1; }},
    {"order = 5 is out of range: an integer from 1 to 4", [](auto& t) { t.order = 5; }},
    {"stage_order = -1 is out of range: an integer from 0 to 2", [](auto& t) { t.stage_order = -1; }},
    {"stage_order = 3 is out of range: an integer from 0 to 2", [](auto& t) { t.stage_order = 3; }},
};

// A vector b shorter than A once led to writes beyond the end of an array.
TEST(Misuse, TableausMadeByHandAreChecked) {
  const auto good = makeTableau<double>("radau_iia_2");
  IntegratorOptions variable = independentOptions<double>(adaptive(1e-6));
  for (const auto& [message, damage] : kDamages) {
    Tableau<double> bad = good;
    damage(bad);
    const std::string place = "tableau '" + bad.id + "': ";
    expectRefusals({
        {"Integrator", place + message,
         [&] { Integrator<double>(makeSystem<double>(Riccati{}), bad, adaptive(1e-6)); }},
        {"in 50 digits", place + message,
         [&] { Integrator<BigFloat>(makeSystem<BigFloat>(Riccati{}), bad.cast<BigFloat>(), adaptive(1e-6)); }},
        {"one of several", place + message,
         [&] {
           Integrator<double>(makeSystem<double>(Riccati{}), Methods<double>({good, bad}, 0), variable);
         }},
    });
  }
  EXPECT_EQ(refusal([&] { Integrator<double>(makeSystem<double>(Riccati{}), good, adaptive(1e-6)); }), "");
}

void make(const Methods<double>& methods, const IntegratorOptions& options = adaptive(1e-6)) {
  Integrator<double>(makeSystem<double>(Riccati{}), methods, options);
}

TEST(Misuse, MethodsAreChecked) {
  const auto two = makeTableau<double>("radau_iia_2"), three = makeTableau<double>("radau_iia_3");
  expectRefusals({
      {"no method", "with 0 methods",
       [] {
         make({{}, 0});
       }},
      {"several of fixed order", "with 2 methods, starting with number 0: several need order 'variable'",
       [&] {
         make({{two, three}, 0});
       }},
      {"a start beyond the last", "with 1 methods, starting with number 1",
       [&] {
         make({{two}, 1});
       }},
  });
}

// --- Options: ranges of numbers are in option_fields_test.cpp.

template <class Change>
std::function<void()> withOption(Change change) {
  return [change] {
    IntegratorOptions options = adaptive(1e-6);
    change(options);
    make(makeTableau<double>("radau_iia_2"), options);
  };
}

template <class E>
constexpr E kNoSuch = static_cast<E>(77);

TEST(Misuse, OptionsThatDoNotExistAreRefused) {
  using Options = IntegratorOptions;
  expectRefusals({
      {"derivatives", "unknown derivatives '?'",
       withOption([](Options& o) { o.derivatives = kNoSuch<DerivativeSource>; })},
      {"storage", "unknown storage '?'", withOption([](Options& o) { o.storage = kNoSuch<Storage>; })},
      {"summation", "unknown summation '?'", withOption([](Options& o) { o.summation = kNoSuch<Summation>; })},
      {"multipliers", "unknown multipliers '?'", withOption([](Options& o) { o.multipliers = kNoSuch<Multipliers>; })},
      {"point", "unknown jacobian_point '?'",
       withOption([](Options& o) { o.jacobian_point = kNoSuch<JacobianPoint>; })},
      {"guards", "unknown guards '?'", withOption([](Options& o) { o.guards = kNoSuch<Guards>; })},
      {"norm", "unknown norm '?'", withOption([](Options& o) { o.tolerances.norm = kNoSuch<NormKind>; })},
      {"newton", "unknown newton 'modifed'", withOption([](Options& o) { o.newton.kind = {{"modifed"}}; })},
      {"solver", "unknown solver 'lu'", withOption([](Options& o) { o.solver = {{"lu"}}; })},
      {"predictor", "unknown predictor ''", withOption([](Options& o) { o.predictor = {}; })},
      {"estimate", "unknown estimate 'best'", withOption([](Options& o) { o.step.estimate = {{"best"}}; })},
      {"control", "unknown control 'pid'", withOption([](Options& o) { o.step.control = {{"pid"}}; })},
      {"order", "unknown order '9'", withOption([](Options& o) { o.order = {{"9"}}; })},
      {"jacobian", "unknown jacobian 'half'", withOption([](Options& o) { o.jacobian = {{"half"}}; })},
      {"formulation", "unknown formulation '?'",
       [] { (void)makeSystem<double>(CartesianPendulum{}, {.formulation = kNoSuch<Formulation>}); }},
      {"scaling", "unknown scaling '?'",
       [] { (void)makeSystem<double>(CartesianPendulum{}, {.scaling = kNoSuch<ConstraintScaling>}); }},
      {"discontinuity", "unknown discontinuity 'jump'",
       [] { (void)makeSystem<double>(CartesianPendulum{}, {.discontinuity = {{"jump"}}}); }},
      {"ids", "unknown newton 'simplfied'; did you mean 'simplified'?", [] { (void)parseId<NewtonKind>("simplfied"); }},
      {"no id", "unknown storage ''", [] { (void)parseId<Storage>(""); }},
  });
}

TEST(Misuse, FactoriesThatMakeNothingAreRefused) {
  const StepControl mine{{"mine"}};
  const ControllerMaker empty, returns_null = [](const StepOptions&, int) { return nullptr; };
  expectRefusals({
      {"empty", "control 'mine': its factory is empty", [&] { madeBy(empty, mine, StepOptions{}, 3); }},
      {"null", "control 'mine': its factory returns null", [&] { madeBy(returns_null, mine, StepOptions{}, 3); }},
  });
}

// --- Systems that makeSystem has not made: u'' = -u, x' = -x with a discrete state and a switch.

class WrongSystem final : public System<double> {
 public:
  static constexpr Sizes kRight{.nu = 1, .nx = 1, .discrete = 1, .switches = 1};
  Sizes n = kRight, scene = kRight;
  std::vector<int> rows{0, 0};
  ErrorPowers errors{{0}, {0}, {0}, {}};
  std::vector<double> at{};
  std::function<void(State<double>&)> from_scene, to_scene, on_switch, jumped, on_time, step;

  Sizes sizes() const override { return n; }
  Sizes sceneSizes() const override { return scene; }
  void evaluate(Level, const Point<double>& p, VecView<double> r) const override { write(p, r); }
  void evaluate(Level, const Point<Dual<double>>& p, VecView<Dual<double>> r) const override { write(p, r); }
  const std::vector<int>& rowPowers() const override { return rows; }
  const ErrorPowers& errorPowers() const override { return errors; }
  State<double> fromScene(const State<double>& s) const override { return changed(from_scene, s); }
  State<double> toScene(const State<double>& s) const override { return changed(to_scene, s); }
  void switching(const Point<double>& p, VecView<double> g) const override { g[0] = p.d[0] > 0 ? -1.0 : p.t - 0.3; }
  void onSwitch(Index, State<double>& s) const override { s = changed(on_switch, s), s.d.array() += 1; }
  void jump(Index, State<double>& s) const override { s = changed(jumped, s); }
  std::vector<double> times() const override { return at; }
  void onTime(Index, State<double>& s) const override { s = changed(on_time, s); }
  bool completesSteps() const override { return step != nullptr; }
  bool completeStep(State<double>& s) const override { return s = changed(step, s), true; }
  Discontinuity discontinuity() const override { return Discontinuity::kLocate; }

 private:
  template <class T>
  static void write(const Point<T>& p, VecView<T> r) {
    r[0] = -p.u[0] - p.a[0];
    r[1] = -p.x[0] - p.k[0];
  }
  static State<double> changed(const std::function<void(State<double>&)>& change, State<double> s) {
    if (change) change(s);
    return s;
  }
};

// Integrates over a switch and two times, with every callback.
template <class Change>
std::function<void()> with(Change change) {
  return [change] {
    const auto system = std::make_shared<WrongSystem>();
    system->at = {0.5, 0.6};
    change(*system);
    Integrator<double> integrator(system, makeTableau<double>("radau_iia_2"), adaptive(1e-4));
    Monitor<double> monitor;
    monitor.inside = true;
    monitor.accepted = [](const StepRecord<double>& step) { (void)step.inside->at(step.t - step.h / 2); };
    monitor.located = [](const LocatedSwitch<double>&) {};
    const auto s = integrator.integrate(startOf(WrongSystem::kRight, {.x = {1}}), 1.0, monitor);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_EQ(s.counters.switches, 1);
    EXPECT_NEAR(s.state.x[0], std::exp(-1.0), 1e-3);
  };
}

TEST(Misuse, SystemsMadeByHandAreChecked) {
  using S = WrongSystem;
  using Changed = State<double>;
  EXPECT_EQ(refusal(with([](S&) {})), "");
  expectRefusals({
      {"no unknowns", "at least one unknown", with([](S& s) { s.n = {}; })},
      {"nz", "nz = -1", with([](S& s) { s.n.nz = -1; })},
      {"powers of rows", "powers of the rows: 1 numbers, 2 are expected", with([](S& s) { s.rows = {0}; })},
      {"a negative power", "rows: number 1 (from 0 on) = -1: 0, 1 or 2", with([](S& s) {
         s.rows = {0, -1};
       })},
      {"a large power", "rows: number 0 (from 0 on) = 3: 0, 1 or 2", with([](S& s) {
         s.rows = {3, 0};
       })},
      {"powers of u", "errors of u: 0 numbers, 1 are expected", with([](S& s) { s.errors.u = {}; })},
      {"powers of v", "errors of v: 2 numbers, 1 are expected", with([](S& s) {
         s.errors.v = {0, 0};
       })},
      {"powers of z", "errors of z: 1 numbers, 0 are expected", with([](S& s) { s.errors.z = {0}; })},
      {"a power of x", "errors of x: number 0 (from 0 on) = 9", with([](S& s) { s.errors.x = {9}; })},
      {"scene's sizes", "sizes: nx = -1", with([](S& s) { s.scene.nx = -1; })},
      {"another scene", "start: u: 1 numbers, 2 are expected", with([](S& s) { s.scene.nu = 2; })},
      {"a time", "times of the system: number 1 (from 0 on) = nan", with([](S& s) {
         s.at = {0.5, kNotANumber};
       })},
      {"order of times", "number 1 (from 0 on) = 0.2: finite", with([](S& s) {
         s.at = {0.5, 0.2};
       })},
      {"equal times", "number 2 (from 0 on) = 0.6: finite", with([](S& s) {
         s.at = {0.5, 0.6, 0.6};
       })},
      {"u", "System::fromScene: u: 0 numbers, 1", with([](S& s) { s.from_scene = [](Changed& y) { y.u.resize(0); }; })},
      {"v", "System::fromScene: v: 2 numbers, 1",
       with([](S& s) { s.from_scene = [](Changed& y) { y.v.setZero(2); }; })},
      {"x", "System::fromScene: x: 0 numbers, 1", with([](S& s) { s.from_scene = [](Changed& y) { y.x.resize(0); }; })},
      {"w", "System::fromScene: w = (a, k, z): 1 numbers, 2",
       with([](S& s) { s.from_scene = [](Changed& y) { y.w.setZero(1); }; })},
      {"d", "System::fromScene: discrete state d: 0 numbers, 1",
       with([](S& s) { s.from_scene = [](Changed& y) { y.d.resize(0); }; })},
      {"carry", "System::fromScene: carry: 0 numbers, 3",
       with([](S& s) { s.from_scene = [](Changed& y) { y.carry.resize(0); }; })},
      {"to scene", "System::toScene: x: 3 numbers, 1",
       with([](S& s) { s.to_scene = [](Changed& y) { y.x.setZero(3); }; })},
      {"at a switch", "System::onSwitch: discrete state d: 2 numbers, 1",
       with([](S& s) { s.on_switch = [](Changed& y) { y.d.setZero(2); }; })},
      {"a jump", "System::jump: u: 0 numbers, 1", with([](S& s) { s.jumped = [](Changed& y) { y.u.resize(0); }; })},
      {"at a time", "System::onTime: discrete state d: 0 numbers, 1",
       with([](S& s) { s.on_time = [](Changed& y) { y.d.resize(0); }; })},
      {"at the end of a step", "System::completeStep: x: 2 numbers, 1",
       with([](S& s) { s.step = [](Changed& y) { y.x.setZero(2); }; })},
  });
}

TEST(Misuse, SystemsInFirstOrderFormAreChecked) {
  const auto bad = std::make_shared<WrongSystem>();
  bad->rows.clear();
  const auto jumping = std::make_shared<WrongSystem>();
  jumping->jumped = [](State<double>& y) { y.u.setZero(5); };
  expectRefusals({
      {"null", "no system to integrate", [] { (void)firstOrderForm<double>(nullptr); }},
      {"powers", "powers of the rows: 0 numbers, 2", [&] { (void)firstOrderForm<double>(bad); }},
      {"a jump", "System::jump: u: 5 numbers, 1",
       [&] {
         Integrator<double> integrator(firstOrderForm<double>(jumping), makeTableau<double>("radau_iia_2"),
                                       adaptive(1e-4));
         (void)integrator.integrate(State<double>(jumping->n), 1.0);
       }},
      {"null to integrate", "no system to integrate",
       [] { Integrator<double>(nullptr, makeTableau<double>("radau_iia_2"), adaptive(1e-4)); }},
  });
}

// --- Starts and error bars

// Measures the error bar of a run of Riccati's equation after `change`.
template <class Change>
std::function<void()> measured(Change change) {
  return [change] {
    struct {
      State<double> result = riccatiStart<double>(), start = result;
      Tolerances tolerances{};
      Vec<double> scale{};
    } a;
    a.result.t = 1;
    change(a);
    Integrator<double> second(makeSystem<double>(Riccati{}), makeTableau<double>("radau_iia_3"), adaptive(1e-8));
    Solution<double> solution;
    (void)measureErrorBar(a.result, second, a.start, a.tolerances, a.scale, solution);
  };
}

TEST(Misuse, ErrorBarsOfImpossibleResultsAreRefused) {
  EXPECT_EQ(refusal(measured([](auto&) {})), "");
  expectRefusals({
      {"x", "the result: x: 2 numbers, 1", measured([](auto& a) { a.result.x.setZero(2); })},
      {"u", "the result: u: 1 numbers, 0", measured([](auto& a) { a.result.u.setZero(1); })},
      {"w", "the result: w = (a, k, z): 0 numbers, 1", measured([](auto& a) { a.result.w.resize(0); })},
      {"empty", "the result: x: 0 numbers, 1", measured([](auto& a) { a.result = State<double>(); })},
      {"start", "start: x: 3 numbers, 1", measured([](auto& a) { a.start = a.result = State<double>({.nx = 3}); })},
      {"no end", "t_end = nan", measured([](auto& a) { a.result.t = kNotANumber; })},
      {"scale", "scale: 3 numbers, 1 are expected", measured([](auto& a) { a.scale.setOnes(3); })},
      {"a scale", "scale[0] = 0: a finite number > 0", measured([](auto& a) { a.scale.setZero(1); })},
      {"rtol", "rtol = -1 is out of range: >= 0", measured([](auto& a) { a.tolerances.rtol = -1; })},
      {"no rtol", "rtol = nan is out of range", measured([](auto& a) { a.tolerances.rtol = kNotANumber; })},
      {"atol", "atol = 0 is out of range: > 0", measured([](auto& a) { a.tolerances.atol = 0; })},
      {"norm", "unknown norm '?'", measured([](auto& a) { a.tolerances.norm = kNoSuch<NormKind>; })},
  });
}

TEST(Misuse, AStartThatHasBeenMovedFromIsRefused) {
  Integrator<double> integrator(makeSystem<double>(Riccati{}), makeTableau<double>("radau_iia_3"), adaptive(1e-6));
  auto first = integrator.integrate(riccatiStart<double>(), 1.0);
  const auto second = std::move(first);
  EXPECT_EQ(integrator.integrate(second.state, 2.0).outcome, Outcome::kSuccess);
  // NOLINTNEXTLINE(bugprone-use-after-move): that is the test
  EXPECT_EQ(refusal([&] { (void)integrator.integrate(first.state, 2.0); }), "start: x: 0 numbers, 1 are expected");
}

}  // namespace
}  // namespace irk::test
