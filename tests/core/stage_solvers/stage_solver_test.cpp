// All stage solvers agree with the simplest one, the coupled dense solver.
#include <gtest/gtest.h>
#include <Eigen/LU>

#include <random>

#include "core/stage_solvers/stage_solver.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

struct StageProblem {
  const char* name;
  std::shared_ptr<const System<double>> system;
  State<double> start;
};

std::vector<StageProblem> cases() {
  return {{"ODE", makeSystem<double>(Riccati{}), riccatiStart<double>()},
          {"second order", makeSystem<double>(Oscillators{}), oscillatorsStart<double>()},
          {"index 2", makeSystem<double>(CartesianPendulum{}), pendulumStart<double>()}};
}

void expectSame(const StageProblem& c, const std::string& method, StageSolverKind kind) {
  const auto run = [&](StageSolverKind solver) {
    IntegratorOptions o = fixedSteps(0.05);
    o.solver = solver;
    o.newton.kind = NewtonKind::kModified;
    o.newton.residual_tolerance = 1e-6;
    return Integrator<double>(c.system, makeTableau<double>(method), o).integrate(c.start, 0.5);
  };
  const auto a = run(StageSolverKind::kCoupledDense);
  const auto b = run(kind);
  const std::string what = std::string(c.name) + ", " + method + ", " + std::string(idOf(kind));
  ASSERT_EQ(a.outcome, Outcome::kSuccess) << what << ": " << a.detail;
  ASSERT_EQ(b.outcome, Outcome::kSuccess) << what << ": " << b.detail;
  // Newton stops at round-off, where one of both may need another iteration in some of the steps.
  EXPECT_NEAR(static_cast<double>(a.counters.newton_iterations), static_cast<double>(b.counters.newton_iterations),
              static_cast<double>(a.counters.steps_accepted))
      << what;
  EXPECT_EQ(a.counters.newton_restarts, b.counters.newton_restarts) << what;
  const auto near = [&](const auto& x, const auto& y) {
    if (x.size() == 0) return;
    EXPECT_LE((x - y).norm(), 1e-12 * (1 + x.norm())) << what;
  };
  near(a.state.u, b.state.u);
  near(a.state.v, b.state.v);
  near(a.state.x, b.state.x);
}

TEST(StageSolver, DecoupledEqualsCoupled) {
  for (const StageProblem& c : cases()) {
    for (const int s : {1, 2, 3, 5, 7, 10}) {
      const std::string method = "radau_iia_" + std::to_string(s);
      expectSame(c, method, StageSolverKind::kSchur);
      expectSame(c, method, StageSolverKind::kEigen);
    }
    for (const int s : {14, 20}) {
      expectSame(c, "radau_iia_" + std::to_string(s), StageSolverKind::kSchur);
    }
    expectSame(c, "lobatto_iiia_4", StageSolverKind::kSchur);
    expectSame(c, "gauss_4", StageSolverKind::kEigen);
  }
}

// Solves once with random D0, D1, D2 and compares with the complete matrix. Measured at s = 5: dense 3e-16, Schur
// 1e-15, eigen 4e-15; the error of eigen grows by 3.7 per stage.
TEST(StageSolver, SolvesTheMatrixWrittenOut) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto random = [&](Index rows, Index columns) {
    return Mat<double>(Mat<double>::NullaryExpr(rows, columns, [&] { return normal(generator); }));
  };
  // Sizes below and above the limits up to which blocks are inverted in registers (8) and in memory (32).
  for (const Sizes& sizes :
       {Sizes{.nu = 3, .nx = 2, .nz = 1, .constraints = 1}, Sizes{.nu = 4, .nx = 3, .nz = 1, .constraints = 1},
        Sizes{.nu = 6, .nx = 4, .nz = 1, .constraints = 1}, Sizes{.nu = 10, .nx = 7, .nz = 1, .constraints = 1},
        Sizes{.nu = 20, .nx = 12, .nz = 1, .constraints = 1}}) {
    const Index n = sizes.n();
    for (const char* method : {"radau_iia_5", "gauss_4", "lobatto_iiic_3", "radau_ia_2"}) {
      const auto tableau = makeTableau<double>(method);
      const Index s = tableau.stages();
      Linearization<double> D(Pattern::dense(n));
      const Mat<double> D0 = random(n, n);
      Mat<double> D1 = random(n, n), D2 = random(n, n);
      D1.rightCols(sizes.nz).setZero();
      D2.rightCols(sizes.nx + sizes.nz).setZero();
      D.d0 = D0.reshaped();
      D.d1 = D1.reshaped();
      D.d2 = D2.reshaped();
      std::vector<int> powers(static_cast<std::size_t>(n), 0);
      powers.back() = 1;
      const double h = 0.37;
      Mat<double> J(s * n, s * n);
      const Mat<double> A2 = tableau.A * tableau.A;
      for (Index i = 0; i < s; ++i) {
        for (Index j = 0; j < s; ++j) {
          auto block = J.block(i * n, j * n, n, n);
          block = h * tableau.A(i, j) * D1 + h * h * A2(i, j) * D2;
          if (i == j) block += D0;
          block.row(n - 1) /= h;
        }
      }
      const Mat<double> b = random(n, s);
      const Mat<double> expected = J.fullPivLu().solve(b.reshaped().matrix()).reshaped(n, s);
      const double condition = J.norm() * J.inverse().norm();
      for (const auto& kind : named<StageSolverKind>()) {
        const auto solver = makeStageSolver<double>(kind.value, {tableau.A, D.pattern, powers, sizes});
        ASSERT_EQ(solver->factorize({&D, 1}, h), Outcome::kSuccess);
        Mat<double> x = b;
        solver->solve(x);
        // 50 eps cond bounds the error of the coupled LU; eigen has its eigenvectors' condition in addition (1.7e2 at
        // s = 5).
        EXPECT_LE((x - expected).norm() / expected.norm(), 200 * 2.2e-16 * condition * 50)
            << method << " " << kind.id << " " << n;
      }
    }
  }
}

TEST(StageSolver, SingularAndNotFiniteAreOutcomes) {
  const auto tableau = makeTableau<double>("radau_iia_2");
  for (const Index n : {2, 12, 40}) {
    const Sizes sizes{.nu = 0, .nx = n - 1, .nz = 1, .constraints = 0};
    const std::vector<int> powers(static_cast<std::size_t>(n), 0);
    for (const auto& kind : named<StageSolverKind>()) {
      Linearization<double> D(Pattern::dense(n));
      const auto solver = makeStageSolver<double>(kind.value, {tableau.A, D.pattern, powers, sizes});
      EXPECT_EQ(solver->factorize({&D, 1}, 0.1), Outcome::kSingular) << kind.id << " " << n;
      D.d0.setConstant(std::nan(""));
      EXPECT_EQ(solver->factorize({&D, 1}, 0.1), Outcome::kNotFinite) << kind.id << " " << n;
    }
  }
}

// Without a form in its setup the solver makes one.
TEST(StageSolver, EigenRefusesADefectiveTableau) {
  const auto tableau = makeTableau<double>("lobatto_iiics_3");
  const std::vector<int> powers(1, 0);
  const auto message = refusal([&] {
    makeStageSolver<double>(StageSolverKind::kEigen, {tableau.A, Pattern::dense(1), powers, Sizes{.nu = 0, .nx = 1}});
  });
  EXPECT_TRUE(contains(message, "defective"));
}

}  // namespace
}  // namespace irk::test
