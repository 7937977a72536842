/* The scene `kepler` in C, for tests: with derivatives of the kind DERIVATIVES (0: none, 1: a full Jacobian, 2: its
 * entries, 3: products), and with the fault that IRK_DAMAGE names. */
#include <irk/scene_c.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int damaged(const char* by) {
  const char* const damage = getenv("IRK_DAMAGE");
  return damage && strcmp(damage, by) == 0;
}

int irk_scene_version(void) { return damaged("version") ? 7 : IRK_SCENE_VERSION; }
void irk_scene_title(char* title) {
  strcpy(title, "two bodies");
  if (damaged("long title")) memset(title, 'x', IRK_SCENE_TEXT);
}
int irk_scene_parameter(int i, char* name, char* unit, char* meaning, double* range) {
  (void)unit;
  if (i > 0) return 0;
  strcpy(name, "e");
  strcpy(meaning, "eccentricity");
  range[0] = damaged("default") ? 2 : 0.6;
  range[1] = 0;
  range[2] = 0.99;
  return 1;
}

typedef struct {
  double e;
} Bodies;

int irk_scene_open(const double* parameters, void** self, char* message) {
  if (damaged("refuses")) {
    strcpy(message, "the table of e ends at 0.5");
    return 1;
  }
  *self = malloc(sizeof(Bodies));
  ((Bodies*)*self)->e = parameters[0];
  return 0;
}
void irk_scene_close(void* self) { free(self); }

void irk_scene_size(void* self, irk_scene_sizes* n) {
  (void)self;
  n->nu = damaged("size") ? -2 : 2;
  n->outputs = 1;
  n->discrete = n->switches = 1;
  n->times = damaged("times") ? 1 : 0;
  if (damaged("constraints")) n->nz = n->constraints = 1;
  if (damaged("index")) n->algebraic_index = 3;
  n->concurrent = 1;
}
void irk_scene_component(void* self, int i, char* name, char* unit, double* scale, double* rate_scale) {
  (void)self, (void)unit, (void)rate_scale;
  strcpy(name, i == 0 || damaged("twice a name") ? "q1" : "q2");
  if (damaged("scale")) *scale = -1;
}
void irk_scene_start(void* self, double* t, double* y, double* w, double* d) {
  const double e = ((Bodies*)self)->e;
  (void)d;
  t[1] = damaged("end") ? -1 : 62.83185307179586;
  y[0] = damaged("start") ? NAN : 1 - e;
  y[3] = sqrt((1 + e) / (1 - e));
  if (damaged("start behind")) w[2] = 1;
}
int irk_scene_rates(void* self, double t, const double* y, const double* d, double* f) {
  const double square = y[0] * y[0] + y[1] * y[1], r3 = square * sqrt(square);
  (void)self, (void)d;
  f[0] = -y[0] / r3;
  if (!damaged("row")) f[1] = -y[1] / r3;
  if (damaged("row behind")) f[2] = 0;
  if (damaged("row before")) f[-1] = 0;
  if (damaged("argument")) ((double*)y)[1] += 1;
  if (damaged("rows")) f[0] = NAN;
  if (damaged("fails") && t > 1) return 1;
  return 0;
}

#if DERIVATIVES > 0
static void slopes(const double* y, double* G) {
  const double square = y[0] * y[0] + y[1] * y[1], r3 = square * sqrt(square), r5 = r3 * square;
  G[0] = 3 * y[0] * y[0] / r5 - 1 / r3;
  G[1] = G[2] = 3 * y[0] * y[1] / r5;
  G[3] = 3 * y[1] * y[1] / r5 - 1 / r3;
  if (damaged("slope")) G[2] = -G[2];
}
#endif
#if DERIVATIVES == 1 || DERIVATIVES == 2
int irk_scene_jacobian(void* self, double t, const double* y, const double* w, const double* d, double* J) {
  (void)self, (void)t, (void)w, (void)d;
  slopes(y, J);
  if (damaged("slope behind")) J[8] = 0;
  return 0;
}
#endif
#if DERIVATIVES == 2
int irk_scene_entries(void* self, int* row, int* column) {
  (void)self;
  for (int k = 0; row && k < 4; ++k) {
    row[k] = k % 2;
    column[k] = k / 2;
  }
  if (row && damaged("entry")) column[3] = 4;
  return damaged("entries") ? 9 : 4;
}
#endif
#if DERIVATIVES == 3
int irk_scene_product(void* self, double t, const double* y, const double* w, const double* d, const double* dy,
                      const double* dw, double* dr) {
  double G[4];
  (void)self, (void)t, (void)w, (void)d, (void)dw;
  slopes(y, G);
  for (int i = 0; i < 2; ++i) dr[i] = G[i] * dy[0] + G[i + 2] * dy[1];
  return 0;
}
#endif

/* It never switches, unless it is damaged. */
int irk_scene_switching(void* self, double t, const double* y, const double* w, const double* d, double* g) {
  (void)self, (void)y, (void)w, (void)d;
  g[0] = damaged("switch behind") && d[0] < 0.5 ? t - 1 : -1;
  return 0;
}
void irk_scene_on_switch(void* self, int i, double t, const double* y, const double* w, double* d) {
  (void)self, (void)i, (void)t, (void)y, (void)w;
  d[0] = 1;
  d[1] = 1;
}

void irk_scene_output(void* self, int i, char* name, char* unit, int* invariant) {
  (void)self, (void)i, (void)unit;
  strcpy(name, "energy");
  *invariant = 1;
}
void irk_scene_outputs(void* self, double t, const double* y, const double* w, const double* d, double* values) {
  (void)self, (void)t, (void)w, (void)d;
  values[0] = (y[2] * y[2] + y[3] * y[3]) / 2 - 1 / sqrt(y[0] * y[0] + y[1] * y[1]);
}
