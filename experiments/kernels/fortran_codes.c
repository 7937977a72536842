/* Two functions with the name and calling sequence of Hairer and Wanner's codes RADAU and RADAU5, for the benchmark of
 * the adapters: cheap codes, beside which the time of an adapter shows. Only what the benchmark needs is implemented:
 * full Jacobians, no mass matrix. */
#include <math.h>
#include <string.h>

typedef void fcn_t(int* n, double* x, double* y, double* f, double* rpar, int* ipar);
typedef void jac_t(int* n, double* x, double* y, double* dfy, int* ldfy, double* rpar, int* ipar);
typedef void mas_t(int* n, double* am, int* lmas, double* rpar, int* ipar);
typedef void solout_t(int* nr, double* xold, double* x, double* y, double* cont, int* lrc, int* n, double* rpar,
                      int* ipar, int* irtrn);

enum { kSize = 2 };

/* Solves (I - h J) dy = r for two unknowns, by Cramer's rule. */
static void solve(const double* J, double h, double* r) {
  const double a = 1 - h * J[0], b = -h * J[2], c = -h * J[1], d = 1 - h * J[3], det = a * d - b * c;
  const double first = (r[0] * d - b * r[1]) / det;
  r[1] = (a * r[1] - c * r[0]) / det;
  r[0] = first;
}

#define ARGUMENTS                                                                                                  \
  int *n, fcn_t *fcn, double *x, double *y, double *xend, double *h, double *rtol, double *atol, int *itol,        \
      jac_t *jac, int *ijac, int *mljac, int *mujac, mas_t *mas, int *imas, int *mlmas, int *mumas,                \
      solout_t *solout, int *iout, double *work, int *lwork, int *iwork, int *liwork, double *rpar, int *ipar, int *idid
#define UNUSED                                                                                                \
  (void)itol, (void)ijac, (void)mljac, (void)mujac, (void)mas, (void)imas, (void)mlmas, (void)mumas, (void)iout, \
      (void)work, (void)lwork, (void)liwork, (void)rtol, (void)atol, (void)h

/* Implicit Euler with constant steps of about h, each solved by simplified Newton with one Jacobian. */
void radau_(ARGUMENTS) {
  double J[kSize * kSize], f[kSize], y0[kSize], cont[kSize] = {0};
  UNUSED;
  *idid = -1;
  if (*n != kSize || !(*h > 0)) return;
  const int steps = (int)ceil((*xend - *x) / *h);
  const double start = *x, step = (*xend - *x) / steps;
  int nr = 1, irtrn = 0, lrc = 0, ldfy = *n;
  double xold = *x;
  solout(&nr, &xold, x, y, cont, &lrc, n, rpar, ipar, &irtrn);
  for (int k = 1; k <= steps && irtrn >= 0; ++k) {
    jac(n, x, y, J, &ldfy, rpar, ipar);
    ++iwork[14];
    xold = *x;
    *x = k == steps ? *xend : start + k * step;
    memcpy(y0, y, sizeof y0);
    double change = 1;
    for (int i = 0; i < 20 && change > 1e-8; ++i) {
      fcn(n, x, y, f, rpar, ipar);
      ++iwork[13];
      for (int j = 0; j < kSize; ++j) f[j] = y0[j] + step * f[j] - y[j];
      solve(J, step, f);
      for (int j = 0; j < kSize; ++j) y[j] += f[j];
      change = hypot(f[0], f[1]);
    }
    ++nr, ++iwork[16];
    solout(&nr, &xold, x, y, cont, &lrc, n, rpar, ipar, &irtrn);
  }
  *idid = irtrn < 0 ? 2 : 1;
}

/* Evaluates only: as many times as IWORK(2), the largest number of steps, says, with a Jacobian after each twenty. */
void radau5_(ARGUMENTS) {
  double J[kSize * kSize], f[kSize], at[kSize], cont[kSize] = {0};
  UNUSED;
  *idid = -1;
  if (*n != kSize) return;
  int nr = 1, irtrn = 0, lrc = 0, ldfy = *n;
  double xold = *x;
  solout(&nr, &xold, x, y, cont, &lrc, n, rpar, ipar, &irtrn);
  for (int k = 0; k < iwork[1]; ++k) {
    at[0] = y[0] + 1e-9 * k;
    at[1] = y[1];
    fcn(n, x, at, f, rpar, ipar);
    if (k % 20 == 0) jac(n, x, at, J, &ldfy, rpar, ipar);
  }
  y[0] += 1e-300 * (f[0] + J[0]); /* so that nothing can be left out */
  *x = *xend;
  iwork[13] = iwork[1], iwork[16] = 1;
  ++nr;
  solout(&nr, &xold, x, y, cont, &lrc, n, rpar, ipar, &irtrn);
  *idid = irtrn < 0 ? 2 : 1;
}
