// Nodes: zeros of Jacobi polynomials.
#pragma once

#include "irk/scalar.h"
#include "tableaus/families/precise.h"

namespace irk {

/// The n >= 0 zeros, ascending in (0, 1), of the polynomial of degree n that is orthogonal with weight (1 - c)^alpha
/// c^beta on [0, 1]; alpha, beta >= 0. At most about the last 5 of the working digits are wrong for n <= 100.
Vec<BigFloat> jacobiZeros(Index n, int alpha, int beta);

}  // namespace irk
