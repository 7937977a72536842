// Runs a peer behind the interface of the suite's own integrator.
#pragma once

#include <memory>

#include "core/control/stall_detector.h"
#include "core/system/switches.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/problem/scene_problem.h"
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
  StartReport runTo(double t_end, bool new_run, const Monitor<double>& monitor);
  StartReport leg(bool new_run, double t_end, const Monitor<double>& monitor);
  PeerNext accepted(const PeerStep& step, double t_end, const Monitor<double>& monitor);
  StartReport take(const PeerStep& step, double t_end, const Monitor<double>& monitor);
  StartReport mayGoOn(const Monitor<double>& monitor) const;
  StartReport failed(Outcome outcome, const std::string& what) const;
  bool switches() const;
  StartReport settle(const Monitor<double>& monitor);
  StartReport locatedSwitch(const PeerStep& step, const Monitor<double>& monitor);
  StartReport ignoredSwitches(const Monitor<double>& monitor);
  void completeStep(const Monitor<double>& monitor);
  void tell(Index i, const Monitor<double>& monitor) const;

  std::shared_ptr<const System<double>> system_;
  std::int64_t max_steps_;
  std::unique_ptr<SceneProblem> problem_;
  std::unique_ptr<Peer> peer_;
  State<double> state_;
  PeerValues values_;
  Switches<double> switches_;
  ChatterDetector chatter_;
  Counters counters_;
  double t_end_ = 0, length_ = 0;
  StallDetector stall_;
  DerivativeSource derivatives_;
  bool ends_consistent_;
  StartReport stopped_;    // why the run is over; kSuccess: it goes on
  bool restarts_ = false;  // after a switch
};

}  // namespace irk
