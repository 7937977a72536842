// Steps allocate nothing: the test counts calls of malloc from the second step to the end.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string_view>

#include "irk/scene.h"
#include "tests/core/support.h"

namespace {
bool counting = false;
long allocations = 0, allocations_of_klu = 0;

// KLU allocates when it chooses new pivots, through SuiteSparse's own allocator.
bool isKlu(void* caller) {
  Dl_info info;
  if (dladdr(caller, &info) == 0 || info.dli_fname == nullptr) return false;
  const std::string_view library(info.dli_fname);
  return library.find("libklu") != library.npos || library.find("libsuitesparseconfig") != library.npos;
}
}  // namespace

// Eigen's aligned memory, operator new and the containers all call malloc (glibc), which is replaced here.
extern "C" void* __libc_malloc(std::size_t);  // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* malloc(std::size_t size) {
  if (counting) ++(isKlu(__builtin_return_address(0)) ? allocations_of_klu : allocations);
  return __libc_malloc(size);
}

namespace irk::test {
namespace {

long allocationsOf(Integrator<double>& integrator, const State<double>& start, double t_end) {
  int steps = 0;
  long before_last_step = 0;
  Monitor<double> monitor;
  monitor.interrupt = [&] {
    counting = steps++ >= 1;
    before_last_step = allocations;
    return Outcome::kSuccess;
  };
  allocations = 0;
  const auto s = integrator.integrate(start, t_end, monitor);
  counting = false;
  EXPECT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_GT(steps, 2);
  return before_last_step;  // the solution returned after it is the caller's
}

long allocationsOf(const std::shared_ptr<const System<double>>& system, const State<double>& start,
                   const Methods<double>& methods, const IntegratorOptions& options, double t_end = 1.0) {
  Integrator<double> integrator(system, methods, options);
  return allocationsOf(integrator, start, t_end);
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

// The constructor takes as long as ten steps of a small system, half of it for memory.
TEST(Allocation, ConstructorsOfSmallSystemsAllocateLittle) {
  const Scene<double> scene = makeScene<double>("van_der_pol");
  const auto system = scene.system({});
  IntegratorOptions o = embedded(1e-4);
  const auto allocationsOfConstructor = [&](const Methods<double>& methods) {
    const Integrator<double> first(system, methods, o);  // makes what the process keeps
    allocations = 0;
    counting = true;
    const Integrator<double> second(system, methods, o);
    counting = false;
    return allocations;
  };
  EXPECT_LE(allocationsOfConstructor(makeTableau<double>("radau_iia_3")), 90);
  o.order = OrderControl::kVariable;
  EXPECT_LE(allocationsOfConstructor(makeMethods<double>("radau_iia", 13, 3)), 105);
}

TEST(Allocation, StepsAllocateNothing) {
  for (const auto& solver : named<StageSolverKind>()) {
    for (const auto& newton : named<NewtonKind>()) {
      const bool coupled =
          solver.value == StageSolverKind::kCoupledDense || solver.value == StageSolverKind::kCoupledSparse;
      if (newton.value == NewtonKind::kFull && !coupled) continue;
      for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiia_3", "radau_iia_20"}) {
        const auto tableau = makeTableau<double>(method);
        IntegratorOptions o = adaptive(1e-5);
        o.solver = solver.value;
        o.newton.kind = newton.value;
        // `paper_rule` fails below what round-off allows, which with 20 stages is about 1e-3.
        o.newton.residual_tolerance = tableau.stages() == 20 ? 3e-3 : 1e-3;
        const std::string what = std::string(solver.id) + " " + std::string(newton.id) + " " + method;
        SCOPED_TRACE(what);
        EXPECT_EQ(allocationsOf(makeSystem<double>(Oscillators{}), oscillatorsStart<double>(), tableau, o), 0);
      }
    }
  }
  EXPECT_EQ(allocationsOf(makeSystem<double>(CartesianPendulum{}), pendulumStart<double>(),
                          makeTableau<double>("radau_iia_5"), fixedSteps(0.01)),
            0);
}

// Complete adaptive runs: dense up to s n = 300, sparse for any size.
TEST(Allocation, LargeSystemsAllocateNothingAfterTheFirstStep) {
  struct Case {
    int elements;
    Storage storage;
    int most_threads;  // with 14 elements there are less than the 100 unknowns from which threads are used
  };
  for (const Case& c : {Case{14, Storage::kDense, 1}, Case{14, Storage::kSparse, 1}, Case{250, Storage::kSparse, 2}}) {
    const Scene<double> scene = makeScene<double>("ancf_pendulum", {{"elements", std::to_string(c.elements)}});
    const auto system = scene.system({});
    const auto one = Methods<double>(makeTableau<double>("radau_iia_5"));
    for (const NewtonKind newton : {NewtonKind::kSimplified, NewtonKind::kBroyden, NewtonKind::kModified}) {
      for (const ErrorEstimate estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
        IntegratorOptions o = adaptive(1e-4);
        o.storage = c.storage;
        o.newton.kind = newton;
        o.step.estimate = estimate;
        o.step.h = 1e-5;
        for (const auto solver : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
          o.solver = solver;
          for (int threads = 1; threads <= c.most_threads; ++threads) {
            o.threads = threads;
            EXPECT_EQ(allocationsOf(system, scene.start, one, o, 5e-4), 0)
                << c.elements << " " << idOf(c.storage) << " " << idOf(newton) << " " << idOf(estimate) << " "
                << idOf(solver) << " " << threads << " threads";
          }
        }
      }
    }
  }
}

// A change of order allocates for a member that was not used before, and nothing from then on.
TEST(Allocation, VariableOrderAllocatesForNewMembersOnly) {
  IntegratorOptions o = variable(1e-9);
  o.newton.kind = NewtonKind::kBroyden;
  const auto methods = makeMethods<double>("radau_iia_2", 13, 5);
  const auto expect = [&](const std::shared_ptr<const System<double>>& system, const State<double>& start, double t_end,
                          const std::string& what) {
    Integrator<double> integrator(system, methods, o);
    EXPECT_GT(allocationsOf(integrator, start, t_end), 0) << what;
    EXPECT_EQ(allocationsOf(integrator, start, t_end), 0) << what;
  };
  expect(makeSystem<double>(Oscillators{}), oscillatorsStart<double>(), 5, "oscillators");
  for (const Storage storage : {Storage::kDense, Storage::kSparse}) {
    const Scene<double> scene = makeScene<double>("ancf_pendulum", {{"elements", "14"}});
    o.storage = storage;
    for (const auto solver : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
      o.solver = solver;
      expect(scene.system({}), scene.start, 2e-2, std::string(idOf(storage)) + " " + std::string(idOf(solver)));
    }
  }
}

// The first switch allocates what all later ones use, and the object of the monitor is the caller's.
TEST(Allocation, LaterSwitchesAllocateNothing) {
  for (const char* id : {"bouncing_mass", "stick_slip", "elastoplastic", "dc_motor_chopper", "sampled_control",
                         "hydraulic_arm", "mechatronic_crank"}) {
    const Scene<double> scene = makeScene<double>(id);
    for (const auto& o : {adaptive(1e-5), embedded(1e-5)}) {
      Integrator<double> integrator(scene.system({}), makeTableau<double>("radau_iia_3"), o, scene.scale);
      const double t_end = static_cast<double>(scene.t_end);
      EXPECT_GE(integrator.integrate(scene.start, t_end).counters.switches, 2) << id;
      EXPECT_EQ(allocationsOf(integrator, scene.start, t_end), 0) << id << " " << idOf(o.step.estimate);
    }
  }
}

}  // namespace
}  // namespace irk::test
