// One instance of an FMU for Model Exchange, of version 2.0 or 3.0.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/own/fmu/description.h"
#include "experiments/own/fmu/fmi.h"
#include "experiments/own/shared_library.h"

namespace irk::own {

/// What event mode has come to.
struct FmuEvent {
  bool terminates = false;      ///< the FMU wants the simulation to end
  bool states_changed = false;  ///< the continuous states jump
  bool has_next_time = false;   ///< the next event in time
  double next_time = 0;
};

/// What the FMU asks for at the end of a step.
struct FmuStep {
  bool event = false;       ///< event mode
  bool terminates = false;  ///< the end of the simulation
};

/// What all instances of an FMU have in common.
struct FmuLibrary {
  FmuDescription description;
  std::shared_ptr<const SharedLibrary> library;
  std::string resources;  ///< the folder
};

/// A variable and the number that is given to it; of an array its first element and the numbers of all.
using FmuValue = std::pair<const FmuVariable*, std::vector<double>>;

/// An instance, in continuous-time mode after `begin`. Not for two threads at a time. Functions that return bool return
/// false where the FMU cannot compute the values.
class FmuInstance {
 public:
  virtual ~FmuInstance() = default;
  FmuInstance() = default;
  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;

  /// Initializes with these values, from `start` to `stop`, and settles the first event. To be called once. Throws
  /// Misuse, with the FMU's own message, if it fails.
  virtual FmuEvent begin(const std::vector<FmuValue>& values, double start, double stop) = 0;
  /// Enters event mode at the point that was set last, and leaves it when nothing changes any more. Throws Misuse as
  /// begin.
  virtual FmuEvent event() = 0;

  /// Brings the instance back to where `begin` has left it. Returns false for an FMU that cannot do this.
  virtual bool returnToStart() = 0;

  /// Tells the FMU that a step has come to the point that was set last (completedIntegratorStep). To be called only of
  /// an FMU that needs it. Throws Misuse as begin.
  virtual FmuStep completeStep() = 0;

  virtual bool setPoint(double t, const double* states) = 0;
  virtual bool setInputs(const std::vector<unsigned>& references, const std::vector<double>& values) = 0;
  virtual bool states(double* to) = 0;
  virtual bool nominals(double* to) = 0;
  virtual bool derivatives(double* to) = 0;
  virtual bool indicators(double* to) = 0;
  virtual bool product(const double* seed, double* to) = 0;  ///< the Jacobian of the derivatives times `seed`
  /// Those of all elements, `count` numbers.
  virtual bool values(const std::vector<unsigned>& references, double* to, std::size_t count) = 0;
};

/// Throws Misuse for an FMU that lacks a function of the standard or that cannot be instantiated.
std::unique_ptr<FmuInstance> makeFmi2(const FmuLibrary& fmu);
std::unique_ptr<FmuInstance> makeFmi3(const FmuLibrary& fmu);

}  // namespace irk::own
