// Step-size controllers; they see error estimates and step sizes only.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/options/catalogue.h"

namespace irk {

struct StepDecision {
  bool accept = true;
  double h = 0;  ///< of the next attempt
};

class StepController {
 public:
  virtual ~StepController() = default;
  /// After a converged attempt: `error` in the error norm (1 = tolerance).
  virtual StepDecision decide(double error, double h) = 0;
  /// After Newton failed: the step to try next.
  virtual double afterFailure(double h) = 0;
  /// After a restart: forgets the steps before it.
  virtual void forget() = 0;
  /// What new factors cost, in steps; every new size needs some. A controller may keep a step that would grow little.
  virtual void factorsCost(double steps) { static_cast<void>(steps); }
  /// From now on errors fall with h^(order+1); with the new order the last step h would have had `error`.
  virtual void changeOrder(int order, double error, double h) = 0;
};

using ControllerMaker = std::function<std::unique_ptr<StepController>(const StepOptions&, int order)>;

/// How steps are chosen.
template <>
struct Strategy<StepControl> {
  StepControl id;
  std::string meaning;
  Needs needs = {};
  ControllerMaker make;  ///< null for fixed steps
};
template <>
Catalogue<StepControl>& catalogue<StepControl>();

/// `order`: p of the estimate's leading error h^(p+1).
std::unique_ptr<StepController> makeController(const StepOptions& options, int order);

}  // namespace irk
