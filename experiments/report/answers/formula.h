// Theoretical orders as formulas in the number of stages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiments/analyses/orders/theory.h"

namespace irk::report {

struct OrderFormula {
  std::string text;      ///< `2s − 1`, `s; odd s: s + 1`, `s − 1; s = 1: 1`
  bool theorem = false;  ///< false: a pattern measured for few stages and continued
  Index divergent = 0;   ///< the largest s with an order of zero or less: smaller steps do not improve the component
};

/// The formula that theoreticalOrder follows for 1 to 20 stages, Lobatto families from 2 on, exceptions included.
/// nullopt if it knows no order, or if the orders follow no straight lines for even and odd s.
std::optional<OrderFormula> orderFormula(std::string_view family, SystemKind kind, char component);

}  // namespace irk::report
