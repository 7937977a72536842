/* A solver with the interface irk/peer_c.h, as simple as it can be: the implicit Euler method with a step and two half
 * steps, extrapolated to order 2. FORM is the form of the equations that it takes; with ROOTS it locates switches. */
#include <irk/peer_c.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dense_solve.h"

#ifndef FORM
#define FORM IRK_PEER_ODE
#endif
#ifndef ROOTS
#define ROOTS 0
#endif
#ifndef VERSION
#define VERSION IRK_PEER_VERSION
#endif

int irk_peer_version(void) { return VERSION; }

const irk_peer_description* irk_peer_describe(void) {
  static const irk_peer_description description = {"Implicit Euler, extrapolated", FORM, 2, ROOTS, 0};
  return &description;
}

typedef struct {
  const irk_peer_problem* p;
  irk_peer_counts* counts;
  double *J, *r, *yp;
} work;

static double weight(const irk_peer_problem* p, int i, double y) { return p->rtol * fabs(y) + p->atol[i]; }

/* The residual of an implicit Euler step of size h from y0 to y, and its Jacobian. */
static int equations(work* w, double t, double h, const double* y0, const double* y) {
  const irk_peer_problem* p = w->p;
  const int n = p->n;
  for (int i = 0; i < n; ++i) w->yp[i] = (y[i] - y0[i]) / h;
  if (FORM == IRK_PEER_DAE) {
    const int evaluated = p->residual(p->self, t, y, w->yp, w->r);
    return evaluated ? evaluated : p->jacobian(p->self, t, y, w->yp, 1 / h, w->J);
  }
  int evaluated = p->rates(p->self, t, y, w->r);
  if (!evaluated) evaluated = p->jacobian(p->self, t, y, NULL, 0, w->J);
  for (int j = 0; j < n; ++j) { /* f - M y', and its derivative */
    for (int i = 0; i < n; ++i) {
      const double M = p->mass ? p->mass[i + j * n] : i == j;
      w->r[i] -= M * w->yp[j];
      w->J[i + j * n] -= M / h;
    }
  }
  return evaluated;
}

/* Newton's method. Returns 0, 1 for no convergence, or IRK_PEER_STOP. */
static int euler(work* w, double t, double h, const double* y0, double* y) {
  const int n = w->p->n;
  memcpy(y, y0, sizeof(double) * (size_t)n);
  for (int k = 0; k < 10; ++k) {
    const int evaluated = equations(w, t, h, y0, y);
    if (evaluated) return evaluated;
    ++w->counts->newton_iterations;
    ++w->counts->solves;
    ++w->counts->factorizations;
    if (solve(n, w->J, w->r)) return 1;
    double size = 0;
    for (int i = 0; i < n; ++i) {
      y[i] -= w->r[i];
      size = fmax(size, fabs(w->r[i]) / weight(w->p, i, y[i]));
    }
    if (size < 1e-3) return 0;
  }
  return 1;
}

/* Other than 0 where a switching function is positive at y. */
static double due(work* w, double t, const double* y, double* g, int* roots) {
  const irk_peer_problem* p = w->p;
  double largest = 0;
  p->switching(p->self, t, y, w->yp, g);
  for (int i = 0; i < p->switches; ++i) {
    roots[i] = g[i] > 0;
    largest = fmax(largest, g[i]);
  }
  return largest;
}

int irk_peer_solve(const irk_peer_problem* p, double t, double t_end, double* y, double* yp, irk_peer_counts* counts) {
  const size_t n = (size_t)p->n;
  work w = {p, counts, malloc(sizeof(double) * n * n), malloc(sizeof(double) * n), malloc(sizeof(double) * n)};
  double *one = malloc(sizeof(double) * n), *half = malloc(sizeof(double) * n), *two = malloc(sizeof(double) * n);
  double* g = malloc(sizeof(double) * (size_t)(p->switches + 1));
  int* roots = calloc((size_t)(p->switches + 1), sizeof(int));
  double h = p->h > 0 ? p->h : 1e-5 * (t_end - t);
  int outcome = IRK_PEER_SUCCESS, failed = 0, near = 0;
  (void)yp;
  while (t < t_end) {
    h = fmin(fmin(h, p->h_max), t_end - t);
    failed = euler(&w, t + h, h, y, one);
    if (!failed) failed = euler(&w, t + h / 2, h / 2, y, half);
    if (!failed) failed = euler(&w, t + h, h / 2, half, two);
    double error = 0;
    for (size_t i = 0; !failed && i < n; ++i) {
      if (p->index[i] == 1) error = fmax(error, fabs(two[i] - one[i]) / weight(p, (int)i, y[i]));
      two[i] = 2 * two[i] - one[i];
    }
    if (failed == IRK_PEER_STOP) break;
    if (failed || error > 1) {
      failed ? ++counts->rejected_by_newton : ++counts->rejected_by_error;
      h *= failed ? 0.25 : fmax(0.2, 0.9 / sqrt(error));
      if (t + h > t) continue;
      p->explain(p->self, "the step\nis too small");
      outcome = IRK_PEER_STEP_TOO_SMALL;
      break;
    }
    const double found = p->locate && p->switches ? due(&w, t + h, two, g, roots) : 0;
    if (found > 0 && h > 1e-9) { /* halves the step until a tiny one goes over the switch */
      near = 1;
      h /= 2;
      continue;
    }
    const int last = t + h >= t_end - 1e-15 * fabs(t_end);
    t = last ? t_end : t + h;
    memcpy(y, two, sizeof(double) * n);
    if (p->accepted(p->self, t, y, w.yp, roots)) break;
    h *= near ? 1 : fmin(5, 0.9 / sqrt(fmax(error, 1e-4)));
    near = 0;
  }
  free(w.J), free(w.r), free(w.yp), free(one), free(half), free(two), free(g), free(roots);
  return outcome;
}
