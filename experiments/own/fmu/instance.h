// One instance of an FMU for Model Exchange, of version 2.0 or 3.0.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/own/fmu/description.h"
#include "experiments/own/fmu/fmi.h"
#include "experiments/own/shared_library.h"
#include "irk/misuse.h"

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

/// Passes of event mode after which an FMU is said not to settle.
inline constexpr int kMaxEventPasses = 1000;

/// An instance, in continuous-time mode after `begin`. Not for two threads at a time. Functions that return bool return
/// false where the FMU cannot compute the values.
///
/// The class has the functions that both versions of the standard have under the names fmi2NAME and fmi3NAME, the
/// sequence of their calls, and the messages of the FMU; derived ones have what differs.
class FmuInstance {
 public:
  FmuInstance(const FmuLibrary& fmu, const std::string& prefix, const char* derivatives)
      : fmu_(fmu),
        n_(fmu.description.states.size()),
        prefix_(prefix),
        free_(get<fmiFreeInstanceTYPE>(prefix + "FreeInstance")),
        exit_initialization_(get<fmiExitInitializationModeTYPE>(prefix + "ExitInitializationMode")),
        enter_event_(get<fmiEnterEventModeTYPE>(prefix + "EnterEventMode")),
        enter_continuous_(get<fmiEnterContinuousTimeModeTYPE>(prefix + "EnterContinuousTimeMode")),
        set_time_(get<fmiSetTimeTYPE>(prefix + "SetTime")),
        set_states_(get<fmiSetContinuousStatesTYPE>(prefix + "SetContinuousStates")),
        get_states_(get<fmiGetContinuousStatesTYPE>(prefix + "GetContinuousStates")),
        get_derivatives_(get<fmiGetDerivativesTYPE>(prefix + derivatives)),
        get_indicators_(get<fmiGetEventIndicatorsTYPE>(prefix + "GetEventIndicators")) {
    if (fmu.description.states_kept) {
      const std::string state = prefix == "fmi2" ? "FMUstate" : "FMUState";
      keep_state_ = get<fmiGetFMUStateTYPE>(prefix + "Get" + state);
      set_state_ = get<fmiSetFMUStateTYPE>(prefix + "Set" + state);
      free_state_ = get<fmiFreeFMUStateTYPE>(prefix + "Free" + state);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if (fmu.description.states[i].element > 0) continue;
      references_.push_back(fmu.description.states[i].reference);
      derivative_references_.push_back(fmu.description.derivatives[i]);
    }
  }
  virtual ~FmuInstance() = default;
  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;

  /// Initializes with these values, from `start` to `stop`, and settles the first event. To be called once. Throws
  /// Misuse, with the FMU's own message, if it fails.
  FmuEvent begin(const std::vector<FmuValue>& values, double start, double stop) {
    initialize(values, start, stop);
    require(exit_initialization_(instance_), prefix_ + "ExitInitializationMode");
    const FmuEvent event = settle();
    if (keep_state_ && !good(keep_state_(instance_, &start_))) start_ = nullptr;
    return event;
  }
  /// Enters event mode at the point that was set last, and leaves it when nothing changes any more. Throws Misuse as
  /// begin.
  FmuEvent event() {
    require(enter_event_(instance_), prefix_ + "EnterEventMode");
    return settle();
  }

  /// Brings the instance back to where `begin` has left it. Returns false for an FMU that cannot do this.
  bool returnToStart() { return start_ && good(set_state_(instance_, start_)); }

  /// Tells the FMU that a step has come to the point that was set last (completedIntegratorStep). To be called only of
  /// an FMU that needs it. Throws Misuse as begin.
  FmuStep completeStep() { return completeStep(start_ == nullptr); }  // only the state at the start is ever set again

