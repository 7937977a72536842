// Sparse systems: the pattern, its colours, sparse solvers against their dense twins, threads.
#include <gtest/gtest.h>

#include <random>

#include "core/derivatives/pattern_search.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/system/counting.h"
#include "irk/scene.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

Scene<double> sceneOf(const char* id, const char* parameter, int value) {
  return makeScene<double>(id, {{parameter, std::to_string(value)}});
}

Linearization<double> linearize(const System<double>& system, const State<double>& at, Storage storage,
                                std::size_t* directions = nullptr) {
  Differentiator<double> differentiator(system, DerivativeSource::kAutomatic, JacobianTerms::kFull, storage);
  Linearization<double> D;
  differentiator.evaluate(Level::kFormulated, pointOf(at), D);
  if (directions) *directions = differentiator.directions();
  return D;
}

// Moves a state away from the special points at which scenes start.
State<double> moved(State<double> s) {
  std::minstd_rand random(3);
  std::uniform_real_distribution<double> either_way(-1, 1);
  for (auto* part : {&s.u, &s.v, &s.x, &s.w}) {
    for (double& y : *part) y += 1e-3 * either_way(random) * (1 + std::abs(y));
  }
  return s;
}

Mat<double> dense(const Pattern& p, const Vec<double>& values) {
  Mat<double> M = Mat<double>::Zero(p.n, p.n);
  for (Index j = 0; j < p.n; ++j) {
    const auto c = static_cast<std::size_t>(j);
    for (int k = p.column_start[c]; k < p.column_start[c + 1]; ++k) {
      M(p.row[static_cast<std::size_t>(k)], j) = values[k];
    }
  }
  return M;
}

// Differentiates column by column, without a pattern.
Mat<double> columns(const System<double>& system, const State<double>& at, int matrix) {
  const Sizes n = system.sizes();
  PointBuffers<Dual<double>> p(n);
  p.copy(pointOf(at));
  Mat<double> M = Mat<double>::Zero(n.n(), n.n());
  for (const Direction& d : allDirections(n)) {
    if (d.matrix != matrix) continue;
    p.component(d).d[0] = 1;
    system.evaluate(Level::kFormulated, p.at(Dual<double>(at.t)), p.residual());
    p.component(d).d[0] = 0;
    for (Index i = 0; i < n.n(); ++i) M(i, d.column) = p.r[i].d[0];
  }
  return M;
}

TEST(Sparse, DerivativesOfEverySceneEqualThoseColumnByColumn) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    for (const Formulation formulation : {Formulation::kIndex2, Formulation::kGgl}) {
      const Scene<double> scene = makeScene<double>(entry.id, {});
      const auto system = scene.system({formulation});
      const State<double> start = system->fromScene(scene.start);
      Differentiator<double> differentiator(*system, DerivativeSource::kAutomatic, JacobianTerms::kFull,
                                            Storage::kSparse);
      for (const State<double>& at : {start, moved(start)}) {
        Linearization<double> D;
        differentiator.evaluate(Level::kFormulated, pointOf(at), D);
        ASSERT_FALSE(D.pattern->full);
        EXPECT_EQ(dense(*D.pattern, D.d0), columns(*system, at, 0)) << entry.id;
        EXPECT_EQ(dense(*D.pattern, D.d1), columns(*system, at, 1)) << entry.id;
        EXPECT_EQ(dense(*D.pattern, D.d2), columns(*system, at, 2)) << entry.id;
      }
    }
  }
}

TEST(Sparse, TheNumberOfDirectionsDoesNotGrowWithN) {
  const auto directions = [](const Scene<double>& scene) {
    std::size_t count = 0;
    linearize(*scene.system({}), moved(scene.start), Storage::kSparse, &count);
    return count;
  };
  // D0 is diagonal; D1 and D2 have five diagonals.
  EXPECT_EQ(directions(sceneOf("beam_chain", "m", 200)), 11u);
  EXPECT_EQ(directions(sceneOf("beam_chain", "m", 4000)), 11u);
  // A node and its two neighbours have 3 x 2 columns of M and 3 x 4 of the stiffness. Greedy colouring may need more
  // colours.
  const std::size_t small = directions(sceneOf("ancf_pendulum", "elements", 50));
  EXPECT_GE(small, 18u);
  EXPECT_LE(small, 24u);
  EXPECT_EQ(directions(sceneOf("ancf_pendulum", "elements", 1000)), small);
}

