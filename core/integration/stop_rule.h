// Where an integration ends before t_end: right behind a switch (stop_at), or where the state hardly changes (steady).
#pragma once

#include <string>
#include <vector>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Follows one integration after the other. Keeps no references.
template <class Real>
class StopRule {
 public:
  /// `scale`: magnitudes of the system's components, empty: 1. Throws Misuse for a switch that the system does not
  /// have, naming those that it has, and where steps do not end at switches.
  StopRule(const System<Real>& system, const IntegratorOptions& options, const Vec<double>& scale);

  bool waitsForSwitch() const { return count_ > 0; }
  void begin() { come_ = 0, is_steady_ = false; }
  void switched(Index i);
  /// After each accepted step; `state` in the system's unknowns.
  void stepped(const State<Real>& state);

  bool reached() const { return is_steady_ || (waitsForSwitch() && come_ >= count_); }
  /// Where the integration has ended, for its detail: `at the switch impact:3`. Empty if it has come to t_end.
  std::string told() const;
  /// Why an integration that has come to t_end is no success; empty if it is one.
  std::string missed() const;

 private:
  std::string stop_at_;
  double steady_;
  Vec<double> scale_;
  std::vector<bool> waits_for_;        // of each switching function
  std::int64_t count_ = 0, come_ = 0;  // count_ = 0: no switch ends it
  bool is_steady_ = false;
};

}  // namespace irk
