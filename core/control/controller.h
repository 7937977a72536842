// Step-size controllers; they see error estimates and step sizes only.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/options/catalogue.h"

namespace irk {

struct StepDecision {
  bool accept = true;
  double h = 0;  ///< size of the next attempt
};

class StepController {
 public:
  virtual ~StepController() = default;
  /// After a solved attempt of size h: `error` is in the error norm (1 = tolerance).
  virtual StepDecision decide(double error, double h) = 0;
  /// After a failure of Newton's method with size h: returns the size to try next.
  virtual double afterFailure(double h) = 0;
  /// After a restart: forgets all steps before it.
  virtual void forget() = 0;
  /// The cost of new factors, in steps; each new size needs some. A controller may then keep a size that would grow
  /// little.
  virtual void factorsCost(double steps) { static_cast<void>(steps); }
  /// From now on errors fall with h^(order+1). `error`: what the last step, of size h, would have had with the new
  /// order.
  virtual void changeOrder(int order, double error, double h) = 0;
};

using ControllerMaker = std::function<std::unique_ptr<StepController>(const StepOptions&, int order)>;

/// A strategy of the axis `control`: how step sizes are chosen.
template <>
struct Strategy<StepControl> {
  StepControl id;
  std::string meaning;
  Needs needs = {};
  ControllerMaker make;  ///< null for fixed steps
};
template <>
Catalogue<StepControl>& catalogue<StepControl>();

/// The controller that the options name; null for fixed steps. `order`: p of the estimate's leading error h^(p+1).
std::unique_ptr<StepController> makeController(const StepOptions& options, int order);

}  // namespace irk
