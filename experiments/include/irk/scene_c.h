/* A scene of your own as a shared library, in C or any language that can be called from C:
 *
 *   cc -O2 -shared -fPIC my_model.c -o my_model.so
 *   irk solve my_model.so --tol 1e-8
 *
 * The library exports functions of this file: irk_scene_version, irk_scene_size, and either irk_scene_rates or
 * irk_scene_residual; all others are optional. The scene's id is the name of the file without .so, in small letters.
 *
 * Unknowns. nu second-order unknowns u (with v = u'), nx first-order unknowns x, nz algebraic unknowns z:
 *
 *   y = (u, v, x, z)   2 nu + nx + nz numbers
 *   w = (u'', x')      nu + nx numbers
 *   d                  the discrete state, `discrete` numbers: it changes at switches and declared times only
 *
 * The equations are nu + nx + nz - constraints rows: those of u'', of x', and the algebraic ones. The position
 * constraints g(t, u) = 0 come from irk_scene_constraints; their multipliers are the first of z, and their forces
 * -G^T z stand in the rows of u''.
 *
 * Matrices are stored by columns. Time is in s. `self` is what irk_scene_open has made, or NULL without this function.
 * Functions with a result return 0, or another number where they cannot be computed: then the step is made smaller.
 * They must depend on their arguments and on `self` only, since steps are repeated. Numbers are double: runs in 50
 * digits and the formulation ggl do not exist for such a scene. */
#ifndef IRK_SCENE_C_H
#define IRK_SCENE_C_H

/* Names as C libraries have them: NOLINTBEGIN(readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* Of this interface; what irk_scene_version has to return. */
#define IRK_SCENE_VERSION 1
/* The room of each text that a function writes, with the 0 at its end. */
#define IRK_SCENE_TEXT 256

typedef struct irk_scene_sizes {
  int nu, nx, nz;      /* second-order, first-order and algebraic unknowns */
  int constraints;     /* position constraints; up to nz */
  int discrete;        /* numbers of the discrete state */
  int switches;        /* switching functions */
  int times;           /* times at which the equations jump or have a kink */
  int outputs;         /* quantities derived from the state */
  int algebraic_index; /* the index of the algebraic unknowns that are no multipliers: 1 or 2; 0 counts as 1 */
  int concurrent;      /* other than 0: several threads may call functions at the same time */
} irk_scene_sizes;

/* --- What the library is. */

int irk_scene_version(void); /* IRK_SCENE_VERSION */
/* One line for `irk list scenes`. */
void irk_scene_title(char* title);
/* Parameter i, from 0 on (`--set name=value`): its name, unit and meaning, and default, smallest and largest value in
 * `range`. Returns 0 if there is no parameter i, else 1. */
int irk_scene_parameter(int i, char* name, char* unit, char* meaning, double* range);

/* --- A scene with values of its parameters, in their order. */

/* Other than 0: it cannot be made, and `message` says why in one line. Each run opens a scene. */
int irk_scene_open(const double* parameters, void** self, char* message);
void irk_scene_close(void* self);
/* All sizes are 0 when it is called. */
void irk_scene_size(void* self, irk_scene_sizes* sizes);
/* Component i of (u, x, z), from 0 on: name, unit and typical magnitude > 0, and that of the derivative of a u. Without
 * it they are y1, y2, ..., no unit, and 1. */
void irk_scene_component(void* self, int i, char* name, char* unit, double* scale, double* rate_scale);
/* The start: t[0] and the end t[1], which are 0 and 1 when it is called; u, v, x and first guesses of z in y, first
 * guesses of w, and d, all 0 when it is called. w and z are then computed. Without it all is left as it is. */
void irk_scene_start(void* self, double* t, double* y, double* w, double* d);

/* --- Tables of measured data. These two functions belong to the program, which loads the library: declared here, to be
 * called by it. */

