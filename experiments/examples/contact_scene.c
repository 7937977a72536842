/* A scene in C: a mass that falls on an elastic floor with damping.
 *
 *   cc -O2 -shared -fPIC -I experiments/include contact_scene.c -o contact_scene.so
 *   irk solve contact_scene.so --tol 1e-8
 *
 * One second-order unknown, the gap; y = (u, v), w = (u''). d[0] is 1 in contact and 0 in flight. */
#include <irk/scene_c.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double m, c, b;
} Mass;
static const double g = 9.81; /* m/s^2 */

int irk_scene_version(void) { return IRK_SCENE_VERSION; }
void irk_scene_title(char* title) { strcpy(title, "a mass on an elastic floor, in C"); }

int irk_scene_parameter(int i, char* name, char* unit, char* meaning, double* range) {
  static const struct {
    const char *name, *unit, *meaning;
    double range[3]; /* default, smallest and largest value */
  } all[] = {{"m", "kg", "mass", {1, 1e-3, 1e3}},
             {"c", "N/m", "stiffness of the floor", {1e4, 1, 1e9}},
             {"b", "N s/m", "damping of the floor", {5, 0, 1e6}}};
  if (i >= 3) return 0;
  strcpy(name, all[i].name);
  strcpy(unit, all[i].unit);
  strcpy(meaning, all[i].meaning);
  memcpy(range, all[i].range, sizeof all[i].range);
  return 1;
}

int irk_scene_open(const double* parameters, void** self, char* message) {
  Mass* mass = malloc(sizeof *mass);
  if (!mass) {
    strcpy(message, "no memory");
    return 1;
  }
  mass->m = parameters[0];
  mass->c = parameters[1];
  mass->b = parameters[2];
  *self = mass;
  return 0;
}
void irk_scene_close(void* self) { free(self); }

void irk_scene_size(void* self, irk_scene_sizes* n) {
  (void)self;
  n->nu = n->discrete = n->switches = n->outputs = 1;
  n->concurrent = 1; /* nothing is kept in static variables */
}
void irk_scene_component(void* self, int i, char* name, char* unit, double* scale, double* rate_scale) {
  (void)self, (void)i;
  strcpy(name, "gap");
  strcpy(unit, "m");
  *scale = 0.01;
  *rate_scale = 1;
}
void irk_scene_start(void* self, double* t, double* y, double* w, double* d) {
  (void)self, (void)w, (void)d;
  t[1] = 0.5;
  y[0] = 0.01;
}

/* u'' = f(t, y). */
int irk_scene_rates(void* self, double t, const double* y, const double* d, double* f) {
  const Mass* mass = self;
  (void)t;
  f[0] = -g - (mass->c * y[0] + mass->b * y[1]) / mass->m * d[0];
  return 0;
}
/* df/dy, one row and two columns. */
int irk_scene_jacobian(void* self, double t, const double* y, const double* w, const double* d, double* J) {
  const Mass* mass = self;
  (void)t, (void)y, (void)w;
  J[0] = -mass->c / mass->m * d[0];
  J[1] = -mass->b / mass->m * d[0];
  return 0;
}

/* The mode is valid while this is <= 0. Contact ends at lift-off, flight at impact. */
int irk_scene_switching(void* self, double t, const double* y, const double* w, const double* d, double* g_out) {
  (void)self, (void)t, (void)w;
  g_out[0] = d[0] > 0.5 ? y[0] : -y[0];
  return 0;
}
void irk_scene_switch_name(void* self, int i, char* name) {
  (void)self, (void)i;
  strcpy(name, "contact");
}
void irk_scene_on_switch(void* self, int i, double t, const double* y, const double* w, double* d) {
  (void)self, (void)i, (void)t, (void)y, (void)w;
  d[0] = 1 - d[0];
}

void irk_scene_output(void* self, int i, char* name, char* unit, int* invariant) {
  (void)self, (void)i, (void)invariant;
  strcpy(name, "energy");
  strcpy(unit, "J");
}
void irk_scene_outputs(void* self, double t, const double* y, const double* w, const double* d, double* values) {
  const Mass* mass = self;
  (void)t, (void)w;
  values[0] = mass->m * (y[1] * y[1] / 2 + g * y[0]) + mass->c * y[0] * y[0] / 2 * d[0];
}
