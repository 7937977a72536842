// Options of the solver and tolerances that an audit draws beside the configuration.
#pragma once

#include <functional>

#include "experiments/runs/run_spec.h"
#include "experiments/study/drawn/dice.h"

namespace irk::audit {

/// Draws norm, estimate, control, Newton's method, predictor and multipliers; most of the time each keeps the value of
/// the configuration. So does an option that `isLegal` refuses for the spec that has it.
void drawOptions(Dice& dice, RunSpec& spec, const std::function<bool(const RunSpec&)>& isLegal);

/// Draws 1e-2 to 1e-13 for rtol and atol: mostly one number for both, else two that differ by a factor of 10 to 1000.
void drawTolerances(Dice& dice, RunSpec& spec);

/// `t_end` times a factor of 0.2 to 2, uniform in its logarithm, rounded to three digits.
double drawnEnd(Dice& dice, double t_end);

}  // namespace irk::audit
