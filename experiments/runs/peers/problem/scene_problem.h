// A scene's system as the equations that peers take.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "core/derivatives/consistent_start.h"
#include "core/system/counting.h"
#include "irk/peer.h"
#include "irk/system.h"

namespace irk {

/// Whether all n numbers are finite. The loop ends early: with few numbers this takes less time than the vectors that
/// the compiler uses else.
inline bool areFinite(const double* x, Index n) {
  for (Index i = 0; i < n; ++i) {
    if (!(std::abs(x[i]) <= std::numeric_limits<double>::max())) return false;
  }
  return true;
}

/// Copies as many numbers as `to` has. An assignment of Eigen's takes longer for the few numbers of a step.
template <class To>
void copyTo(To&& to, const double* from) {
  for (Index i = 0; i < to.size(); ++i) to[i] = from[i];
}

/// Values of y and y' at which an integration starts.
struct PeerValues {
  Vec<double> y, yp;
};

struct ProblemOptions {
  DerivativeSource derivatives = DerivativeSource::kAutomatic;
  Storage storage = Storage::kAutomatic;  ///< of Jacobians
  bool determined = true;                 ///< (a, k, z) follow from (u, v, x), so that no index is above 1
  Vec<double> scale = {};                 ///< magnitudes of u, v, x, z; empty means 1
};

/// Translates between a system's states and y, counts evaluations, and asks now and then whether the run is over.
/// Keeps a reference to the system, which must outlive it. Use one object per thread.
///
/// Libraries evaluate small systems millions of times: what stands between them and the residual is part of their
/// times. `rates` and `residual` are therefore written by each form itself, and evaluate the system as it is; the
/// system that counts is for Jacobians.
class SceneProblem : public PeerProblem {
 public:
  explicit SceneProblem(const System<double>& system)
      : counting_(system, evaluations_), system_(system), sizes_(system.sizes()), d_(sizes_.discrete) {}

  const PeerLayout& layout() const override { return layout_; }
  /// kNotFinite of a form that has no rates, or no residual.
  Evaluated rates(double, const double*, double*) override { return Evaluated::kNotFinite; }
  Evaluated residual(double, const double*, const double*, double*) override { return Evaluated::kNotFinite; }
  Evaluated jacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) final;
  std::shared_ptr<const PeerPattern> pattern() const override { return pattern_; }
  const PeerJacobian& mass() const override { return mass_; }
  bool stopped() final;

  /// Values of the components (u, v, x, z) as values of those of y, and `rest` for all others, of which most forms have
  /// none.
  virtual Vec<double> perComponent(const Vec<double>& values, [[maybe_unused]] double rest) const { return values; }
  /// Makes the state consistent as far as the form needs it, finds pattern and mass, and returns y and y' in `to`.
  /// `new_run`: results are bitwise those of a new object.
  virtual StartReport begin(State<double>& state, bool new_run, PeerValues& to) = 0;
  /// Sets t, u, v, x of the state, and w as far as y and y' contain it.
  virtual void read(const PeerStep& step, State<double>& state) const = 0;

  virtual void setDiscrete(const Vec<double>& d) { d_ = d; }
  void setStop(std::function<bool()> stop) { stop_ = std::move(stop); }
  /// Adds the evaluations since resetCounts: those that the peer asks for, and those of the Jacobians that it gets.
  void count(Counters& counters) const;
  void resetCounts() {
    evaluations_ = {};
    asked_ = jacobians_ = 0;
  }

 protected:
  /// To be called by `rates` and `residual` before they evaluate: counts, and returns whether the run is over.
  bool over() { return ++asked_ % kEvaluationsPerStop == 0 && stopped(); }
  virtual bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J,
                                double* dfdt) = 0;
  static Evaluated evaluated(bool finite) { return finite ? Evaluated::kDone : Evaluated::kNotFinite; }

  Counters evaluations_;  // residuals and dual residuals of Jacobians
  CountingSystem<double> counting_;
  const System<double>& system_;
  Sizes sizes_;
  Vec<double> d_;
  PeerLayout layout_;
  std::shared_ptr<const PeerPattern> pattern_;
  PeerJacobian mass_;

 private:
  // Evaluations between two readings of the clock. A reading costs as much as a small residual.
  static constexpr std::int64_t kEvaluationsPerStop = 64;

  std::function<bool()> stop_;
  std::int64_t asked_ = 0, jacobians_ = 0;
};

}  // namespace irk