  bool setPoint(double t, const double* states) {
    return good(set_time_(instance_, t)) && good(set_states_(instance_, states, n_));
  }
  virtual bool setInputs(const std::vector<unsigned>& references, const std::vector<double>& values) = 0;
  bool states(double* to) { return good(get_states_(instance_, to, n_)); }
  bool derivatives(double* to) { return good(get_derivatives_(instance_, to, n_)); }
  bool indicators(double* to) {
    const std::size_t count = fmu_.description.indicators;
    return count == 0 || good(get_indicators_(instance_, to, count));
  }
  virtual bool product(const double* seed, double* to) = 0;  ///< the Jacobian of the derivatives times `seed`
  /// Those of all elements, `count` numbers.
  virtual bool values(const std::vector<unsigned>& references, double* to, std::size_t count) = 0;

 protected:
  /// Gives the values to the FMU and enters initialization mode.
  virtual void initialize(const std::vector<FmuValue>& values, double start, double stop) = 0;
  /// `no_former_state`: no state of the time before is set again.
  virtual FmuStep completeStep(bool no_former_state) = 0;
  /// One pass of event mode; `event` has the result of the passes before. Returns whether another one is needed.
  virtual bool update(FmuEvent& event) = 0;
  /// To be called by destructors: while the FMU frees its memory it may use what the derived class has given to it.
  void free() {
    if (!instance_) return;
    if (start_) free_state_(instance_, &start_);
    free_(instance_);
    instance_ = nullptr;
  }

  // Sources put the name of the model before those of the functions.
  template <class Function>
  Function* get(const std::string& name) const {
    const std::string with_model = fmu_.description.identifier + "_" + name;
    if (auto* const function = fmu_.library->find<Function>(with_model.c_str())) return function;
    return fmu_.library->get<Function>(name.c_str());
  }
  static bool good(fmiStatus status) { return status == fmiOK || status == fmiWarning; }
  /// Throws Misuse unless the call has worked.
  void require(fmiStatus status, const std::string& function) const {
    if (good(status)) return;
    throw Misuse(fmt::format("{} fails with status {}{}{}", function, static_cast<int>(status),
                             message_.empty() ? "" : ": ", message_));
  }
  void keepMessage(fmiStatus status, const char* text) {
    if (status < fmiWarning || !text) return;
    message_ = text;
    for (char& letter : message_) letter = letter == '\n' || letter == '\r' ? ' ' : letter;
    while (!message_.empty() && message_.back() == ' ') message_.pop_back();
  }

  const FmuLibrary& fmu_;
  std::size_t n_;
  fmiInstance instance_ = nullptr;
  std::vector<unsigned> references_, derivative_references_;  // of the states and their derivatives
  std::string message_;                                       // the FMU's last one about a failure

 private:
  // From event mode to continuous-time mode.
  FmuEvent settle() {
    FmuEvent event;
    bool again = true;
    for (int pass = 0; again && !event.terminates; ++pass) {
      if (pass == kMaxEventPasses) {
        throw Misuse(fmt::format("event mode does not settle in {} passes", kMaxEventPasses));
      }
      again = update(event);
    }
    if (!event.terminates) require(enter_continuous_(instance_), prefix_ + "EnterContinuousTimeMode");
    return event;
  }

  std::string prefix_;
  fmiFreeInstanceTYPE* free_;
  fmiExitInitializationModeTYPE* exit_initialization_;
  fmiEnterEventModeTYPE* enter_event_;
  fmiEnterContinuousTimeModeTYPE* enter_continuous_;
  fmiSetTimeTYPE* set_time_;
  fmiSetContinuousStatesTYPE* set_states_;
  fmiGetContinuousStatesTYPE* get_states_;
  fmiGetDerivativesTYPE* get_derivatives_;
  fmiGetEventIndicatorsTYPE* get_indicators_;
  fmiGetFMUStateTYPE* keep_state_ = nullptr;
  fmiSetFMUStateTYPE* set_state_ = nullptr;
  fmiFreeFMUStateTYPE* free_state_ = nullptr;
  void* start_ = nullptr;  // the FMU's state after `begin`
};

/// Throws Misuse for an FMU that lacks a function which is called or that cannot be instantiated.
std::unique_ptr<FmuInstance> makeFmi2(const FmuLibrary& fmu);
std::unique_ptr<FmuInstance> makeFmi3(const FmuLibrary& fmu);

}  // namespace irk::own
