// One scene of an FMU with values of its parameters: what the functions of irk/scene_c.h do for it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/own/fmu/model.h"
#include "experiments/own/foreign/scene_functions.h"

namespace irk::own {

/// A function of a scene has to depend on its arguments only, but an FMU keeps its discrete state to itself. The
/// scene's discrete state is therefore the number of an epoch: epoch 0 begins at the start, and each event begins a new
/// one. The run remembers the event of each epoch. An evaluation in another epoch than that of the instance repeats the
/// events from the start on, or those that follow. For the start the FMU sets its first state again (fmi2SetFMUstate),
/// or a new instance is made. (An integration goes back only when it begins anew, as that of the error bar does.) It is
/// assumed that the FMU remembers nothing between events, also not the steps that it is told of.
class FmuRun {
 public:
  /// `values`: of the settable variables, in their order; of inputs also tables over time.
  FmuRun(std::shared_ptr<const FmuModel> model, const ParameterValues& values);
  ~FmuRun();
  FmuRun(const FmuRun&) = delete;
  FmuRun& operator=(const FmuRun&) = delete;

  const FmuModel& model() const { return *model_; }
  /// Makes the instance and initializes it. To be called once, before all others. Throws Misuse if the FMU fails.
  void begin() { enter(0); }
  /// Those of the indicators, and then the next event in time. An FMU that has neither an indicator nor such a time
  /// when it begins has none, so that integrators without a search for roots take it.
  std::size_t switches() const { return switches_; }

  /// y is in the scene's order (u, v, x). These return false where the FMU cannot compute the numbers.
  bool rates(double t, const double* y, double epoch, double* f);
  bool product(double t, const double* y, double epoch, const double* dy, double* df);
  bool outputs(double t, const double* y, double epoch, double* values);
  bool switching(double t, const double* y, double epoch, double* g);
  /// Carries out the event of switch i and returns the new epoch. Throws Misuse where the FMU fails, and where it ends
  /// the simulation.
  double event(std::size_t i, double t, const double* y, double epoch);
  /// Tells the FMU that a step has come to (t, y). Where it asks for an event, carries it out, sets the new epoch and
  /// the states with which it begins, and returns true. Throws Misuse as `event`.
  bool completeStep(double t, double* y, double& epoch);
  /// The states with which an epoch begins; unchanged where they do not jump there.
  void jump(double epoch, double* y);
  /// The states at the start.
  void start(double* y);

 private:
  struct Epoch {
    std::size_t parent;
    double t;
    std::vector<double> before, after;  // the states, in the FMU's order
    std::vector<double> signs;          // of the indicators after the event: +1 above 0, else -1
    FmuEvent event;
  };

  /// Takes the slot for this thread, with the instance in this epoch. Throws Misuse if the FMU fails.
  std::unique_lock<std::mutex> enter(double epoch);
  void beginAnew();
  void repeat(std::size_t epoch);
  bool setPoint(double t, const double* y);
  bool moveTo(double t, const double* states);
  void set(std::size_t i, const ParameterValues& values);
  void settle(Epoch& epoch);
  bool tellStep(double t);
  FmuEvent eventAt(double t);
  std::size_t repeated(std::size_t parent, double t) const;
  std::size_t beginEpoch(std::size_t parent, double t, const FmuEvent& event);
  void goBehindRoot(std::size_t i, double sign, double& t);
  void setSigns(Epoch& epoch) const;
  void toScene(const std::vector<double>& rates, double* f) const;
  void statesOf(const Epoch& epoch, double* y) const;

  std::shared_ptr<const FmuModel> model_;
  std::vector<FmuValue> values_;
  std::vector<std::pair<std::size_t, TimeTable<double>>> tables_;  // and their places in input_values_
  std::vector<unsigned> input_references_;  // of the inputs with tables; an array is set as a whole
  std::vector<double> input_values_;
  std::shared_ptr<FmuSlot> slot_;
  std::vector<Epoch> epochs_;
  std::size_t switches_ = 0;
  std::vector<double> states_, rates_, indicators_;  // in the FMU's order
  std::vector<unsigned> outputs_;
};

}  // namespace irk::own
