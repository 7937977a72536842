#include "experiments/reference/tasks.h"

namespace irk {
namespace {

// Tolerances: what is cheap gets many digits; thousands of elastic oscillations get fewer.
constexpr double kMany = 1e-28, kUsual = 1e-26, kFew = 1e-19;

constexpr ReferenceTask kTasks[] = {
    {"ancf_cantilever", "", "0.02 0.05", kFew},
    {"ancf_pendulum", "", "0.25 0.5", kUsual},
    {"ancf_pendulum", "elements=4", "", kUsual},
    {"beam_chain", "", "0.5 1", kUsual},
    {"bouncing_mass", "", "0.1 0.3", kUsual},
    {"dahlquist", "", "0.25 0.5", kMany},
    {"dc_motor_chopper", "", "0.005 0.01", kUsual},
    {"elastica", "", "0.5 1", kMany},
    {"elastoplastic", "", "0.5 1", kUsual},
    {"hires", "", "5 80", kMany},
    {"hydraulic_arm", "", "0.4 1", kMany},
    {"hydraulic_arm", "reference=smooth", "0.5 1", kMany},
    {"hydraulic_manipulator", "", "2 4 6", kUsual},
    {"hydraulic_manipulator", "manoeuvre=sine", "2 5", kUsual},
    {"index1_nonlinear", "", "0.25 0.5", kMany},
    {"index2_nonlinear", "", "0.25 0.5", kMany},
    {.scene = "index3_nonlinear",
     .settings = "",
     .times = "0.25 0.5",
     .tolerance = kUsual,
     .newton = NewtonKind::kFull,
     .step = 0.1},
    {"kaps", "", "0.25 0.5", kMany},
    {"kepler", "", "10 30", kMany},
    {"mechanical_dae", "", "0.25 0.5", kMany},
    {"mechatronic_crank", "", "0.5", kUsual},
    {"pendulum", "", "0.5 1 5", kMany},
    {"prothero_robinson", "", "0.25 0.5", kMany},
    {"riccati_tracking", "", "0.5 1", kMany},
    {"robertson", "", "0.4 4e3 1e7", kMany},
    {"sampled_control", "", "0.1 0.45", kUsual},
    {"slider_crank", "", "0.3 1", kUsual},
    {"slider_crank", "torque_off_at=0.5", "1", kUsual},
    {"slider_crank_flexible", "", "0.025 0.05", kFew},
    {"stick_slip", "", "20 30", kUsual},
    {"stick_slip", "Fs=1 k=100 v0=0 vb=0 x0=0.105", "", kUsual},
    {"stick_slip_lugre", "", "5 15", kUsual},
    {"van_der_pol", "", "0.5 1", kMany},
};

}  // namespace

std::span<const ReferenceTask> referenceTasks() { return kTasks; }

RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness) {
  const bool fine = fineness == Fineness::kFine;
  RunSpec spec;
  findField("scene").set(spec, task.scene);
  findField("settings").set(spec, task.settings);
  spec.method = method;
  spec.formulation = task.formulation;
  spec.discontinuity = Discontinuity::kLocate;
  spec.scalar = ScalarKind::kMp50;
  auto& options = spec.options;
  options.tolerances.rtol = options.tolerances.atol = task.tolerance * (fine ? kFiner : 1);
  options.step.control = StepControl::kPredictive;
  if (task.step > 0) {
    options.step.control = StepControl::kFixed;
    options.step.h = task.step / (fine ? 2 : 1);
  }
  options.jacobian_point = JacobianPoint::kMiddle;
  // Thirty digits take a linearly converging iteration many steps. Its error stays four digits
  // below the tolerance; the default would go down to round-off with this many stages.
  options.newton.kind = task.newton;
  options.newton.max_iterations = 100;
  options.newton.kappa = 1e-4;
  options.newton.residual_tolerance = 1e-35;
  if (task.newton == NewtonKind::kFull) options.solver = StageSolverKind::kCoupledDense;
  return resolved(spec);
}

}  // namespace irk
