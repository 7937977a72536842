/* A decaying amount, x' = -x, with a dose of 1 at t = 1 and a doubling at t = 2, for tests. With IRK_DAMAGE it writes
 * behind the state. */
#include <irk/scene_c.h>
#include <stdlib.h>

int irk_scene_version(void) { return IRK_SCENE_VERSION; }
void irk_scene_size(void* self, irk_scene_sizes* sizes) {
  (void)self;
  sizes->nx = 1;
  sizes->times = 2;
}
void irk_scene_start(void* self, double* t, double* y, double* w, double* d) {
  (void)self, (void)w, (void)d;
  t[1] = 3;
  y[0] = 1;
}
int irk_scene_rates(void* self, double t, const double* y, const double* d, double* f) {
  (void)self, (void)t, (void)d;
  f[0] = -y[0];
  return 0;
}
void irk_scene_times(void* self, double* times) {
  (void)self;
  times[0] = 1;
  times[1] = 2;
}
void irk_scene_jump_at_time(void* self, int i, double t, double* y, const double* d) {
  (void)self, (void)d;
  if (i == 0 && t == 1) y[0] += 1;
  if (i == 1 && t == 2) y[0] *= 2;
  if (getenv("IRK_DAMAGE")) y[1] = 0;
}
