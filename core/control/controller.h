// Step-size controllers; they see error estimates and step sizes only.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "core/options/catalogue.h"
#include "irk/scalar.h"

namespace irk {

/// An estimate of zero counts as this: it divides.
inline constexpr double kTinyError = 1e-300;

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

/// The sizes of the last steps before an end. Where more than h but less than 2 h is left, two equal steps are taken: h
/// would leave a tiny one, which round-off spoils (in index 3 multipliers have the round-off of positions divided by
/// h^2).
template <class Real>
class LastSteps {
 public:
  void begin() { half_ = Real(0); }
  /// The size of the next step if h is allowed and `left` is left up to `end`.
  Real size(double h, const Real& left, const Real& end) {
    using std::abs;
    const double rest = static_cast<double>(left);
    reaches_ = h * (1 + 1e-10) >= rest;
    cut_ = reaches_ || 2 * h > rest;
    // The second half has the size of the first, so that factors are kept; it may differ by the round-off of t.
    const bool second = reaches_ && abs(Real(left - half_)) <= Real(8) * Eigen::NumTraits<Real>::epsilon() * abs(end);
    const Real half = second ? half_ : Real(left / Real(2));
    half_ = cut_ && !reaches_ ? half : Real(0);
    return second ? half : reaches_ ? left : cut_ ? half : Real(h);
  }
  bool reachesEnd() const { return reaches_; }  ///< the step of the last size
  bool cut() const { return cut_; }             ///< it is shorter than it may be

 private:
  Real half_{0};
  bool reaches_ = false, cut_ = false;
};

}  // namespace irk
