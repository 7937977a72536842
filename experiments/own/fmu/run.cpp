#include "experiments/own/fmu/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "irk/misuse.h"

namespace irk::own {
namespace {

// The part of the default experiment's time in which an indicator goes through 0 at once. Located events are known to
// less; tools move indicators by 1e-10 (hysteresis).
constexpr double kAtOnce = 1e-10;

double defaultOf(const FmuVariable& variable) {
  if (variable.start == "true") return 1;
  return std::strtod(variable.start.c_str(), nullptr);
}

Misuse terminated(double t) {
  return Misuse(fmt::format("it ends the simulation at t = {:.9g} (terminateSimulation)", t));
}

}  // namespace

FmuRun::FmuRun(std::shared_ptr<const FmuModel> model, const ParameterValues& values)
    : model_(std::move(model)), slot_(model_->only ? model_->only : std::make_shared<FmuSlot>()) {
  const FmuDescription& fmu = model_->fmu.description;
  for (std::size_t i = 0; i < fmu.settable.size(); i += fmu.settable[i].count) set(i, values);
  for (const auto& output : fmu.outputs) {
    if (output.element == 0) outputs_.push_back(output.reference);
  }
  states_.resize(fmu.states.size());
  rates_.resize(fmu.states.size());
  indicators_.resize(fmu.indicators);
}

// Gives the variable i its value, or its table over time; an array with its first element at i.
void FmuRun::set(std::size_t i, const ParameterValues& values) {
  const FmuDescription& fmu = model_->fmu.description;
  bool differs = false;
  std::vector<double> numbers;
  std::vector<std::pair<std::size_t, TimeTable<double>>> tables;
  for (std::size_t k = i; k < i + fmu.settable[i].count; ++k) {
    const auto table = values.tables.find(k);
    const bool is_table = table != values.tables.end();
    if (is_table) tables.emplace_back(input_values_.size() + numbers.size(), table->second);
    numbers.push_back(is_table ? table->second(fmu.start) : values.numbers[k]);
    differs = differs || numbers.back() != defaultOf(fmu.settable[k]);
  }
  if (differs) values_.emplace_back(&fmu.settable[i], numbers);
  if (tables.empty()) return;
  tables_.insert(tables_.end(), tables.begin(), tables.end());
  input_references_.push_back(fmu.settable[i].reference);
  input_values_.insert(input_values_.end(), numbers.begin(), numbers.end());
}

FmuRun::~FmuRun() {
  const std::lock_guard lock(slot_->mutex);
  if (slot_->owner != this) return;
  slot_->instance.reset();
  slot_->owner = nullptr;
}

// Sets states and signs after the event in which the instance has been. An indicator that the event has left at 0 (a
// ball on the floor that it leaves) goes through 0 at once, where the standard has another event: it belongs to the
// first one. Else each impact were two switches, and the step size would begin anew twice.
void FmuRun::settle(Epoch& epoch) {
  FmuInstance& instance = *slot_->instance;
  epoch.after.resize(states_.size());
  const auto require = [&](bool good) {
    if (!good) throw Misuse(fmt::format("its rates or event indicators cannot be computed at t = {:g}", epoch.t));
  };
  require(instance.states(epoch.after.data()) && instance.indicators(indicators_.data()));
  setSigns(epoch);
  if (indicators_.empty() || !instance.derivatives(rates_.data())) return;
  const double ahead = kAtOnce * (model_->fmu.description.stop - model_->fmu.description.start);
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = epoch.after[i] + ahead * rates_[i];
  if (!moveTo(epoch.t + ahead, states_.data()) || !instance.indicators(indicators_.data())) return;
  const std::vector<double> before = epoch.signs;
  setSigns(epoch);
  if (epoch.signs == before) return;
  const FmuEvent second = eventAt(epoch.t + ahead);
  if (second.states_changed) require(instance.states(epoch.after.data()));
  require(instance.indicators(indicators_.data()));
  setSigns(epoch);
  const bool jumps = epoch.event.states_changed || second.states_changed;
  epoch.event = second;
  epoch.event.states_changed = jumps;
}

void FmuRun::setSigns(Epoch& epoch) const {
  epoch.signs.clear();
  for (const double z : indicators_) epoch.signs.push_back(z > 0 ? 1 : -1);
}

void FmuRun::beginAnew() {
  const FmuDescription& fmu = model_->fmu.description;
  Epoch first{0, fmu.start, {}, {}, {}, {}};
  if (slot_->owner != this || !slot_->instance->returnToStart()) {
    slot_->owner = nullptr;
    slot_->instance.reset();  // before the next one: it may be the only one that is possible
    slot_->instance = model_->instance();
    first.event = slot_->instance->begin(values_, fmu.start, fmu.stop);
    if (first.event.terminates) throw Misuse("it ends the simulation at the start (terminateSimulation)");
  }
  settle(first);
  slot_->owner = this;
  slot_->epoch = 0;
  if (!epochs_.empty()) return;
  if (fmu.indicators > 0 || first.event.has_next_time) switches_ = fmu.indicators + 1;
  epochs_.push_back(std::move(first));
}

// Repeats the event with which a remembered epoch begins.
void FmuRun::repeat(std::size_t number) {
  Epoch again = epochs_[number];
  moveTo(again.t, again.before.data());
  again.event = eventAt(again.t);
  settle(again);
  slot_->epoch = number;
}

std::unique_lock<std::mutex> FmuRun::enter(double number) {
  std::unique_lock lock(slot_->mutex);
  const auto epoch = static_cast<std::size_t>(number);
  if (slot_->owner == this && slot_->epoch == epoch) return lock;
  const std::size_t known = std::max<std::size_t>(epochs_.size(), 1);
  if (!(number >= 0) || epoch >= known) throw Misuse(fmt::format("there is no epoch {} of the FMU", number));
  if (slot_->owner != this) beginAnew();
  std::vector<std::size_t> missing;
  for (std::size_t at = epoch; at != slot_->epoch; at = epochs_[at].parent) {
    if (at == 0) {  // the instance is in an epoch that does not lead to this one
      beginAnew();
      break;
    }
    missing.push_back(at);
  }
  std::for_each(missing.rbegin(), missing.rend(), [this](std::size_t at) { repeat(at); });
  return lock;
}

bool FmuRun::moveTo(double t, const double* states) {
  FmuInstance& instance = *slot_->instance;
  if (!instance.setPoint(t, states)) return false;
  for (const auto& [place, table] : tables_) input_values_[place] = table(t);
  return tables_.empty() || instance.setInputs(input_references_, input_values_);
}

bool FmuRun::setPoint(double t, const double* y) {
  for (std::size_t k = 0; k < states_.size(); ++k) states_[model_->order[k]] = y[k];
  return moveTo(t, states_.data());
}

// The rows of u'' are the derivatives of v.
void FmuRun::toScene(const std::vector<double>& rates, double* f) const {
  for (std::size_t k = model_->nu; k < rates.size(); ++k) f[k - model_->nu] = rates[model_->order[k]];
}

void FmuRun::statesOf(const Epoch& epoch, double* y) const {
  for (std::size_t k = 0; k < epoch.after.size(); ++k) y[k] = epoch.after[model_->order[k]];
}

bool FmuRun::rates(double t, const double* y, double epoch, double* f) {
  const auto lock = enter(epoch);
  if (!setPoint(t, y) || !slot_->instance->derivatives(rates_.data())) return false;
  toScene(rates_, f);
  return true;
}

bool FmuRun::product(double t, const double* y, double epoch, const double* dy, double* df) {
  const auto lock = enter(epoch);
  if (!setPoint(t, y)) return false;
  for (std::size_t k = 0; k < states_.size(); ++k) states_[model_->order[k]] = dy[k];
  if (!slot_->instance->product(states_.data(), rates_.data())) return false;
  toScene(rates_, df);
  return true;
}

bool FmuRun::outputs(double t, const double* y, double epoch, double* values) {
  const auto lock = enter(epoch);
  return setPoint(t, y) && slot_->instance->values(outputs_, values, model_->fmu.description.outputs.size());
}

bool FmuRun::switching(double t, const double* y, double number, double* g) {
  const auto lock = enter(number);
  const Epoch& epoch = epochs_[static_cast<std::size_t>(number)];
  const std::size_t count = indicators_.size();
  if (!setPoint(t, y) || !slot_->instance->indicators(indicators_.data())) return false;
  for (std::size_t i = 0; i < count; ++i) g[i] = -epoch.signs[i] * indicators_[i];
  g[count] = epoch.event.has_next_time ? t - epoch.event.next_time : -1;
  return true;
}

// Integrators may end a step at the root of an indicator and not behind it; an FMU that asks for z < 0 would not see
// its own event. Moves the point along the rates until the indicator has changed its sign.
void FmuRun::goBehindRoot(std::size_t i, double sign, double& t) {
  FmuInstance& instance = *slot_->instance;
  const auto is_behind = [&] { return instance.indicators(indicators_.data()) && -sign * indicators_[i] > 0; };
  if (is_behind() || !instance.derivatives(rates_.data())) return;
  constexpr int kDoublings = 10;
  const std::vector<double> at = states_;
  double ahead = kAtOnce * (model_->fmu.description.stop - model_->fmu.description.start);
  for (int k = 0; k < kDoublings; ++k, ahead *= 2) {
    for (std::size_t j = 0; j < at.size(); ++j) states_[j] = at[j] + ahead * rates_[j];
    if (!moveTo(t + ahead, states_.data()) || !is_behind()) continue;
    t += ahead;
    return;
  }
  states_ = at;
  moveTo(t, states_.data());
}

// Returns whether the FMU asks for an event at the point that was set last, where a step has ended.
bool FmuRun::tellStep(double t) {
  if (!model_->fmu.description.steps_completed) return false;
  const FmuStep asked = slot_->instance->completeStep();
  if (asked.terminates) throw terminated(t);
  return asked.event;
}

FmuEvent FmuRun::eventAt(double t) {
  tellStep(t);
  return slot_->instance->event();
}

double FmuRun::event(std::size_t i, double t, const double* y, double number) {
  const auto lock = enter(number);
  const auto parent = static_cast<std::size_t>(number);
  // The FMU may compare its time with the one that it has asked for.
  if (i == indicators_.size()) t = epochs_[parent].event.next_time;
  if (!setPoint(t, y)) throw Misuse(fmt::format("it cannot be evaluated at its event at t = {:g}", t));
  if (i < indicators_.size()) goBehindRoot(i, epochs_[parent].signs[i], t);
  const std::size_t known = repeated(parent, t);
  return static_cast<double>(known > 0 ? known : beginEpoch(parent, t, eventAt(t)));
}

bool FmuRun::completeStep(double t, double* y, double& number) {
  const auto lock = enter(number);
  const auto parent = static_cast<std::size_t>(number);
  if (!setPoint(t, y)) throw Misuse(fmt::format("it cannot be evaluated at the end of a step, t = {:g}", t));
  std::size_t next = repeated(parent, t);
  if (next == 0) {
    if (!tellStep(t)) return false;
    next = beginEpoch(parent, t, slot_->instance->event());
  }
  number = static_cast<double>(next);
  if (epochs_[next].event.states_changed) statesOf(epochs_[next], y);
  return true;
}

// The epoch that the same event has begun in a run before, at the point that was set last; 0: none.
std::size_t FmuRun::repeated(std::size_t parent, double t) const {
  for (std::size_t at = parent + 1; at < epochs_.size(); ++at) {
    const Epoch& known = epochs_[at];
    if (known.parent == parent && known.t == t && known.before == states_) return at;
  }
  return 0;
}

// The instance has had `event` at the point that was set last.
std::size_t FmuRun::beginEpoch(std::size_t parent, double t, const FmuEvent& event) {
  Epoch next{parent, t, states_, {}, {}, event};
  if (!next.event.terminates) settle(next);
  if (next.event.terminates) throw terminated(t);
  if (next.event.has_next_time && switches_ == 0) {
    throw Misuse(fmt::format(
        "at t = {:g} it sets an event in time, t = {:g}: an FMU without event indicators has to set its first one when "
        "it is initialized",
        t, next.event.next_time));
  }
  slot_->epoch = epochs_.size();
  epochs_.push_back(std::move(next));
  return slot_->epoch;
}

void FmuRun::jump(double number, double* y) {
  const auto lock = enter(number);
  const Epoch& epoch = epochs_[static_cast<std::size_t>(number)];
  if (epoch.event.states_changed) statesOf(epoch, y);
}

void FmuRun::start(double* y) {
  const auto lock = enter(0);
  statesOf(epochs_[0], y);
}

}  // namespace irk::own
