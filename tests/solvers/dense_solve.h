#ifndef IRK_TESTS_DENSE_SOLVE_H
#define IRK_TESTS_DENSE_SOLVE_H

#include <math.h>

/* Solves J x = r with pivoting; x replaces r. Returns other than 0 for a singular matrix. */
static int solve(int n, double* J, double* r) {
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i) best = fabs(J[i + k * n]) > fabs(J[best + k * n]) ? i : best;
    if (!(fabs(J[best + k * n]) > 0)) return 1;
    for (int j = 0; j < n; ++j) {
      const double swapped = J[k + j * n];
      J[k + j * n] = J[best + j * n];
      J[best + j * n] = swapped;
    }
    const double swapped = r[k];
    r[k] = r[best];
    r[best] = swapped;
    for (int i = k + 1; i < n; ++i) {
      const double factor = J[i + k * n] / J[k + k * n];
      for (int j = k; j < n; ++j) J[i + j * n] -= factor * J[k + j * n];
      r[i] -= factor * r[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) r[k] -= J[k + j * n] * r[j];
    r[k] /= J[k + k * n];
  }
  return 0;
}

#endif
