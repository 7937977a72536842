// The claims in the paper's words, where their data come from, and who judges them.
#include "experiments/claims/evaluations.h"

namespace irk::claims {

std::span<const Claim> claims() {
  static const std::vector<Claim> all = {
      {"C1",
       "Orders up to 20 (10-stage Gauss) are reached, and are even the most efficient at high "
       "accuracy.",
       {"order", "cpu_time"},
       {"order_ode", "stages_slider_crank", "stages_hydraulic_arm", "stages_other"},
       highOrders},
      {"C2",
       "Up to about 10 stages speed the simulation up; then machine precision limits Newton.",
       {"cpu_time", "failure_newton"},
       {"stages_slider_crank", "stages_hydraulic_arm", "failure_round_off", "failure_round_off_modified"},
       manyStages},
      {"C3",
       "Error control by step doubling costs 50 % more and is very reliable.",
       {"estimate", "control", "steps"},
       {"estimate_ratio", "control_estimates", "steps_slider_crank"},
       stepDoubling},
      {"C4",
       "Below 200 unknowns residual and Jacobian cost more than the factorization, even a dense "
       "one.",
       {"phases"},
       {"phases_ancf_pendulum", "phases_beam_chain"},
       phaseShares},
      {"C5",
       "The derivatives of the mass matrix matter little in flexible multibody systems; dropping "
       "them is faster.",
       {"jacobian"},
       {"jacobian_slider_crank_flexible", "jacobian_slider_crank", "jacobian_ancf_pendulum"},
       massDerivatives},
      {"C6",
       "Index 3 directly: Newton converges badly below h = 1e-6 to 1e-8; index 2 cures it, and "
       "scaling by 1/h helps.",
       {"small_steps"},
       {"small_steps_error", "small_steps_newton", "failure_tiny_index3"},
       smallSteps},
      {"C7",
       "At high order the drift without GGL stabilisation is negligible.",
       {"drift"},
       {"drift_pendulum", "drift_cost"},
       driftIsNegligible},
      {"C8",
       "Multistep methods cannot restart quickly after a discontinuity.",
       {"peers"},
       {"peers_smooth", "peers_discontinuous", "peers_located", "discontinuity_ignore"},
       multistepRestart},
      {"C9",
       "High order pays in the smooth part; at discontinuities the step must be small.",
       {"cpu_time", "steps"},
       {"steps_slider_crank", "steps_hydraulic_arm", "stages_slider_crank"},
       smallStepsAtJumps},
      {"C10",
       "The 2-stage Lobatto IIIA scheme in K-form is Newmark's method with beta = 1/4, "
       "gamma = 1/2.",
       {},
       {},
       newmarkIsLobatto},
      {"C11", "The K-form needs no factorization of the mass matrix.", {"k_form"}, {"k_form"}, noMassFactorization},
      {"C12",
       "The rule of the modified Newton method (contractivity above 0.7 after 3 iterations; 25 "
       "iterations) is efficient.",
       {"newton_rule"},
       {"newton_rule"},
       newtonRule},
      {"C13",
       "Radau IIA is the best family for mechanical differential-algebraic systems.",
       {"families"},
       {"families"},
       radauIsBest},
      {"C14",
       "Relative tolerances help little for oscillatory solutions.",
       {"control"},
       {"control_norm"},
       relativeTolerances},
      {"C15",
       "Jacobian parts can be reused after a change of step; a factorization cannot be updated "
       "cheaply.",
       {"jacobian", "phases"},
       {"jacobian_reuse", "phases_ancf_pendulum"},
       jacobianReuse}};
  return all;
}

}  // namespace irk::claims