// Springs between neighbours; in mode 1 the last mass also pulls at the first one.
struct LateContact : SwitchesOnceAt {
  LateContact() : SwitchesOnceAt(0.3) {}
  Index m = 60;
  Sizes sizes() const { return {.nu = m, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < m; ++i) {
      const T left = i > 0 ? p.u[i - 1] : T(0.0);
      const T right = i + 1 < m ? p.u[i + 1] : T(0.0);
      r.u[i] = 400.0 * (left - 2.0 * p.u[i] + right) - 0.5 * p.v[i] - p.a[i];
    }
    if (p.d[0] > T(0.5)) r.u[0] += 1e4 * (p.u[m - 1] - p.u[0]);
  }
};

State<double> plucked(Index m) {
  State<double> s(Sizes{.nu = m, .discrete = 1});
  for (Index i = 0; i < m; ++i) s.u[i] = std::sin(0.2 * static_cast<double>(i));
  return s;
}

TEST(Sparse, FollowsAPatternThatASwitchChanges) {
  const auto system = makeSystem<double>(LateContact{});
  Differentiator<double> differentiator(*system, DerivativeSource::kAutomatic, JacobianTerms::kFull, Storage::kSparse);
  State<double> s = plucked(60);
  Linearization<double> D;
  differentiator.evaluate(Level::kFormulated, pointOf(s), D);
  const Index before = D.pattern->nonzeros();
  s.d[0] = 1;
  differentiator.evaluate(Level::kFormulated, pointOf(s), D);
  EXPECT_EQ(D.pattern->nonzeros(), before + 1);
  EXPECT_EQ(dense(*D.pattern, D.d2)(0, 59), 1e4);
  EXPECT_EQ(dense(*D.pattern, D.d2), columns(*system, s, 2));
}

// A coupling that exists only close to the start. The first search for the pattern, near the start, misses it; the
// check at evaluation finds it.
struct NarrowContact {
  Index m = 40;
  Sizes sizes() const { return {.nu = m, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < m; ++i) r.u[i] = -p.u[i] - p.a[i];
    using std::abs;
    if (abs(p.u[m - 1]) < T(1e-6)) r.u[0] += 7.0 * p.u[m - 1];
  }
};

TEST(Sparse, FindsEntriesThatTheFirstSearchMissed) {
  const auto system = makeSystem<double>(NarrowContact{});
  Differentiator<double> differentiator(*system, DerivativeSource::kAutomatic, JacobianTerms::kFull, Storage::kSparse);
  const State<double> s(Sizes{.nu = 40});
  Linearization<double> D;
  differentiator.evaluate(Level::kFormulated, pointOf(s), D);
  EXPECT_EQ(dense(*D.pattern, D.d2)(0, 39), 7);
}

Solution<double> solve(const std::shared_ptr<const System<double>>& system, const State<double>& start, double t_end,
                       const IntegratorOptions& options, const char* method = "radau_iia_5") {
  return Integrator<double>(system, makeTableau<double>(method), options).integrate(start, t_end);
}

void expectSame(const Solution<double>& a, const Solution<double>& b, double tolerance, const std::string& what) {
  ASSERT_EQ(a.outcome, Outcome::kSuccess) << what << ": " << a.detail;
  ASSERT_EQ(b.outcome, Outcome::kSuccess) << what << ": " << b.detail;
  EXPECT_LE((a.state.u - b.state.u).norm(), tolerance * (1 + a.state.u.norm())) << what;
  EXPECT_LE((a.state.v - b.state.v).norm(), tolerance * (1 + a.state.v.norm())) << what;
  EXPECT_EQ(a.counters.steps_accepted, b.counters.steps_accepted) << what;
  EXPECT_EQ(a.counters.jacobians, b.counters.jacobians) << what;
}

