// Runs a peer behind the interface of the suite's own integrator.
#pragma once

#include <memory>

#include "core/system/switches.h"
#include "experiments/runs/peers/catalogue.h"
#include "irk/integrator.h"

namespace irk {

/// Integrates with a peer from switch to switch. Reusable; use one object per thread.
class PeerIntegrator {
 public:
  /// Throws Misuse for a spec that the peer cannot run, naming both ids and the reason.
  PeerIntegrator(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec);

  /// As Integrator::integrate, but max_steps limits accepted steps: a peer's attempts are not visible.
  [[nodiscard]] Solution<double> integrate(const State<double>& start, double t_end,
                                           const Monitor<double>& monitor = {});

 private:
  StartReport run(double t_end, const Monitor<double>& monitor);
  StartReport begin(double t_end, StartCheck check);
  void collectCounts();
  StartReport failed(Outcome outcome, const std::string& what) const;
  bool switches() const;
  StartReport settle(const Monitor<double>& monitor);
  StartReport afterStep(double t_end, const Monitor<double>& monitor);
  StartReport locatedSwitch(double t_end, const Monitor<double>& monitor);
  StartReport ignoredSwitches(double t_end, const Monitor<double>& monitor);
  void tell(Index i, const Monitor<double>& monitor) const;

  std::shared_ptr<const System<double>> system_;
  std::int64_t max_steps_;
  std::unique_ptr<Peer> peer_;
  State<double> state_;
  Switches<double> switches_;
  ChatterDetector chatter_;
  Counters counters_;
  double length_ = 0;
  DerivativeSource derivatives_;
  bool ends_consistent_;
  bool started_ = false;
};

}  // namespace irk
