// A scene's system in the form that a peer takes.
#pragma once

#include <memory>

#include "experiments/runs/peers/problem/scene_problem.h"

namespace irk {

/// The system's equations in this form; `start` is any state of the system.
std::unique_ptr<SceneProblem> makeProblem(PeerForm form, const System<double>& system, const State<double>& start,
                                          const ProblemOptions& options);

}  // namespace irk
