/* A stand-in for libraries that users compile from Hairer and Wanner's codes and from DASSL: functions with their
 * names and calling sequences, which use every argument that the adapters set. The method is extrapolated implicit
 * Euler. `standin_seen` says what the last call was given. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dense_solve.h"

enum { kBanded, kLower, kUpper, kM1, kMass, kMassBanded, kIndex2, kIndex3, kCalls, kSeen };
int standin_seen[kSeen];
/* Calls of radau5_ or rodas_ that began while another one ran. */
int standin_overlaps;
/* Rates that are not finite. RADAU would accept a step with them. */
int standin_not_finite;
static int running;
static void enter(void) {
  if (__atomic_add_fetch(&running, 1, __ATOMIC_SEQ_CST) > 1) __atomic_add_fetch(&standin_overlaps, 1, __ATOMIC_SEQ_CST);
}
static void leave(void) { __atomic_sub_fetch(&running, 1, __ATOMIC_SEQ_CST); }

typedef void fcn_t(int* n, double* x, double* y, double* f, double* rpar, int* ipar);
typedef void jac_t(int* n, double* x, double* y, double* dfy, int* ldfy, double* rpar, int* ipar);
typedef void mas_t(int* n, double* am, int* lmas, double* rpar, int* ipar);
typedef void solout_t(int* nr, double* xold, double* x, double* y, double* cont, int* lrc, int* n, double* rpar,
                      int* ipar, int* irtrn);
typedef void seulex_solout_t(int* nr, double* xold, double* x, double* y, double* rc, int* lrc, int* ic, int* lic,
                             int* n, double* rpar, int* ipar, int* irtrn);

typedef struct {
  int n, m1, banded, lower, upper, imas, mass_banded, mass_lower, mass_upper, rows;
  fcn_t* fcn;
  jac_t* jac;
  double *M, *J, *r, *fetched, *rpar;
  int* ipar;
} equations;

/* The n x n matrix of the reduced array: a band, or full; row i of the array is row i + m1. */
static void expand(const equations* e, const double* a, int rows, int banded, int upper, int columns_from, double* to) {
  const int reduced = e->n - e->m1;
  for (int j = columns_from; j < e->n; ++j) {
    const int column = j - columns_from, relative = columns_from ? column : (j < e->m1 ? j : j - e->m1);
    for (int i = 0; i < reduced; ++i) {
      const int row = banded ? i - relative + upper : i;
      to[i + e->m1 + j * e->n] = row >= 0 && row < rows ? a[row + column * rows] : 0;
    }
  }
}

static void linearize(equations* e, double x, double* y) {
  const int n = e->n;
  memset(e->J, 0, sizeof(double) * (size_t)(n * n));
  for (int i = 0; i < e->m1; ++i) e->J[i + (i + e->m1) * n] = 1;
  e->jac(&e->n, &x, y, e->fetched, &e->rows, e->rpar, e->ipar);
  expand(e, e->fetched, e->rows, e->banded, e->upper, 0, e->J);
}

static double weight(const double* rtol, const double* atol, int i, double y) { return rtol[i] * fabs(y) + atol[i]; }

/* One implicit Euler step by Newton's method; other than 0: no convergence. */
static int euler(equations* e, double x, double h, const double* y0, double* y, const double* rtol,
                 const double* atol) {
  const int n = e->n;
  memcpy(y, y0, sizeof(double) * (size_t)n);
  for (int k = 0; k < 10; ++k) {
    e->fcn(&e->n, &x, y, e->r, e->rpar, e->ipar);
    for (int i = 0; i < n; ++i) standin_not_finite += !isfinite(e->r[i]);
    linearize(e, x, y);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        e->r[i] -= e->M[i + j * n] * (y[j] - y0[j]) / h;
        e->J[i + j * n] -= e->M[i + j * n] / h;
      }
    }
    if (solve(n, e->J, e->r)) return 1;
    double size = 0;
    for (int i = 0; i < n; ++i) {
      y[i] -= e->r[i];
      size = fmax(size, fabs(e->r[i]) / weight(rtol, atol, i, y[i]));
    }
    if (size < 1e-3) return 0;
    if (!(size < 1e100)) return 1;
  }
  return 1;
}

