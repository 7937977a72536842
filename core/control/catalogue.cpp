// The controllers of the step size and of the order that come with the library.
#include "core/control/controller.h"
#include "core/control/order_controller.h"
#include "core/options/entries.h"

namespace irk {

IRK_STRATEGIES(StepControl, "control")
IRK_STRATEGIES(OrderControl, "order")

IRK_CATALOGUE(StepControl, predictiveControl(), paperControl(), paperControlWithoutGamma(), hotintControl(),
              fixedStepControl())
IRK_CATALOGUE(OrderControl, fixedOrder(), variableOrder())

std::unique_ptr<StepController> makeController(const StepOptions& options, int order) {
  const auto& make = catalogue<StepControl>()[options.control].make;
  return make ? madeBy(make, options.control, options, order) : nullptr;
}

std::unique_ptr<OrderController> makeOrderController(OrderControl order, const OrderSetup& setup) {
  const auto& make = catalogue<OrderControl>()[order].make;
  return make ? madeBy(make, order, setup) : nullptr;
}

bool choosesOrder(OrderControl order) { return catalogue<OrderControl>()[order].make != nullptr; }

}  // namespace irk
