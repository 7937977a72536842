#include "tableaus/nodes.h"

#include <Eigen/Eigenvalues>

namespace irk {
namespace {

// The start values carry 14 digits, near the ends with a constant of about n^2 per Newton step:
// 1e-14, 1e-24, 1e-44, 1e-84.
constexpr int kNewtonSteps = 4;

/// Monic Jacobi polynomials on [-1, 1]: p_{k+1} = (x - center_k) p_k - scale_k p_{k-1}.
struct Recurrence {
  Vec<mp80> center, scale;
};

// Gautschi, Orthogonal Polynomials (2004), table 1.1. With alpha = beta every center is zero.
Recurrence jacobiRecurrence(Index n, int alpha, int beta) {
  Recurrence recurrence{Vec<mp80>::Zero(n), Vec<mp80>::Zero(n)};
  for (Index k = 0; k < n; ++k) {
    const mp80 m = 2 * k + alpha + beta;
    if (alpha != beta) {
      recurrence.center[k] = mp80(beta * beta - alpha * alpha) / (m * (m + 2));
    }
    if (k > 0) {
      recurrence.scale[k] =
          mp80(4 * k * (k + alpha) * (k + beta) * (k + alpha + beta)) / (m * m * (m + 1) * (m - 1));
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
mp80 newtonStep(const Recurrence& recurrence, const mp80& x) {
  mp80 p = 1, p_before = 0, dp = 0, dp_before = 0;
  for (Index k = 0; k < recurrence.center.size(); ++k) {
    const mp80 factor = x - recurrence.center[k];
    const mp80 dp_next = p + factor * dp - recurrence.scale[k] * dp_before;
    const mp80 p_next = factor * p - recurrence.scale[k] * p_before;
    p_before = p;
    dp_before = dp;
    p = p_next;
    dp = dp_next;
  }
  return x - p / dp;
}

}  // namespace

Vec<mp80> jacobiZeros(Index n, int alpha, int beta) {
  Vec<mp80> zeros(n);
  if (n == 0) return zeros;
  const Recurrence recurrence = jacobiRecurrence(n, alpha, beta);
  const Vec<double> start = startValues(recurrence);
  for (Index i = 0; i < n; ++i) {
    mp80 x = start[i];
    for (int step = 0; step < kNewtonSteps; ++step) x = newtonStep(recurrence, x);
    zeros[i] = (1 + x) / 2;
  }
  return zeros;
}

}  // namespace irk
