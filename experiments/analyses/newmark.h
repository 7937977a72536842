// Newmark's method, to show that the 2-stage Lobatto IIIA scheme in K-form is identical to it.
#pragma once

namespace irk {

/// Takes steps of lobatto_iiia_2 on Kepler's problem (nonlinear, second order) and compares each one with Newmark's
/// formulas for beta = 1/4 and gamma = 1/2 from the same state:
///   u1 = u0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1)     v1 = v0 + h ((1 - gamma) a0 + gamma a1)
/// with a1 = a(u1, v1). Returns the largest difference of any component, in units of round-off of the largest
/// component.
double newmarkDifference();

}  // namespace irk
