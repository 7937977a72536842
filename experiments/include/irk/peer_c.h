/* A solver of your own as a shared library, in C or any language that can be called from C:
 *
 *   cc -O2 -shared -fPIC my_solver.c -o my_solver.so
 *   irk solve van_der_pol --method ./my_solver.so --tol 1e-8
 *
 * The library exports the three functions at the end of this file. Its method id is the name of the file without .so.
 * Matrices are stored by columns. */
#ifndef IRK_PEER_C_H
#define IRK_PEER_C_H

/* Names as C libraries have them: NOLINTBEGIN(readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* Of this interface; what irk_peer_version has to return. */
#define IRK_PEER_VERSION 1

/* The form of the equations. */
enum irk_peer_form {
  IRK_PEER_ODE = 0,  /* y' = f(t, y), y = (u, v, x) with u' = v */
  IRK_PEER_MASS = 1, /* M y' = f(t, y), M constant and perhaps singular */
  IRK_PEER_DAE = 2   /* F(t, y, y') = 0, y = (u, v, x, z); the first rows are u' - v */
};

/* What the solver is and can do. */
typedef struct irk_peer_description {
  const char* title; /* one line for `irk list methods` */
  int form;          /* of irk_peer_form */
  int max_index;     /* the largest index that it solves, 1 to 3; without effect for IRK_PEER_ODE */
  int finds_roots;   /* other than 0: its steps can end at roots of switching functions */
  int concurrent;    /* other than 0: several threads may call irk_peer_solve at the same time */
} irk_peer_description;

/* What evaluations return. After IRK_PEER_STOP the run is over (time limit, Ctrl-C): return at once. */
enum irk_peer_evaluated { IRK_PEER_DONE = 0, IRK_PEER_NOT_FINITE = 1, IRK_PEER_STOP = -1 };

/* What irk_peer_solve returns. */
enum irk_peer_outcome {
  IRK_PEER_SUCCESS = 0,
  IRK_PEER_NEWTON_FAILED = 1,
  IRK_PEER_STEP_TOO_SMALL = 2,
  IRK_PEER_MAX_STEPS = 3,
  IRK_PEER_NO_FINITE_VALUES = 4,
  IRK_PEER_SINGULAR = 5
};

/* The problem. Every function gets `self`, the pointer of this member. */
typedef struct irk_peer_problem {
  void* self;
  int n;            /* components of y */
  int second_order; /* y'[i] = y[i + second_order] for i < second_order */
  int switches;     /* switching functions */
  const int* index; /* n: 1 for differential and index-1 unknowns, else 2 or 3 */
  double rtol;
  const double* atol;  /* n: the error of y[i] is weighed by rtol |y[i]| + atol[i] */
  double h;            /* the first step; 0 = the solver's choice */
  double h_max;        /* the largest step */
  int locate;          /* other than 0: steps have to end where a switching function becomes positive */
  long long max_steps; /* accepted steps */
  const double* mass;  /* M of IRK_PEER_MASS, n x n; null: M = I */

  /* f(t, y) of IRK_PEER_ODE and IRK_PEER_MASS. */
  int (*rates)(void* self, double t, const double* y, double* f);
  /* F(t, y, y') of IRK_PEER_DAE. */
  int (*residual)(void* self, double t, const double* y, const double* yp, double* r);
  /* df/dy, or dF/dy + c dF/dy' of IRK_PEER_DAE: n x n numbers. yp may be null for the other forms. */
  int (*jacobian)(void* self, double t, const double* y, const double* yp, double c, double* J);
  /* The pattern of the Jacobian in compressed columns (column_start: n + 1 numbers), for large systems. Returns the
   * number of entries; 0 if the Jacobian is full. Valid until the next evaluation of a Jacobian. */
  int (*pattern)(void* self, const int** column_start, const int** row);
  /* As jacobian: the entries only, as many as `pattern` then says. `values` stays valid until the next evaluation. */
  int (*sparse_jacobian)(void* self, double t, const double* y, const double* yp, double c, const double** values);
  /* The switching functions: `switches` numbers. */
  void (*switching)(void* self, double t, const double* y, const double* yp, double* g);
  /* To be called after each accepted step; other than 0: return at once with IRK_PEER_SUCCESS. yp: of IRK_PEER_DAE.
   * roots: per switching function other than 0 where the step ends at its root; or null. */
  int (*accepted)(void* self, double t, const double* y, const double* yp, const int* roots);
  /* Other than 0: the run is over. For solvers that compute for long without an evaluation. */
  int (*stopped)(void* self);
  /* The reason of a failure, in one line. */
  void (*explain)(void* self, const char* text);
} irk_peer_problem;

/* Counts of one call; those that are not known stay 0. The suite counts evaluations and accepted steps. */
typedef struct irk_peer_counts {
  long long factorizations, solves, newton_iterations, rejected_by_error, rejected_by_newton;
} irk_peer_counts;

/* --- What the library exports. */

int irk_peer_version(void); /* IRK_PEER_VERSION */
const irk_peer_description* irk_peer_describe(void);
/* Integrates from (t, y, y') to t_end, exactly, and calls `accepted` after each step. y and yp (null unless
 * IRK_PEER_DAE) may be overwritten. Returns a value of irk_peer_outcome. It is called again after a switch. */
int irk_peer_solve(const irk_peer_problem* problem, double t, double t_end, double* y, double* yp,
                   irk_peer_counts* counts);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
