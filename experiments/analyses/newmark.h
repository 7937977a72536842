// Newmark's method, to show that the 2-stage Lobatto IIIA scheme in K-form is identical to it.
#pragma once

#include <string_view>
#include <vector>

namespace irk {

struct NewmarkDifference {
  std::string_view system;
  double h;           ///< the step size
  double difference;  ///< in units of round-off of the largest component
};

/// Takes 100 steps of lobatto_iiia_2 on nonlinear, damped, forced systems of second order and compares each one with
/// Newmark's formulas for beta = 1/4 and gamma = 1/2 from the same state:
///   u1 = u0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1)     v1 = v0 + h ((1 - gamma) a0 + gamma a1)
/// with a1 = a(t1, u1, v1). Each system with several step sizes; the differences are the largest of all steps and
/// components.
std::vector<NewmarkDifference> newmarkDifferences();

}  // namespace irk
