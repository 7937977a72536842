#include <algorithm>

#include "experiments/own/fmu/instance.h"

namespace irk::own {
namespace {

class Fmi3Instance final : public FmuInstance {
 public:
  explicit Fmi3Instance(const FmuLibrary& fmu) : FmuInstance(fmu, "fmi3", "GetContinuousStateDerivatives") {
    const std::string resources = fmu.resources + "/";
    const auto log = [](void* self, fmiStatus status, const char*, const char* text) {
      static_cast<Fmi3Instance*>(self)->keepMessage(status, text);
    };
    instance_ = get<fmi3InstantiateModelExchangeTYPE>("fmi3InstantiateModelExchange")(
        fmu.description.name.c_str(), fmu.description.token.c_str(), resources.c_str(), false, false, this, log);
    if (!instance_) throw Misuse("fmi3InstantiateModelExchange fails" + (message_.empty() ? "" : ": " + message_));
  }
  ~Fmi3Instance() override { free(); }

  bool product(const double* seed, double* to) override {
    return good(get_product_(instance_, derivative_references_.data(), derivative_references_.size(),
                             references_.data(), references_.size(), seed, n_, to, n_));
  }
  bool setInputs(const std::vector<unsigned>& references, const std::vector<double>& values) override {
    return good(set_real_(instance_, references.data(), references.size(), values.data(), values.size()));
  }
  bool values(const std::vector<unsigned>& references, double* to, std::size_t count) override {
    return good(get_real_(instance_, references.data(), references.size(), to, count));
  }

 private:
  void set(const FmuVariable& variable, const std::vector<double>& numbers) {
    const unsigned reference = variable.reference;
    const std::size_t count = numbers.size();
    fmiStatus status = fmiOK;
    if (variable.type == FmuType::kReal) {
      status = set_real_(instance_, &reference, 1, numbers.data(), count);
    } else if (variable.type == FmuType::kInteger) {
      std::vector<std::int32_t> whole(count);
      std::transform(numbers.begin(), numbers.end(), whole.begin(), [](double x) { return std::int32_t(x); });
      status = get<fmi3SetInt32TYPE>("fmi3SetInt32")(instance_, &reference, 1, whole.data(), count);
    } else {
      const auto truths = std::make_unique<bool[]>(count);
      std::transform(numbers.begin(), numbers.end(), truths.get(), [](double x) { return x != 0; });
      status = get<fmi3SetBooleanTYPE>("fmi3SetBoolean")(instance_, &reference, 1, truths.get(), count);
    }
    require(status, ("setting " + variable.name).c_str());
  }

  void initialize(const std::vector<FmuValue>& values, double start, double stop) override {
    for (const auto& [variable, numbers] : values) set(*variable, numbers);
    require(get<fmi3EnterInitializationModeTYPE>("fmi3EnterInitializationMode")(instance_, false, 0, start, true, stop),
            "fmi3EnterInitializationMode");
  }
  FmuStep completeStep(bool no_former_state) override {
    FmuStep asked;
    require(step_(instance_, no_former_state, &asked.event, &asked.terminates), "fmi3CompletedIntegratorStep");
    return asked;
  }
  bool update(FmuEvent& event) override {
    bool again = false, nominals_changed = false, states_changed = false;
    event.has_next_time = false;
    require(update_(instance_, &again, &event.terminates, &nominals_changed, &states_changed, &event.has_next_time,
                    &event.next_time),
            "fmi3UpdateDiscreteStates");
    event.states_changed = event.states_changed || states_changed;
    return again;
  }

  fmi3UpdateDiscreteStatesTYPE* update_ = get<fmi3UpdateDiscreteStatesTYPE>("fmi3UpdateDiscreteStates");
  fmi3CompletedIntegratorStepTYPE* step_ = get<fmi3CompletedIntegratorStepTYPE>("fmi3CompletedIntegratorStep");
  fmi3SetFloat64TYPE* set_real_ = get<fmi3SetFloat64TYPE>("fmi3SetFloat64");
  fmi3GetFloat64TYPE* get_real_ = get<fmi3GetFloat64TYPE>("fmi3GetFloat64");
  fmi3GetDirectionalDerivativeTYPE* get_product_ =
      fmu_.description.directional_derivatives ? get<fmi3GetDirectionalDerivativeTYPE>("fmi3GetDirectionalDerivative")
                                               : nullptr;
};

}  // namespace

std::unique_ptr<FmuInstance> makeFmi3(const FmuLibrary& fmu) { return std::make_unique<Fmi3Instance>(fmu); }

}  // namespace irk::own
