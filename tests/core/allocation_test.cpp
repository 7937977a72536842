// A step allocates nothing: malloc is counted from the second step to the end.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/core/support.h"

namespace {
bool counting = false;
long allocations = 0;
}  // namespace

// Eigen's aligned memory, operator new and the containers all end in malloc (glibc), which is
// interposed here.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  if (counting) ++allocations;
  return __libc_malloc(size);
}

namespace irk::test {
namespace {

template <class P>
long allocationsOf(P problem, const State<double>& start, const char* method,
                   const IntegratorOptions& options) {
  Integrator<double> integrator(makeSystem<double>(problem), makeTableau<double>(method), options);
  int steps = 0;
  long before_last_step = 0;
  Monitor<double> monitor;
  monitor.interrupt = [&] {
    counting = steps++ >= 1;
    before_last_step = allocations;
    return Outcome::kSuccess;
  };
  allocations = 0;
  const auto s = integrator.integrate(start, 1.0, monitor);
  counting = false;
  EXPECT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_GT(steps, 2);
  return before_last_step;  // the solution returned after it is the caller's
}

TEST(Allocation, TheCounterSeesAnAllocation) {
  allocations = 0;
  counting = true;
  const Vec<double> v(100);
  void* volatile p = std::malloc(8);
  counting = false;
  std::free(p);
  EXPECT_EQ(v.size(), 100);
  EXPECT_GE(allocations, 2);
}

TEST(Allocation, StepsAllocateNothing) {
  for (const auto& solver : named<StageSolverKind>()) {
    for (const auto& newton : named<NewtonKind>()) {
      const bool coupled = solver.value == StageSolverKind::kCoupledDense ||
                           solver.value == StageSolverKind::kCoupledSparse;
      if (newton.value == NewtonKind::kFull && !coupled) continue;
      for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiia_3", "radau_iia_20"}) {
        IntegratorOptions o = adaptive(1e-5);
        o.solver = solver.value;
        o.newton.kind = newton.value;
        const std::string what = std::string(solver.id) + " " + std::string(newton.id) + " " + method;
        EXPECT_EQ(allocationsOf(Oscillators{}, oscillatorsStart<double>(), method, o), 0) << what;
      }
    }
  }
  EXPECT_EQ(allocationsOf(CartesianPendulum{}, pendulumStart<double>(), "radau_iia_5",
                          fixedSteps(0.01)), 0);
}

}  // namespace
}  // namespace irk::test