static void code(int* n, fcn_t* fcn, double* x, double* y, double* xend, double* h, double* rtol, double* atol,
                 int* itol, jac_t* jac, int* ijac, int* mljac, int* mujac, mas_t* mas, int* imas, int* mlmas, int* mumas,
                 solout_t* solout, seulex_solout_t* seulex_solout, int* iout, double h_max, int max_steps, int* lwork,
                 int* iwork, int* liwork, double* rpar, int* ipar, int* idid) {
  const size_t size = (size_t)*n;
  equations e = {.n = *n, .m1 = iwork[8], .lower = *mljac, .upper = *mujac, .imas = *imas, .fcn = fcn, .jac = jac,
                 .rpar = rpar, .ipar = ipar};
  const int reduced = *n - e.m1;
  e.banded = *mljac < reduced;
  e.mass_banded = *mlmas < reduced;
  e.rows = e.banded ? *mljac + *mujac + 1 : reduced;
  *idid = -1;
  if (*itol != 1 || *ijac != 1 || *iout != 1 || iwork[8] != iwork[9] || 2 * e.m1 > *n) return;
  if (*lwork < *n * (2 * e.rows + 20) || *liwork < 3 * *n + 20 || (*imas && *mlmas > *mljac)) return;
  int seen[kSeen] = {e.banded, *mljac, *mujac, e.m1, *imas, e.mass_banded, iwork[5], iwork[6], standin_seen[kCalls] + 1};
  memcpy(standin_seen, seen, sizeof seen);
  e.M = calloc(size * size, sizeof(double));
  e.J = calloc(size * size, sizeof(double));
  e.fetched = calloc(size * size * 2, sizeof(double));
  e.r = calloc(size, sizeof(double));
  double *one = calloc(size, sizeof(double)), *half = calloc(size, sizeof(double)), *two = calloc(size, sizeof(double));
  for (int i = 0; i < *n; ++i) e.M[i + i * *n] = 1;
  if (*imas) {
    int rows = e.mass_banded ? *mlmas + *mumas + 1 : reduced, columns = reduced;
    mas(&columns, e.fetched, &rows, rpar, ipar);
    expand(&e, e.fetched, rows, e.mass_banded, *mumas, e.m1, e.M);
  }
  int nr = 1, irtrn = 0, lrc = 0, lic = 0;
  double xold = *x;
  if (*h == 0) *h = 1e-6;
  for (;; ++nr) {
    if (solout) solout(&nr, &xold, x, y, one, &lrc, n, rpar, ipar, &irtrn);
    if (seulex_solout) seulex_solout(&nr, &xold, x, y, one, &lrc, ipar, &lic, n, rpar, ipar, &irtrn);
    *idid = irtrn < 0 ? 2 : 1;
    if (irtrn < 0 || *x >= *xend * (1 - 1e-15)) break;
    *idid = -2;
    if (nr > max_steps) break;
    for (;;) {
      *h = fmin(*h, *xend - *x);
      if (h_max > 0) *h = fmin(*h, h_max);
      int failed = euler(&e, *x + *h, *h, y, one, rtol, atol);
      if (!failed) failed = euler(&e, *x + *h / 2, *h / 2, y, half, rtol, atol);
      if (!failed) failed = euler(&e, *x + *h, *h / 2, half, two, rtol, atol);
      double error = 0;
      const int tested = iwork[4] > 0 ? iwork[4] : *n;
      for (int i = 0; !failed && i < *n; ++i) {
        if (i < tested) error = fmax(error, fabs(two[i] - one[i]) / weight(rtol, atol, i, y[i]));
        two[i] = 2 * two[i] - one[i];
      }
      if (!failed && error <= 1) {
        xold = *x;
        *x += *h;
        memcpy(y, two, sizeof(double) * size);
        *h *= fmin(5, 0.9 / sqrt(fmax(error, 1e-4)));
        break;
      }
      ++iwork[17];
      *h *= failed ? 0.25 : fmax(0.2, 0.9 / sqrt(error));
      *idid = -3;
      if (*x + *h <= *x) goto end;
    }
  }
end:
  iwork[18] = iwork[19] = 3 * nr;
  free(e.M), free(e.J), free(e.r), free(e.fetched), free(one), free(half), free(two);
}

