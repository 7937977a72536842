// Scenes as the equations that peers take, and the solvers that suit their Jacobians.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/fields.h"
#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/peers/problem/make_problem.h"
#include "experiments/runs/run.h"
#include "irk/integrator.h"
#include "irk/problem.h"
#include "irk/tableaus.h"
#include "tests/experiments/heat.h"
#include "tests/experiments/runs/peer_runs.h"

namespace irk {
namespace {

struct Made {
  std::shared_ptr<const System<double>> system;
  std::unique_ptr<SceneProblem> problem;
  State<double> state;
  PeerValues at;
};

Made make(PeerForm form, const Scene<double>& scene, Formulation formulation, Storage storage) {
  Made made;
  made.system = scene.system({form == PeerForm::kOde ? Formulation::kFirstOrder : formulation});
  made.state = made.system->fromScene(scene.start);
  made.problem = makeProblem(form, *made.system, made.state, {DerivativeSource::kAutomatic, storage, true});
  EXPECT_EQ(made.problem->begin(made.state, true, made.at).outcome, Outcome::kSuccess);
  return made;
}

Mat<double> full(const PeerJacobian& J) {
  Mat<double> all(J.pattern->n, J.pattern->n);
  J.writeFull(all.data(), J.pattern->n);
  return all;
}

// Central differences of f or F.
Mat<double> differences(PeerProblem& problem, PeerForm form, double t, Vec<double> y, Vec<double> yp, double c) {
  const Index n = problem.layout().n;
  Mat<double> J(n, n);
  Vec<double> up(n), down(n);
  const auto evaluate = [&](Vec<double>& to) {
    const auto evaluated = form == PeerForm::kDae ? problem.residual(t, y.data(), yp.data(), to.data())
                                                  : problem.rates(t, y.data(), to.data());
    EXPECT_EQ(evaluated, Evaluated::kDone);
  };
  for (Index j = 0; j < n; ++j) {
    const double d = 1e-6 * (1 + std::abs(y[j]));
    y[j] += d;
    if (form == PeerForm::kDae) yp[j] += c * d;
    evaluate(up);
    y[j] -= 2 * d;
    if (form == PeerForm::kDae) yp[j] -= 2 * c * d;
    evaluate(down);
    y[j] += d;
    if (form == PeerForm::kDae) yp[j] += c * d;
    J.col(j) = (up - down) / (2 * d);
  }
  return J;
}

TEST(PeerProblems, JacobiansAreThoseOfDifferences) {
  for (const char* id : {"kepler", "pendulum", "slider_crank", "van_der_pol", "beam_chain", "index1_nonlinear"}) {
    const auto scene = makeScene<double>(id);
    for (const PeerForm form : {PeerForm::kOde, PeerForm::kMass, PeerForm::kDae}) {
      const Made made = make(form, scene, Formulation::kIndex1, Storage::kAutomatic);
      PeerJacobian J;
      const double c = 3;
      PeerProblem& problem = *made.problem;
      ASSERT_EQ(problem.jacobian(0, made.at.y.data(), made.at.yp.data(), c, J), Evaluated::kDone);
      const Mat<double> expected = differences(problem, form, 0, made.at.y, made.at.yp, c);
      EXPECT_LT((full(J) - expected).norm(), 1e-6 * (1 + expected.norm())) << id << " " << static_cast<int>(form);
    }
  }
}

// The rates of the system in first-order form, which solves for them, to the last bit. slider_crank: its mass depends
// on the state, so that there is no other way.
TEST(PeerProblems, RatesAreThoseOfTheFirstOrderForm) {
  for (const char* id : {"kepler", "slider_crank", "van_der_pol", "beam_chain", "hires", "stick_slip"}) {
    const Made made = make(PeerForm::kOde, makeScene<double>(id), Formulation::kIndex1, Storage::kAutomatic);
    const Index n = made.problem->layout().n;
    State<double> at = made.state;
    at.x.array() += 0.01;
    at.w.setZero();
    Vec<double> rates(n), expected(n);
    ASSERT_EQ(made.problem->rates(at.t, at.x.data(), rates.data()), Evaluated::kDone) << id;
    made.system->evaluate(Level::kFormulated, pointOf(at), {expected.data(), n});
    EXPECT_EQ(rates, expected) << id;
    EXPECT_GT(rates.norm(), 0) << id;
  }
}

// x' = -x, with a factor before x' that is another one far from the start.
struct HeavyFarAway {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const double factor = p.x[0] > T(10.0) ? 4 : 1;
    r.x[0] = -p.x[0] - factor * p.k[0];
  }
};

// The Jacobian notices a mass that is no longer the one at the start; from then on it is solved for.
TEST(PeerProblems, AMassThatChangesLaterIsNoticed) {
  const auto system = makeSystem<double>(HeavyFarAway{}, {Formulation::kFirstOrder});
  State<double> start(system->sizes());
  start.x[0] = 1;
  start = system->fromScene(start);
  const auto problem = makeProblem(PeerForm::kOde, *system, start, {});
  PeerValues at;
  ASSERT_EQ(problem->begin(start, true, at).outcome, Outcome::kSuccess);
  const double far = 20;
  PeerJacobian J;
  double rate = 0;
  ASSERT_EQ(problem->jacobian(0, &far, nullptr, 0, J, nullptr), Evaluated::kDone);
  EXPECT_DOUBLE_EQ(J.values[0], -0.25);
  ASSERT_EQ(problem->rates(0, &far, &rate), Evaluated::kDone);
  EXPECT_DOUBLE_EQ(rate, -5);
}

// The start satisfies M y' = f(t, y). Accelerations are unknowns where their factor depends on the state: on the mass
// of slider_crank, and on the constraint of pendulum in index 1.
TEST(PeerProblems, TheMassFormHoldsAtTheStart) {
  const auto added = [](const char* id, Formulation formulation) {
    const auto scene = makeScene<double>(id);
    const Made made = make(PeerForm::kMass, scene, formulation, Storage::kAutomatic);
    const Index n = made.problem->layout().n;
    Vec<double> f(n);
    EXPECT_EQ(made.problem->rates(0, made.at.y.data(), f.data()), Evaluated::kDone);
    const Vec<double> difference = full(made.problem->mass()) * made.at.yp - f;
    EXPECT_LT(difference.norm(), 1e-10 * (1 + f.norm())) << id;
    EXPECT_GT(f.norm(), 0) << id;
    return n - made.system->sizes().components();
  };
  EXPECT_EQ(added("pendulum", Formulation::kIndex2), 0);
  EXPECT_EQ(added("pendulum", Formulation::kIndex1), 2);
  EXPECT_EQ(added("slider_crank", Formulation::kIndex2), 2);
  EXPECT_EQ(added("index1_nonlinear", Formulation::kIndex2), 0);
}

TEST(PeerProblems, PatternsAreFound) {
  const Scene<double> heat = heatScene();
  for (const PeerForm form : {PeerForm::kOde, PeerForm::kMass, PeerForm::kDae}) {
    const Made made = make(form, heat, Formulation::kIndex2, Storage::kAutomatic);
    const auto pattern = made.problem->pattern();
    EXPECT_FALSE(pattern->full);
    EXPECT_EQ(pattern->lower, 1);
    EXPECT_EQ(pattern->upper, 1);
    EXPECT_EQ(pattern->row.size(), static_cast<std::size_t>(3 * kHeatPoints - 2));
    EXPECT_TRUE(make(form, heat, Formulation::kIndex2, Storage::kDense).problem->pattern()->full);
  }
}

IntegratorOptions exactOptions() {
  IntegratorOptions options;
  options.tolerances = {.rtol = 1e-10, .atol = 1e-10};
  return options;
}

// heat: banded solver; beam_chain: KLU, because u' = v lies far from the diagonal.
TEST(PeerProblems, BandedAndSparseSolversAgreeWithTheDenseOne) {
  for (const char* id : {"cvode_bdf", "arkode_dirk", "ida_bdf"}) {
    for (const bool banded : {true, false}) {
      const Scene<double> scene = banded ? heatScene() : makeScene<double>("beam_chain");
      const double t_end = banded ? 0.1 : 0.02;
      const auto system = scene.system({});
      const auto exact =
          Integrator<double>(system, makeTableau<double>("radau_iia_7"), exactOptions()).integrate(scene.start, t_end);
      ASSERT_EQ(exact.outcome, Outcome::kSuccess);
      const auto end = [&](const char* storage) {
        const RunSpec run = peerSpec(id, std::string("scene=beam_chain;storage=") + storage, 1e-7);
        PeerIntegrator integrator(*findPeer(id), scene, run);
        const auto solution = integrator.integrate(scene.start, t_end);
        EXPECT_EQ(solution.outcome, Outcome::kSuccess) << id << " " << solution.detail;
        const auto again = integrator.integrate(scene.start, t_end);
        EXPECT_EQ(solution.state.u, again.state.u) << id;
        EXPECT_EQ(solution.state.x, again.state.x) << id;
        return solution;
      };
      const auto sparse = end("automatic"), dense = end("dense");
      // Round-off decides about single iterations, and these about the error of a step.
      const auto error = [&](const Solution<double>& solution) {
        return (solution.state.x - exact.state.x).norm() + (solution.state.u - exact.state.u).norm();
      };
      EXPECT_LT(error(sparse), 2 * error(dense) + 1e-6) << id;
      EXPECT_LT(error(sparse), 1e-2) << id;
      const auto steps = static_cast<double>(dense.counters.steps_accepted);
      EXPECT_NEAR(static_cast<double>(sparse.counters.steps_accepted), steps, 2 + 0.05 * steps) << id;
      EXPECT_GT(sparse.state.x.norm() + sparse.state.u.norm(), 0.01) << id;
    }
  }
}

// A pattern that grows when the scene switches: the integrator goes on with another matrix.
TEST(PeerProblems, AGrowingPatternIsFollowed) {
  const Scene<double> scene = heatScene(true);
  for (const char* id : {"cvode_bdf", "ida_bdf"}) {
    const auto end = [&](const char* storage) {
      const RunSpec run = peerSpec(id, std::string("scene=stick_slip;discontinuity=ignore;storage=") + storage, 1e-7);
      PeerIntegrator integrator(*findPeer(id), scene, run);
      const auto solution = integrator.integrate(scene.start, 0.1);
      EXPECT_EQ(solution.outcome, Outcome::kSuccess) << id << " " << solution.detail;
      EXPECT_EQ(solution.counters.switches, 1) << id;
      return solution.state.x;
    };
    const Vec<double> sparse = end("automatic"), dense = end("dense");
    EXPECT_LT((sparse - dense).norm(), 1e-5) << id;
    EXPECT_LT((sparse.head(1) - dense.head(1)).norm(), 1e-5) << id;
  }
}

}  // namespace
}  // namespace irk
