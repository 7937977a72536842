#include "irk/options.h"

#include "core/options/axis.h"

namespace irk {
namespace {

constexpr Named<Formulation> kFormulations[] = {
    {Formulation::kIndex2, "index2", "constraints differentiated once, rows scaled by 1/h (paper)"},
    {Formulation::kIndex3, "index3", "position constraints as they are, rows scaled by 1/h^2"},
    {Formulation::kGgl, "ggl", "stabilised index 2: g = 0 and dg/dt = 0, u' = v + G^T mu"},
    {Formulation::kIndex2Projected, "index2_projected", "index 2, v projected after each step"},
    {Formulation::kIndex1, "index1", "constraints differentiated twice"},
    {Formulation::kFirstOrder, "first_order",
     "y' = f(t, y): index 1 solved for (a, k), M factorized in every evaluation"},
    {Formulation::kFirstOrderPerStep, "first_order_per_step",
     "the same, M factorized once per step, its other solves refined by residuals"}};
constexpr Named<ConstraintScaling> kScalings[] = {
    {ConstraintScaling::kOn, "on", "constraint rows multiplied by 1/h or 1/h^2 (paper)"},
    {ConstraintScaling::kOff, "off", "constraint rows as they are"}};
constexpr Named<DerivativeSource> kSources[] = {
    {DerivativeSource::kAutomatic, "automatic", "dual numbers, exact"},
    {DerivativeSource::kCentral, "difference_central", "central differences"},
    {DerivativeSource::kForward, "difference_forward", "forward differences (paper)"}};
constexpr Named<Storage> kStorages[] = {
    {Storage::kAutomatic, "automatic", "sparse where the system is large and sparse enough"},
    {Storage::kDense, "dense", "dense matrices; their derivatives use coloured columns, too"},
    {Storage::kSparse, "sparse", "compressed columns, pivots by KLU; scalar double only"}};
constexpr Named<Summation> kSummations[] = {
    {Summation::kCompensated, "compensated", "the round-off of each addition is added to the next increment"},
    {Summation::kPlain, "plain", "round-off accumulates"}};
constexpr Named<Multipliers> kMultipliers[] = {
    {Multipliers::kConsistent, "consistent", "computed from (u, v, x) at the end"},
    {Multipliers::kStages, "stages", "those of the last step"}};
constexpr Named<JacobianPoint> kPoints[] = {
    {JacobianPoint::kStart, "start", "at the step's start (paper)"},
    {JacobianPoint::kMiddle, "middle", "at t0 + h/2 (HOTINT)"},
    {JacobianPoint::kPredicted, "predicted", "at the start values' stage nearest to t0 + 0.6 h"},
    {JacobianPoint::kEachStage, "each_stage", "at the stages' start values; coupled solvers only"}};
constexpr Named<NormKind> kNorms[] = {{NormKind::kMixed, "mixed", "RMS of e / (atol scale + rtol |y|)"},
                                      {NormKind::kAbsolute, "absolute", "2-norm of e / atol (paper)"}};
constexpr Named<Guards> kGuards[] = {
    {Guards::kAll, "all", "all of the following"},
    {Guards::kNone, "none", "the error estimate alone"},
    {Guards::kWithoutDefect, "no_defect", "without looks between the stages: h mu |filtered residual| <= 1 tolerance"},
    {Guards::kWithoutSmoothness, "no_smoothness",
     "richardson without the fall of the highest Legendre coefficients from a step to its halves"},
    {Guards::kWithoutRestart, "no_restart", "without the rates at the start of the first step after a restart"},
    {Guards::kWithoutSwitchEffect, "no_switch_effect",
     "without the effect of a switch in a step that goes on over it (ignore, iterate, smooth)"}};

}  // namespace

IRK_AXIS(Formulation, kFormulations, "formulation")
IRK_AXIS(ConstraintScaling, kScalings, "scaling")
IRK_AXIS(DerivativeSource, kSources, "derivatives")
IRK_AXIS(Storage, kStorages, "storage")
IRK_AXIS(Summation, kSummations, "summation")
IRK_AXIS(Multipliers, kMultipliers, "multipliers")
IRK_AXIS(JacobianPoint, kPoints, "jacobian_point")
IRK_AXIS(NormKind, kNorms, "norm")
IRK_AXIS(Guards, kGuards, "guards")

void validate(const SystemOptions& options) {
  static_cast<void>(parseId<Formulation>(idOf(options.formulation)));
  static_cast<void>(parseId<ConstraintScaling>(idOf(options.scaling)));
  static_cast<void>(parseId<Discontinuity>(idOf(options.discontinuity)));
}

}  // namespace irk