#define HEAD int *n, fcn_t *fcn
#define START double *x, double *y, double *xend, double *h, double *rtol, double *atol, int *itol
#define JAC jac_t *jac, int *ijac, int *mljac, int *mujac
#define MAS mas_t *mas, int *imas, int *mlmas, int *mumas
#define REST int *iout, double *work, int *lwork, int *iwork, int *liwork, double *rpar, int *ipar, int *idid

void radau5_(HEAD, START, JAC, MAS, solout_t* solout, REST) {
  enter();
  code(n, fcn, x, y, xend, h, rtol, atol, itol, jac, ijac, mljac, mujac, mas, imas, mlmas, mumas, solout, NULL, iout,
       work[6], iwork[1], lwork, iwork, liwork, rpar, ipar, idid);
  leave();
}
void radau_(HEAD, START, JAC, MAS, solout_t* solout, REST) {
  radau5_(n, fcn, x, y, xend, h, rtol, atol, itol, jac, ijac, mljac, mujac, mas, imas, mlmas, mumas, solout, iout, work,
          lwork, iwork, liwork, rpar, ipar, idid);
}
void rodas_(HEAD, int* ifcn, START, JAC, fcn_t* dfx, int* idfx, MAS, solout_t* solout, REST) {
  *idid = -1;
  if (*ifcn != 1 || *idfx != 0 || !dfx) return;
  enter();
  code(n, fcn, x, y, xend, h, rtol, atol, itol, jac, ijac, mljac, mujac, mas, imas, mlmas, mumas, solout, NULL, iout,
       work[1], iwork[0], lwork, iwork, liwork, rpar, ipar, idid);
  leave();
}
void seulex_(HEAD, int* ifcn, START, JAC, MAS, seulex_solout_t* solout, REST) {
  *idid = -1;
  if (*ifcn != 1) return;
  code(n, fcn, x, y, xend, h, rtol, atol, itol, jac, ijac, mljac, mujac, mas, imas, mlmas, mumas, NULL, solout, iout,
       work[1], iwork[1], lwork, iwork, liwork, rpar, ipar, idid);
}

/* --- DASSL and DASPK: fixed-order implicit Euler, one step per call; the error is that of a predictor. */

typedef void res_t(double* t, double* y, double* yp, double* delta, int* ires, double* rpar, int* ipar);
typedef void daspk_res_t(double* t, double* y, double* yp, double* cj, double* delta, int* ires, double* rpar,
                         int* ipar);
typedef void dae_jac_t(double* t, double* y, double* yp, double* pd, double* cj, double* rpar, int* ipar);

typedef struct {
  res_t* dassl;
  daspk_res_t* daspk;
  dae_jac_t* jac;
  int n, banded, ml, mu, rows;
  double *J, *pd, *r, *yp, *rpar;
  int* ipar;
} dae;

static int dae_euler(dae* e, double t, double h, const double* y0, double* y, const double* rtol, const double* atol) {
  const int n = e->n;
  double cj = 1 / h;
  memcpy(y, y0, sizeof(double) * (size_t)n);
  for (int k = 0; k < 10; ++k) {
    int ires = 0;
    for (int i = 0; i < n; ++i) e->yp[i] = (y[i] - y0[i]) / h;
    if (e->dassl) e->dassl(&t, y, e->yp, e->r, &ires, e->rpar, e->ipar);
    if (e->daspk) e->daspk(&t, y, e->yp, &cj, e->r, &ires, e->rpar, e->ipar);
    if (ires) return ires;
    e->jac(&t, y, e->yp, e->pd, &cj, e->rpar, e->ipar);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int row = e->banded ? i - j + e->ml + e->mu : i;
        const int inside = !e->banded || (i - j <= e->ml && j - i <= e->mu);
        e->J[i + j * n] = inside ? e->pd[row + j * e->rows] : 0;
      }
    }
    if (solve(n, e->J, e->r)) return 1;
    double size = 0;
    for (int i = 0; i < n; ++i) {
      y[i] -= e->r[i];
      size = fmax(size, fabs(e->r[i]) / weight(rtol, atol, i, y[i]));
    }
    if (size < 1e-3) return 0;
  }
  return 1;
}

