// The solution inside the accepted step, for users.
#pragma once

#include "core/estimates/step_attempt.h"
#include "core/stages/dense_output.h"
#include "irk/monitor.h"

namespace irk {

/// See InsideStep. Owns scratch; computes nothing until `at` is called.
template <class Real>
class InsideAttempt final : public InsideStep<Real> {
 public:
  /// Keeps a reference to the system.
  explicit InsideAttempt(const System<Real>& system);

  /// Selects the step that `pieces` have solved, from `from` to the time `end`; `to` is the state there in the scene's
  /// unknowns. All arguments must outlive the calls of `at`. Returns false if the stages determine no polynomial.
  bool begin(const State<Real>& from, const Real& end, const State<Real>& to, const StepPieces<Real>& pieces);
  State<Real> at(const Real& t) override;

 private:
  const System<Real>& system_;
  DenseOutput<Real> dense_;
  State<Real> inside_;
  StepPieces<Real> pieces_{};
  std::size_t piece_ = 0;  // the piece that dense_ has begun; pieces_.count: none
  Real end_{};
  const State<Real>* to_ = nullptr;
};

}  // namespace irk