TEST(Sparse, RunsEqualTheirDenseTwins) {
  const Scene<double> ancf = sceneOf("ancf_pendulum", "elements", 8);
  const auto contact = makeSystem<double>(LateContact{});
  for (const StageSolverKind kind : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
    IntegratorOptions o = fixedSteps(2e-3);
    o.solver = kind;
    const auto with = [&](Storage storage) {
      IntegratorOptions other = o;
      other.storage = storage;
      return other;
    };
    const std::string what(idOf(kind));
    const auto system = ancf.system({});
    expectSame(solve(system, ancf.start, 0.04, with(Storage::kDense)),
               solve(system, ancf.start, 0.04, with(Storage::kSparse)), 1e-10, "ancf " + what);
    o = fixedSteps(0.05);
    o.solver = kind;
    expectSame(solve(contact, plucked(60), 0.5, with(Storage::kDense)),
               solve(contact, plucked(60), 0.5, with(Storage::kSparse)), 1e-10, "contact " + what);
  }
}

TEST(Sparse, DenseFactorsAreKeptForMoreSteps) {
  const Scene<double> chain = sceneOf("beam_chain", "m", 120);
  IntegratorOptions o = embedded(1e-5);
  o.storage = Storage::kSparse;
  const auto sparse = solve(chain.system({}), chain.start, 0.5, o, "radau_iia_5");
  o.storage = Storage::kDense;
  const auto dense = solve(chain.system({}), chain.start, 0.5, o, "radau_iia_5");
  ASSERT_EQ(sparse.outcome, Outcome::kSuccess);
  ASSERT_EQ(dense.outcome, Outcome::kSuccess);
  EXPECT_LT(3 * dense.counters.factorizations, 2 * sparse.counters.factorizations);
  EXPECT_GT(dense.counters.steps_accepted, sparse.counters.steps_accepted);
  EXPECT_LT(2 * dense.counters.steps_accepted, 3 * sparse.counters.steps_accepted);
  EXPECT_LE((dense.state.u - sparse.state.u).norm(), 1e-4 * (1 + sparse.state.u.norm()));
}

TEST(Sparse, CoupledSparseEqualsCoupledDense) {
  const Scene<double> ancf = sceneOf("ancf_pendulum", "elements", 6);
  for (const auto& newton : named<NewtonKind>()) {
    IntegratorOptions o = fixedSteps(2e-3);
    o.newton.kind = newton.value;
    o.solver = StageSolverKind::kCoupledDense;
    const auto a = solve(ancf.system({}), ancf.start, 0.02, o, "gauss_3");
    o.solver = StageSolverKind::kCoupledSparse;
    expectSame(a, solve(ancf.system({}), ancf.start, 0.02, o, "gauss_3"), 1e-10, std::string(newton.id));
  }
}

TEST(Sparse, ReusedIntegratorsGiveTheSameBits) {
  const Scene<double> ancf = sceneOf("ancf_pendulum", "elements", 12);
  IntegratorOptions o = adaptive(1e-4);
  o.storage = Storage::kSparse;
  o.newton.kind = NewtonKind::kModified;  // `simplified` remembers the last step's contraction
  Integrator<double> integrator(ancf.system({}), makeTableau<double>("radau_iia_3"), o);
  const auto a = integrator.integrate(ancf.start, 0.05);
  const auto b = integrator.integrate(ancf.start, 0.05);
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.counters.dual_residuals, b.counters.dual_residuals);
}

