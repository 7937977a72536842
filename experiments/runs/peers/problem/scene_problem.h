// A scene's system as the equations that peers take.
#pragma once

#include <functional>
#include <memory>

#include "core/derivatives/consistent_start.h"
#include "core/system/counting.h"
#include "irk/peer.h"
#include "irk/system.h"

namespace irk {

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
class SceneProblem : public PeerProblem {
 public:
  explicit SceneProblem(const System<double>& system)
      : counting_(system, evaluations_), system_(counting_), sizes_(system.sizes()), d_(sizes_.discrete) {}

  const PeerLayout& layout() const override { return layout_; }
  Evaluated rates(double t, const double* y, double* f) final;
  Evaluated residual(double t, const double* y, const double* yp, double* r) final;
  Evaluated jacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) final;
  std::shared_ptr<const PeerPattern> pattern() const override { return pattern_; }
  const PeerJacobian& mass() const override { return mass_; }
  bool stopped() final { return stop_ && stop_(); }

  /// Values of the components (u, v, x, z) as values of those of y; `rest` for all others.
  virtual Vec<double> perComponent(const Vec<double>& values, double rest) const = 0;
  /// Makes the state consistent as far as the form needs it, finds pattern and mass, and returns y and y' in `to`.
  /// `new_run`: results are bitwise those of a new object.
  virtual StartReport begin(State<double>& state, bool new_run, PeerValues& to) = 0;
  /// Sets t, u, v, x of the state, and w as far as y and y' contain it.
  virtual void read(const PeerStep& step, State<double>& state) const = 0;

  void setDiscrete(const Vec<double>& d) { d_ = d; }
  void setStop(std::function<bool()> stop) { stop_ = std::move(stop); }
  /// Adds the evaluations since resetCounts: those that the peer asks for, and those of the Jacobians that it gets.
  void count(Counters& counters) const;
  void resetCounts() {
    evaluations_ = {};
    asked_ = jacobians_ = 0;
  }

 private:
  Counters evaluations_;  // residuals and dual residuals only
  CountingSystem<double> counting_;

 protected:
  virtual bool evaluateRates(double t, const double* y, double* f) = 0;
  virtual bool evaluateResidual(double t, const double* y, const double* yp, double* r) = 0;
  virtual bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J,
                                double* dfdt) = 0;

  const System<double>& system_;  // counts its evaluations
  Sizes sizes_;
  Vec<double> d_;
  PeerLayout layout_;
  std::shared_ptr<const PeerPattern> pattern_;
  PeerJacobian mass_;

 private:
  bool over();

  std::function<bool()> stop_;
  std::int64_t asked_ = 0, jacobians_ = 0;
};

}  // namespace irk
