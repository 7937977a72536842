// The stage equations of eight systems: start values, residuals, derivatives, end of the step, error estimate.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/derivatives/point_buffers.h"
#include "core/ensemble/lane_matrix.h"
#include "core/ensemble/lane_norm.h"
#include "core/ensemble/lane_state.h"
#include "core/estimates/defect.h"
#include "core/stages/scheme.h"

namespace irk {

/// A point between the stages of each lane.
using LanePoints = std::array<std::optional<MovingPoints<double>::Point>, kLanes>;

/// Does for all lanes at once what StageEquations, StartValues, Differentiator and EmbeddedEstimate do for one system.
/// W and R are n x s, stage by stage. Owns scratch; keeps references to the scheme and to the systems in use.
class LaneStages {
 public:
  LaneStages(const Scheme<double>& scheme, const Sizes& sizes, const std::vector<int>& row_powers, double mu);

  /// Selects the systems whose equations are evaluated from now on.
  void use(const System<Lanes>& system);

  /// Begins a step of each lane from `from`, which must live as long as the step.
  void begin(const LaneState& from, const Lanes& h);

  /// Predicts W: in the lanes of `past` from the polynomial through the stages of the last solved step, in other lanes
  /// (a, k, z) at the start.
  void predict(const LaneMask& past, std::vector<Lanes>& W);
  /// Keeps the solved stages of the lanes of `which` for the prediction of the next step.
  void keep(const LaneMask& which, const std::vector<Lanes>& W);

  /// Evaluates R(W) with scaled rows; returns the lanes in which it is finite.
  LaneMask residual(const std::vector<Lanes>& W, std::vector<Lanes>& R);
  /// Evaluates the derivatives at an inner stage of W, in the lanes of `which`.
  void differentiate(const std::vector<Lanes>& W, const LaneMask& which, LaneJacobian& jacobian);
  Index dualEvaluations() const;
  /// Changes of W in the last digits of the sums that it enters, see SimplifiedNewton.
  void lastDigits(const std::vector<Lanes>& W, std::vector<Lanes>& change) const;

  /// Computes the states at the step's end.
  void finish(const std::vector<Lanes>& W, LaneState& to) const;
  /// The embedded estimate of the step that W solves; filtered twice in lanes where it exceeds `again_above`.
  Lanes estimate(const std::vector<Lanes>& W, const LaneNorm& norm, LaneMatrix& matrix, const Lanes& again_above,
                 const LaneMask& which, LaneCounters& counters);

  /// The defect of the step that W solves at a point of each lane of `which`, see Defect; other lanes may have none.
  /// `first`: these are the step's first points.
  Lanes defect(const LanePoints& at, const std::vector<Lanes>& W, const LaneNorm& norm, LaneMatrix& matrix,
               const LaneMask& which, bool first, LaneCounters& counters);

 private:
  void place(const std::vector<Lanes>& W);
  void scaleRows(Lanes* r) const;
  // Sets e_ to the residual at t, at_ and defect_.
  enum class Between { kNone, kStages };
  void evaluate(const Lanes& t, Between between);
  // Lanes in which e_ is larger than most_ in any row; raises most_ there.
  LaneMask raise(const LaneMask& which);
  // Filters e_ into error_.
  void filter(LaneMatrix& matrix);
  Lanes sizeOfError(const LaneNorm& norm) const { return norm.magnitude(error_.data(), error_.data() + at_.size()); }
  void shortenPolynomial(const LaneMask& where, const std::vector<Lanes>& basis, std::vector<Lanes>& weights) const;

  const Scheme<double>& scheme_;
  Sizes sizes_;
  Index n_, s_, inner_;
  std::size_t nu_, nx_, nz_;
  std::vector<int> row_powers_;
  double mu_;
  Mat<double> start_, integrals_, b_, bA_;  // s x 1
  const System<Lanes>* system_ = nullptr;
  bool uses_velocity_ = true;
  const LaneState* from_ = nullptr;
  Lanes h_;
  std::vector<Lanes> t_, U_, V_, X_;  // of the stages
  bool scaled_;                       // whether any row is scaled
  std::vector<Lanes> scales_;         // h^-power of the rows
  Lanes past_t_, past_h_;             // of the last solved step
  std::vector<Lanes> past_W_, basis_, weights_;
  PointBuffers<Dual<Lanes>> dual_;
  std::vector<Lanes> defect_, slip_, at_, error_, e_;  // of the estimate
  std::vector<Lanes> most_;                            // the largest residuals of the step's points
  std::vector<int> z_powers_;                          // index of z_i, minus 1
};

}  // namespace irk
