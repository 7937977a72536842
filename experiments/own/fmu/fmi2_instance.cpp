#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "experiments/own/fmu/instance.h"

namespace irk::own {
namespace {

class Fmi2Instance final : public FmuInstance {
 public:
  explicit Fmi2Instance(const FmuLibrary& fmu) : FmuInstance(fmu, "fmi2", "GetDerivatives") {
    callbacks_ = {.logger = &Fmi2Instance::log,
                  .allocateMemory = [](size_t count, size_t size) { return std::calloc(count, size); },
                  .freeMemory = [](void* memory) { std::free(memory); },
                  .stepFinished = nullptr,
                  .environment = this};
    const std::string resources = "file://" + fmu.resources;
    instance_ = get<fmi2InstantiateTYPE>("fmi2Instantiate")(
        fmu.description.name.c_str(), 0, fmu.description.token.c_str(), resources.c_str(), &callbacks_, 0, 0);
    if (!instance_) throw Misuse("fmi2Instantiate fails" + (message_.empty() ? "" : ": " + message_));
  }
  ~Fmi2Instance() override { free(); }

  bool product(const double* seed, double* to) override {
    return good(get_product_(instance_, derivative_references_.data(), n_, references_.data(), n_, seed, to));
  }
  bool setInputs(const std::vector<unsigned>& references, const std::vector<double>& values) override {
    return good(set_real_(instance_, references.data(), references.size(), values.data()));
  }
  bool values(const std::vector<unsigned>& references, double* to, std::size_t) override {
    return good(get_real_(instance_, references.data(), references.size(), to));
  }

 private:
  static void log(void* self, const char*, fmiStatus status, const char*, const char* format, ...) {
    char text[1000] = "";
    va_list values;
    va_start(values, format);
    if (format) std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    static_cast<Fmi2Instance*>(self)->keepMessage(status, text);
  }

  void set(const FmuVariable& variable, double value) {
    const unsigned reference = variable.reference;
    const int whole = static_cast<int>(value);
    fmiStatus status = fmiOK;
    if (variable.type == FmuType::kReal) {
      status = set_real_(instance_, &reference, 1, &value);
    } else if (variable.type == FmuType::kInteger) {
      status = get<fmi2SetIntegerTYPE>("fmi2SetInteger")(instance_, &reference, 1, &whole);
    } else {
      status = get<fmi2SetBooleanTYPE>("fmi2SetBoolean")(instance_, &reference, 1, &whole);
    }
    require(status, ("setting " + variable.name).c_str());
  }

  void initialize(const std::vector<FmuValue>& values, double start, double stop) override {
    require(get<fmi2SetupExperimentTYPE>("fmi2SetupExperiment")(instance_, 0, 0, start, 1, stop),
            "fmi2SetupExperiment");
    for (const auto& [variable, numbers] : values) set(*variable, numbers.front());
    require(get<fmi2EnterInitializationModeTYPE>("fmi2EnterInitializationMode")(instance_),
            "fmi2EnterInitializationMode");
  }
  FmuStep completeStep(bool no_former_state) override {
    int event = 0, terminates = 0;
    require(step_(instance_, no_former_state ? 1 : 0, &event, &terminates), "fmi2CompletedIntegratorStep");
    return {event != 0, terminates != 0};
  }
  bool update(FmuEvent& event) override {
    fmi2EventInfo info{};
    require(new_states_(instance_, &info), "fmi2NewDiscreteStates");
    event.states_changed = event.states_changed || info.valuesOfContinuousStatesChanged != 0;
    event.terminates = info.terminateSimulation != 0;
    event.has_next_time = info.nextEventTimeDefined != 0;
    event.next_time = info.nextEventTime;
    return info.newDiscreteStatesNeeded != 0;
  }

  fmi2CallbackFunctions callbacks_{};
  fmi2NewDiscreteStatesTYPE* new_states_ = get<fmi2NewDiscreteStatesTYPE>("fmi2NewDiscreteStates");
  fmi2CompletedIntegratorStepTYPE* step_ = get<fmi2CompletedIntegratorStepTYPE>("fmi2CompletedIntegratorStep");
  fmi2SetRealTYPE* set_real_ = get<fmi2SetRealTYPE>("fmi2SetReal");
  fmi2GetRealTYPE* get_real_ = get<fmi2GetRealTYPE>("fmi2GetReal");
  fmi2GetDirectionalDerivativeTYPE* get_product_ =
      fmu_.description.directional_derivatives ? get<fmi2GetDirectionalDerivativeTYPE>("fmi2GetDirectionalDerivative")
                                               : nullptr;
};

}  // namespace

std::unique_ptr<FmuInstance> makeFmi2(const FmuLibrary& fmu) { return std::make_unique<Fmi2Instance>(fmu); }

}  // namespace irk::own