typedef struct irk_table irk_table;
/* In irk_scene_open: the column y of a CSV file over its column t, linear between the rows, or with cubic other than 0
 * a monotone cubic. The file lies beside the library; irk/table.h says what it looks like. The rows at which the table
 * has a kink join the `times`, and the file's content is part of the scene. The table lives until irk_scene_close. NULL
 * if it cannot be read: irk_scene_open then returns a number other than 0, and needs no message. */
const irk_table* irk_table_open(const char* file, const char* t, const char* y, int cubic);
/* A run does not leave the times of the table. */
double irk_table_value(const irk_table* table, double t);

/* --- The equations: one of the first two. */

/* f of M(t, y) w = f(t, y) (the rows of u'' and x') and of 0 = f(t, y) (the algebraic rows). */
int irk_scene_rates(void* self, double t, const double* y, const double* d, double* f);
/* The rows r(t, y, w) = 0, -M w + f in the form of the above. dr/dw may be singular, as in a circuit. */
int irk_scene_residual(void* self, double t, const double* y, const double* w, const double* d, double* r);
/* M of irk_scene_rates: (nu + nx) x (nu + nx) numbers, all 0 when it is called. Without it M = I. */
int irk_scene_mass(void* self, double t, const double* y, const double* d, double* M);
/* The position constraints, to be given three times: g for level 0, dg/dt for 1, d2g/dt2 for 2. g(t, u) depends on t
 * and u only, dg/dt on v as well, d2g/dt2 on v and on u'' in w. */
int irk_scene_constraints(void* self, int level, double t, const double* y, const double* w, double* g);

/* --- Their derivatives: the first, or the third, or none. Without them they are made by central differences, two
 * evaluations of all rows per column or colour of the Jacobian. */

/* The derivatives of all rows with respect to y, and for irk_scene_residual to (y, w): rows x columns numbers, all 0
 * when it is called; with irk_scene_entries only its entries, in its order. For irk_scene_rates with a mass matrix that
 * depends on y the rows are f - M w. */
int irk_scene_jacobian(void* self, double t, const double* y, const double* w, const double* d, double* J);
/* The places where the Jacobian is not 0, rows and columns from 0 on. Returns their number; writes nothing if `row` is
 * null. */
int irk_scene_entries(void* self, int* row, int* column);
/* The product of the Jacobian and a vector: dr = dr/dy dy + dr/dw dw. For irk_scene_rates dw is null. */
int irk_scene_product(void* self, double t, const double* y, const double* w, const double* d, const double* dy,
                      const double* dw, double* dr);

/* --- Switches. d is valid while all g <= 0; g[i] > 0: switch i is due. */

/* `switches` numbers. A function that has no meaning in a mode is -1. */
int irk_scene_switching(void* self, double t, const double* y, const double* w, const double* d, double* g);
/* For messages; without it the number. */
void irk_scene_switch_name(void* self, int i, char* name);
/* Changes d at switch i. */
void irk_scene_on_switch(void* self, int i, double t, const double* y, const double* w, double* d);
/* Changes u, v and x in y at switch i, where d is the new discrete state. A scene with it needs --discontinuity locate.
 */
void irk_scene_jump(void* self, int i, double t, double* y, const double* d);
/* The `times`, ascending. A step ends at each. */
void irk_scene_times(void* self, double* times);
/* Changes d after time i. */
void irk_scene_on_time(void* self, int i, double t, const double* y, const double* w, double* d);

/* Changes u, v and x in y at time i, as at a blow or a dose; d is already the one after it. Not called at the end, and
 * not for times up to the start. */
void irk_scene_jump_at_time(void* self, int i, double t, double* y, const double* d);

/* --- Quantities derived from the state. */

/* Quantity i: name and unit; *invariant other than 0: it is constant on the exact solution (an energy). */
void irk_scene_output(void* self, int i, char* name, char* unit, int* invariant);
/* All of them. */
void irk_scene_outputs(void* self, double t, const double* y, const double* w, const double* d, double* values);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
