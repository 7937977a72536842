// The life of an integrator: moved from, called from its own callbacks, and exceptions of callbacks and systems.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/parallel_loop.h"
#include "tests/core/support.h"
#include "tests/misuse_table.h"

namespace irk::test {
namespace {

/// x_i' = -c_i x_i with a switch at t = 0.5; `called` is called in each residual, with t. Fewer unknowns than 100 are
/// integrated by one thread.
struct Watched : SwitchesOnceAt {
  std::function<void(double)> called;
  explicit Watched(std::function<void(double)> f = {}) : SwitchesOnceAt(0.5), called(std::move(f)) {}
  Sizes sizes() const { return {.nx = 100, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    if constexpr (std::is_same_v<T, double>) {
      if (called) called(p.t);
    }
    for (Index i = 0; i < r.x.size(); ++i) r.x[i] = -static_cast<double>(i % 4 + 1) * p.x[i] - p.k[i];
  }
};

// Of the interval [0, 1], a part that holds stages, but no point of the checks before the first step.
bool isInside(double t) { return t > 0.2 && t < 0.45; }

State<double> onesOf(const Watched& problem) {
  State<double> start(problem.sizes());
  start.x.setOnes();
  return start;
}

Integrator<double> integratorOf(const Watched& problem, int threads = 1) {
  IntegratorOptions options = adaptive(1e-6);
  options.threads = threads;
  return {makeSystem<double>(problem), makeTableau<double>("radau_iia_5"), options};
}

TEST(Reentry, AnIntegratorThatHasBeenMovedFromIsRefused) {
  const Watched problem;
  auto first = integratorOf(problem);
  auto second = std::move(first);
  EXPECT_EQ(second.integrate(onesOf(problem), 1.0).outcome, Outcome::kSuccess);
  // NOLINTNEXTLINE(bugprone-use-after-move): that is the test
  EXPECT_EQ(refusal([&] { (void)first.integrate(onesOf(problem), 1.0); }),
            "Integrator::integrate: the object has been moved from");
}

// A call from a callback would overwrite the state of the call that is under way.
TEST(Reentry, ACallFromACallbackIsRefused) {
  const Watched problem;
  auto integrator = integratorOf(problem);
  const auto again = [&] { (void)integrator.integrate(onesOf(problem), 1.0); };
  const auto from = [&](auto set) {
    return [&, set] {
      Monitor<double> monitor;
      set(monitor);
      (void)integrator.integrate(onesOf(problem), 1.0, monitor);
    };
  };
  const std::string message = "Integrator::integrate is called while another call of the same object is under way";
  expectRefusals({
      {"accepted", message, from([&](auto& m) { m.accepted = [&](const auto&) { again(); }; })},
      {"switched", message, from([&](auto& m) { m.switched = [&](const auto&) { again(); }; })},
      {"located", message, from([&](auto& m) { m.located = [&](const auto&) { again(); }; })},
      {"interrupt", message, from([&](auto& m) { m.interrupt = [&] { return again(), Outcome::kSuccess; }; })},
  });
  EXPECT_EQ(integrator.integrate(onesOf(problem), 1.0).outcome, Outcome::kSuccess) << "the next call works";
}

TEST(Reentry, ACallFromTheResidualIsRefused) {
  for (const int threads : {1, 2}) {
    Integrator<double>* own = nullptr;
    const Watched problem{[&own](double t) {
      if (isInside(t)) (void)own->integrate(onesOf(Watched{}), 1.0);
    }};
    auto integrator = integratorOf(problem, threads);
    own = &integrator;
    EXPECT_TRUE(contains(refusal([&] { (void)integrator.integrate(onesOf(problem), 1.0); }), "another call"))
        << threads;
  }
}

// What leaves a residual or a callback; empty if nothing does.
std::string thrownBy(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// With two threads an exception once ended the program. The stages are at c_i h: the first one is the first to throw.
TEST(Reentry, AnExceptionOfTheResidualReachesTheCallerWithAnyNumberOfThreads) {
  std::set<std::string> messages;
  for (const int threads : {1, 2, 4}) {
    const Watched problem{[](double t) {
      if (isInside(t)) throw std::runtime_error("no residual at t = " + std::to_string(t));
    }};
    auto integrator = integratorOf(problem, threads);
    const std::string message = thrownBy([&] { (void)integrator.integrate(onesOf(problem), 1.0); });
    EXPECT_TRUE(contains(message, "no residual at t = 0.")) << threads;
    messages.insert(message);
  }
  EXPECT_EQ(messages.size(), 1U) << "does not depend on the number of threads";
}

// Bit for bit as one that has never thrown.
TEST(Reentry, AnIntegratorMayBeUsedAfterAnException) {
  for (const int threads : {1, 2}) {
    auto fresh = integratorOf(Watched{}, threads);
    const auto expected = fresh.integrate(onesOf(Watched{}), 1.0);
    std::atomic<bool> throws = true;
    const Watched problem{[&throws](double t) {
      if (throws && isInside(t)) throw std::runtime_error("residual");
    }};
    auto integrator = integratorOf(problem, threads);
    EXPECT_EQ(thrownBy([&] { (void)integrator.integrate(onesOf(problem), 1.0); }), "residual");
    throws = false;
    Monitor<double> monitor;
    monitor.accepted = [](const auto&) { throw std::runtime_error("monitor"); };
    EXPECT_EQ(thrownBy([&] { (void)integrator.integrate(onesOf(problem), 1.0, monitor); }), "monitor");
    const auto s = integrator.integrate(onesOf(problem), 1.0);
    EXPECT_EQ(s.outcome, Outcome::kSuccess);
    EXPECT_EQ(s.state.x, expected.state.x);
    EXPECT_EQ(s.counters.steps_accepted, expected.counters.steps_accepted);
    EXPECT_EQ(s.counters.residuals, expected.counters.residuals);
  }
}

// Calls f(i) for i < n on four threads that take the next i when they are free.
void onFourThreads(std::size_t n, const std::function<void(std::size_t)>& f) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&] {
      for (std::size_t i = next++; i < n; i = next++) f(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(ParallelLoop, ThrowsTheExceptionOfTheFirstTurn) {
  for (int repetition = 0; repetition < 100; ++repetition) {
    ParallelLoop loop;
    std::atomic<int> made = 0;
    onFourThreads(64, [&](std::size_t i) {
      loop.turn(i, [&] {
        ++made;
        if (i % 2 == 1 && i > 20) throw std::runtime_error(std::to_string(i));
      });
    });
    EXPECT_TRUE(loop.hasThrown());
    EXPECT_EQ(thrownBy([&] { loop.rethrow(); }), "21");
    EXPECT_GE(made, 22) << "all turns before it are made";
  }
  ParallelLoop none;
  none.turn(0, [] {});
  EXPECT_FALSE(none.hasThrown());
  EXPECT_NO_THROW(none.rethrow());
}

TEST(ParallelLoop, WorksInTheDigitsOfTheThreadThatBeganIt) {
  const WorkingDigits digits(100);
  std::array<int, 16> of_turns{};
  ParallelLoop loop;
  onFourThreads(of_turns.size(), [&](std::size_t i) { loop.turn(i, [&] { of_turns[i] = WorkingDigits::now(); }); });
  for (const int of_turn : of_turns) EXPECT_EQ(of_turn, 100);
}

}  // namespace
}  // namespace irk::test
