#include "experiments/reference/tasks.h"
#include "experiments/runs/fields.h"

namespace irk {
std::vector<ReferenceTask> referenceTasks() {
  std::vector<ReferenceTask> tasks;
  for (const auto& scene : sceneCatalogue()) {
    for (const auto& reference_case : scene.reference_cases) tasks.push_back({scene.id, reference_case});
    if (scene.registered && scene.reference_cases.empty()) tasks.push_back({scene.id});
  }
  return tasks;
}

RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness) {
  const bool fine = fineness == Fineness::kFine;
  RunSpec spec;
  findField("scene").set(spec, task.scene);
  findField("settings").set(spec, task.of.settings);
  spec.method = method;
  spec.formulation = task.formulation;
  spec.discontinuity = Discontinuity::kLocate;
  spec.scalar = {50};
  auto& options = spec.options;
  options.tolerances.rtol = options.tolerances.atol = task.of.tolerance * (fine ? kFiner : 1);
  options.step.control = StepControl::kPredictive;
  if (task.of.step > 0) {
    options.step.control = StepControl::kFixed;
    options.step.h = task.of.step / (fine ? 2 : 1);
    options.newton.kind = NewtonKind::kFull;
    options.solver = StageSolverKind::kCoupledDense;
  }
  options.jacobian_point = JacobianPoint::kMiddle;
  // A linearly converging iteration needs many steps for thirty digits. Its error may stay four digits below the
  // tolerance; by default, with this many stages, Newton would iterate to round-off.
  options.newton.max_iterations = 100;
  options.newton.kappa = 1e-4;
  options.newton.residual_tolerance = 1e-35;
  return resolved(spec);
}

RunSpec referenceRun(const ReferenceTask& task, std::size_t run) {
  return referenceSpec(task, run % 2 == 0 ? task.second : kFirstMethod, run < 2 ? Fineness::kCoarse : Fineness::kFine);
}

}  // namespace irk
