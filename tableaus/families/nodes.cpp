#include "tableaus/families/nodes.h"

#include <Eigen/Eigenvalues>

namespace irk {
namespace {

// The start values have 14 digits. Near the ends of the interval each Newton step squares the error and multiplies it
// by about n^2. At n = 100 the errors are 1e-14, 1e-24, 1e-44, 1e-84, 1e-164.
constexpr int kNewtonSteps = 5;

/// Monic Jacobi polynomials on [-1, 1]: p_{k+1} = (x - center_k) p_k - scale_k p_{k-1}.
template <class Real>
struct Recurrence {
  Vec<Real> center, scale;
};

// Gautschi, Orthogonal Polynomials (2004), table 1.1. With alpha = beta every center is zero.
template <class Real>
Recurrence<Real> jacobiRecurrence(Index n, int alpha, int beta) {
  Recurrence<Real> recurrence{Vec<Real>::Zero(n), Vec<Real>::Zero(n)};
  for (Index k = 0; k < n; ++k) {
    const Real m = 2 * k + alpha + beta;
    if (alpha != beta) {
      recurrence.center[k] = Real(beta * beta - alpha * alpha) / (m * (m + 2));
    }
    if (k > 0) {
      recurrence.scale[k] = Real(4 * k * (k + alpha) * (k + beta) * (k + alpha + beta)) / (m * m * (m + 1) * (m - 1));
    }
  }
  return recurrence;
}

// Golub & Welsch, Math. Comp. 23 (1969): zeros are eigenvalues of the symmetric tridiagonal matrix.
template <class Real>
Vec<double> startValues(const Recurrence<Real>& recurrence) {
  const Index n = recurrence.center.size();
  const Vec<double> diagonal = recurrence.center.template cast<double>();
  const Vec<double> subdiagonal = recurrence.scale.tail(n - 1).template cast<double>().cwiseSqrt();
  Eigen::SelfAdjointEigenSolver<Mat<double>> solver;
  solver.computeFromTridiagonal(diagonal, subdiagonal, Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

/// x - p_n(x) / p_n'(x).
template <class Real>
Real newtonStep(const Recurrence<Real>& recurrence, const Real& x) {
  Real p = 1, p_before = 0, dp = 0, dp_before = 0;
  for (Index k = 0; k < recurrence.center.size(); ++k) {
    const Real factor = x - recurrence.center[k];
    const Real dp_next = p + factor * dp - recurrence.scale[k] * dp_before;
    const Real p_next = factor * p - recurrence.scale[k] * p_before;
    p_before = p;
    dp_before = dp;
    p = p_next;
    dp = dp_next;
  }
  return x - p / dp;
}

}  // namespace

template <class Real>
Vec<Real> jacobiZeros(Index n, int alpha, int beta) {
  Vec<Real> zeros(n);
  if (n == 0) return zeros;
  const Recurrence<Real> recurrence = jacobiRecurrence<Real>(n, alpha, beta);
  const Vec<double> start = startValues(recurrence);
  for (Index i = 0; i < n; ++i) {
    Real x = start[i];
    for (int step = 0; step < kNewtonSteps; ++step) x = newtonStep(recurrence, x);
    zeros[i] = (1 + x) / 2;
  }
  return zeros;
}

template Vec<mp80> jacobiZeros(Index, int, int);
template Vec<mp130> jacobiZeros(Index, int, int);

}  // namespace irk