void expectSameBits(const System<double>& system, const Solution<double>& one, const Solution<double>& other) {
  ASSERT_EQ(one.outcome, Outcome::kSuccess) << one.detail;
  ASSERT_EQ(other.outcome, Outcome::kSuccess) << other.detail;
  ASSERT_GE(system.sizes().n(), 100) << "else one thread is used";
  EXPECT_EQ(one.state.u, other.state.u);
  EXPECT_EQ(one.state.v, other.state.v);
  EXPECT_EQ(one.state.x, other.state.x);
  EXPECT_EQ(one.state.w, other.state.w);
  std::vector<std::int64_t> counts;
  one.counters.forEach([&counts](const char*, std::int64_t count) { counts.push_back(count); });
  std::size_t i = 0;
  other.counters.forEach([&](const char* name, std::int64_t count) { EXPECT_EQ(count, counts[i++]) << name; });
}

TEST(Sparse, ThreadsChangeNoBit) {
  const Scene<double> ancf = sceneOf("ancf_pendulum", "elements", 26);
  const auto system = ancf.system({});
  for (const Storage storage : {Storage::kDense, Storage::kSparse}) {
    for (const auto solver : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
      for (const ErrorEstimate estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
        SCOPED_TRACE(std::string(idOf(storage)) + " " + std::string(idOf(solver)) + " " + std::string(idOf(estimate)));
        IntegratorOptions o = adaptive(1e-4);
        o.storage = storage;
        o.solver = solver;
        o.step.estimate = estimate;
        for (const double end : {0.01, -0.01}) {  // backward in time, too
          o.threads = 1;
          const auto one = solve(system, ancf.start, end, o);
          for (const int threads : {2, 3, 8}) {
            SCOPED_TRACE(threads);
            o.threads = threads;
            expectSameBits(*system, one, solve(system, ancf.start, end, o));
          }
        }
      }
    }
  }
}

// So many unknowns that vectors are divided among threads.
TEST(Sparse, ThreadsOnPartsOfLongVectorsChangeNoBit) {
  struct Case {
    const char *scene, *parameter;
    double t_end;
  };
  for (const Case& c : {Case{"heat", "n", 0.01}, Case{"beam_chain", "m", 0.002}}) {
    const Scene<double> scene = sceneOf(c.scene, c.parameter, 5001);
    const auto system = scene.system({});
    for (const NewtonKind newton : {NewtonKind::kSimplified, NewtonKind::kBroyden}) {
      for (const ErrorEstimate estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
        SCOPED_TRACE(std::string(c.scene) + " " + std::string(idOf(newton)) + " " + std::string(idOf(estimate)));
        IntegratorOptions o = adaptive(1e-5);
        o.newton.kind = newton;
        o.solver = StageSolverKind::kEigen;
        o.step.estimate = estimate;
        const auto one = solve(system, scene.start, c.t_end, o, "radau_iia_9");
        for (const int threads : {2, 3, 4}) {
          SCOPED_TRACE(threads);
          o.threads = threads;
          expectSameBits(*system, one, solve(system, scene.start, c.t_end, o, "radau_iia_9"));
        }
      }
    }
  }
}

TEST(Sparse, IllegalCombinationsAreRefused) {
  const auto with = [](StageSolverKind solver, Storage storage, int threads, Formulation formulation) {
    IntegratorOptions o = adaptive(1e-5);
    o.solver = solver;
    o.storage = storage;
    o.threads = threads;
    return refusal([&] {
      Integrator<double>(makeSystem<double>(Oscillators{}, {formulation}), makeTableau<double>("gauss_2"), o);
    });
  };
  EXPECT_TRUE(contains(with(StageSolverKind::kCoupledDense, Storage::kSparse, 1, Formulation::kIndex2),
                       "'coupled_dense' with storage 'sparse'"));
  EXPECT_TRUE(contains(with(StageSolverKind::kSchur, Storage::kAutomatic, 0, Formulation::kIndex2), "threads = 0"));
  EXPECT_TRUE(contains(with(StageSolverKind::kSchur, Storage::kAutomatic, 2, Formulation::kFirstOrder), "first_order"));
}

}  // namespace
}  // namespace irk::test
