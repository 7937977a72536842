#include "tableaus/families/nodes.h"

#include <Eigen/Eigenvalues>

namespace irk {
namespace {

// The start values have 14 digits. Near the ends of the interval each Newton step squares the error and multiplies it
// by about n^2. At n = 100 the errors are 1e-14, 1e-24, 1e-44, 1e-84, 1e-164. One step more removes round-off.
int newtonSteps() {
  int steps = 1;
  for (int known = 10; known < WorkingDigits::now(); known *= 2) ++steps;
  return steps;
}

/// Monic Jacobi polynomials on [-1, 1]: p_{k+1} = (x - center_k) p_k - scale_k p_{k-1}.
struct Recurrence {
  Vec<BigFloat> center, scale;
};

// Gautschi, Orthogonal Polynomials (2004), table 1.1. With alpha = beta every center is zero.
Recurrence jacobiRecurrence(Index n, int alpha, int beta) {
  Recurrence recurrence{Vec<BigFloat>::Zero(n), Vec<BigFloat>::Zero(n)};
  for (Index k = 0; k < n; ++k) {
    const BigFloat m = 2 * k + alpha + beta;
    if (alpha != beta) {
      recurrence.center[k] = BigFloat(beta * beta - alpha * alpha) / (m * (m + 2));
    }
    if (k > 0) {
      recurrence.scale[k] =
          BigFloat(4 * k * (k + alpha) * (k + beta) * (k + alpha + beta)) / (m * m * (m + 1) * (m - 1));
    }
  }
  return recurrence;
}

// Golub & Welsch, Math. Comp. 23 (1969): zeros are eigenvalues of the symmetric tridiagonal matrix.
Vec<double> startValues(const Recurrence& recurrence) {
  const Index n = recurrence.center.size();
  const Vec<double> diagonal = recurrence.center.cast<double>();
  const Vec<double> subdiagonal = recurrence.scale.tail(n - 1).cast<double>().cwiseSqrt();
  Eigen::SelfAdjointEigenSolver<Mat<double>> solver;
  solver.computeFromTridiagonal(diagonal, subdiagonal, Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

/// x - p_n(x) / p_n'(x).
BigFloat newtonStep(const Recurrence& recurrence, const BigFloat& x) {
  BigFloat p = 1, p_before = 0, dp = 0, dp_before = 0;
  for (Index k = 0; k < recurrence.center.size(); ++k) {
    const BigFloat factor = x - recurrence.center[k];
    const BigFloat dp_next = p + factor * dp - recurrence.scale[k] * dp_before;
    const BigFloat p_next = factor * p - recurrence.scale[k] * p_before;
    p_before = p;
    dp_before = dp;
    p = p_next;
    dp = dp_next;
  }
  return x - p / dp;
}

}  // namespace

Vec<BigFloat> jacobiZeros(Index n, int alpha, int beta) {
  Vec<BigFloat> zeros(n);
  if (n == 0) return zeros;
  const Recurrence recurrence = jacobiRecurrence(n, alpha, beta);
  const Vec<double> start = startValues(recurrence);
  const int steps = newtonSteps();
  for (Index i = 0; i < n; ++i) {
    BigFloat x = start[i];
    for (int step = 0; step < steps; ++step) x = newtonStep(recurrence, x);
    zeros[i] = (1 + x) / 2;
  }
  return zeros;
}

}  // namespace irk
