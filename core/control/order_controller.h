// Controllers of the order: which member of a family takes the next steps. They see numbers of the last step only.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/options/catalogue.h"

namespace irk {

/// A member of a family.
struct OrderMember {
  double stages;
  int order;          ///< p of its estimate's leading error h^(p+1)
  double strictness;  ///< >= 1: factor of its estimate, by which all members err alike
};

/// What an order controller needs. The controller keeps a copy; `members` must outlive it.
struct OrderSetup {
  std::span<const OrderMember> members;  ///< by ascending stages
  double unknowns;                       ///< of the system
  /// The error of member i is proportional to weight(i). The first call for a member is slow.
  std::function<double(std::size_t i)> weight;
};

/// Facts about an accepted step.
struct OrderFacts {
  std::size_t at;  ///< the member that took it
  double error;    ///< its estimate times the strictness, in tolerances
  double lower;    ///< the estimate of the member below for this step; NaN if not known
  double theta;    ///< Newton's contraction
  int newton_iterations;
  double h, h_next;  ///< its size, and the step-size controller's next one for the same member
};

struct OrderDecision {
  std::size_t next;  ///< the member that takes the next step
  double h;          ///< of the next step
  double error;      ///< that the accepted step would have had with this member
};

class OrderController {
 public:
  virtual ~OrderController() = default;
  /// A new integration: forgets all steps.
  virtual void begin() = 0;
  /// After `failures` failures of Newton's method in a row with member `at`: returns the member of the next attempt.
  /// `solved`: whether this integration has solved a step before.
  virtual std::size_t afterFailure(std::size_t at, int failures, bool solved) = 0;
  /// Whether `decide` will use `lower` if the step tried now is accepted. Computing `lower` takes time.
  virtual bool needsLower() const = 0;
  virtual OrderDecision decide(const OrderFacts& facts) = 0;
};

using OrderControllerMaker = std::function<std::unique_ptr<OrderController>(const OrderSetup&)>;

/// A strategy of the axis `order`: how the order is chosen.
template <>
struct Strategy<OrderControl> {
  OrderControl id;
  std::string meaning;
  Needs needs = {};
  OrderControllerMaker make;  ///< null for one method
};
template <>
Catalogue<OrderControl>& catalogue<OrderControl>();

/// Whether an integration chooses among members of a family. Throws Misuse for an unknown id.
bool choosesOrder(OrderControl order);

/// The order controller with this id; null if one method takes all steps.
std::unique_ptr<OrderController> makeOrderController(OrderControl order, const OrderSetup& setup);

}  // namespace irk
