// Step size control: deciders that know no matrices.
#pragma once

#include <memory>

#include "core/options.h"

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
  /// A restart: what came before says nothing.
  virtual void forget() = 0;
  /// Errors are h^(order+1) from now on; that of the last step h would have been `error`.
  virtual void changeOrder(int order, double error, double h) = 0;
};

/// `order`: p of the estimate's leading error h^(p+1).
std::unique_ptr<StepController> makeController(const StepOptions& options, int order);

}  // namespace irk
