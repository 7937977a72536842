// The header to include for a strategy of your own: the interfaces of all axes, and registerStrategy. The headers of
// the interfaces are installed in irk/internal; they change more often than the rest of the library.
//
// | axis | base class | entry |
// |---|---|---|
// | newton | Newton | Strategy<NewtonKind> |
// | solver | StageSolver | Strategy<StageSolverKind> |
// | predictor | StagePredictor | Strategy<Predictor> |
// | estimate | StepAttempt | Strategy<ErrorEstimate> |
// | control | StepController | Strategy<StepControl> |
// | order | OrderController | Strategy<OrderControl> |
// | jacobian | a function JacobianChange | Strategy<JacobianTerms> |
// | discontinuity | ModesInStep, ModesAfterStep | Strategy<Discontinuity> |
//
// experiments/examples has one of each but the last. A file with
//
//   IRK_REGISTER { irk::registerStrategy<irk::StepControl>({...}); }
//
// is loaded by `irk solve ... --load my_control.cpp --control mine`, or by `load = "my_control.cpp"` in a study.
#pragma once

#include "core/control/controller.h"
#include "core/control/order_controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/newton/newton.h"
#include "core/options/catalogue.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/stages/start_values.h"
#include "core/steps/modes.h"
#include "irk/registration.h"