static void dae_step(dae* e, double* t, double* y, double* yp, double tout, int* info, double* rtol, double* atol,
                     int* idid, double* rwork, int* lrw, int* iwork, int* liw) {
  const size_t n = (size_t)e->n;
  const double t_end = rwork[0]; /* TSTOP */
  e->banded = info[5], e->ml = iwork[0], e->mu = iwork[1];
  e->rows = e->banded ? 2 * e->ml + e->mu + 1 : e->n;
  *idid = -33;
  if (!info[1] || !info[2] || !info[3] || !info[4] || tout <= *t || tout > t_end) return;
  if (*lrw < 40 + e->n * (9 + e->rows) || *liw < 20 + e->n) return;
  if (!info[0] && !info[7]) rwork[2] = 1e-6;
  info[0] = 1;
  int seen[kSeen] = {e->banded, e->ml, e->mu, 0, 0, 0, 0, 0, standin_seen[kCalls] + 1};
  memcpy(standin_seen, seen, sizeof seen);
  e->J = calloc(n * n, sizeof(double)), e->pd = calloc((size_t)e->rows * n, sizeof(double));
  e->r = calloc(n, sizeof(double)), e->yp = calloc(n, sizeof(double));
  double *one = calloc(n, sizeof(double)), *half = calloc(n, sizeof(double)), *two = calloc(n, sizeof(double));
  for (;;) {
    double h = fmin(rwork[2], t_end - *t);
    if (info[6]) h = fmin(h, rwork[1]);
    int failed = dae_euler(e, *t + h, h, y, one, rtol, atol);
    if (!failed) failed = dae_euler(e, *t + h / 2, h / 2, y, half, rtol, atol);
    if (!failed) failed = dae_euler(e, *t + h, h / 2, half, two, rtol, atol);
    double error = 0;
    for (int i = 0; !failed && i < e->n; ++i) {
      error = fmax(error, fabs(two[i] - one[i]) / weight(rtol, atol, i, y[i]));
      two[i] = 2 * two[i] - one[i];
    }
    *idid = failed == -2 ? -11 : -6;
    if (failed == -2 || *t + h <= *t) break;
    if (failed || error > 1) {
      ++iwork[failed ? 14 : 13];
      rwork[2] = h * (failed ? 0.25 : fmax(0.2, 0.9 / sqrt(error)));
      continue;
    }
    *idid = *t + h >= t_end ? 2 : 1;
    *t = *idid == 2 ? t_end : *t + h;
    memcpy(y, two, sizeof(double) * n);
    memcpy(yp, e->yp, sizeof(double) * n);
    rwork[2] = h * fmin(5, 0.9 / sqrt(fmax(error, 1e-4)));
    ++iwork[12];
    break;
  }
  free(e->J), free(e->pd), free(e->r), free(e->yp), free(one), free(half), free(two);
}

void ddassl_(res_t* res, int* neq, double* t, double* y, double* yp, double* tout, int* info, double* rtol,
             double* atol, int* idid, double* rwork, int* lrw, int* iwork, int* liw, double* rpar, int* ipar,
             dae_jac_t* jac) {
  dae e = {.dassl = res, .jac = jac, .n = *neq, .rpar = rpar, .ipar = ipar};
  dae_step(&e, t, y, yp, *tout, info, rtol, atol, idid, rwork, lrw, iwork, liw);
}
void ddaspk_(daspk_res_t* res, int* neq, double* t, double* y, double* yp, double* tout, int* info, double* rtol,
             double* atol, int* idid, double* rwork, int* lrw, int* iwork, int* liw, double* rpar, int* ipar,
             dae_jac_t* jac, void (*psol)(void)) {
  dae e = {.daspk = res, .jac = jac, .n = *neq, .rpar = rpar, .ipar = ipar};
  (void)psol;
  dae_step(&e, t, y, yp, *tout, info, rtol, atol, idid, rwork, lrw, iwork, liw);
}
