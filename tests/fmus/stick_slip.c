/* A mass on a belt, held by a spring, with dry friction: it sticks until the spring pulls with more than the static
 * friction, and slips until its velocity is that of the belt again. */
#include <math.h>

#include "tests/fmus/model.h"

const char* const kModelName = "fmu_stick_slip";
enum { kX, kV, kVRate, kStiffness, kBelt, kStatic, kKinetic };
const Variable kVariables[] = {{"x", kState, 0, "m", 0},          {"v", kVelocity, 0.1, "m/s", kX},
                               {"der(v)", kDerivative, 0, "m/s2", kV}, {"c", kParameter, 10, "N/m", 0},
                               {"vb", kParameter, 0.1, "m/s", 0}, {"Fs", kParameter, 1, "N", 0},
                               {"Fk", kParameter, 0.6, "N", 0}};
const int kVariableCount = 7, kIndicators = 2;
const double kStopTime = 10;

/* mode[0]: 0 sticks, -1 is slower than the belt, 1 is faster. */
void start(Model* m) { (void)m; }
static double spring(const Model* m) { return m->v[kStiffness] * m->v[kX]; }
void derivatives(Model* m) {
  m->v[kVRate] = m->mode[0] == 0 ? 0 : -spring(m) - m->mode[0] * m->v[kKinetic];
}
void indicators(const Model* m, double* z) {
  z[0] = m->mode[0] == 0 ? m->v[kStatic] - fabs(spring(m)) : 1;
  z[1] = m->mode[0] == 0 ? 1 : -m->mode[0] * (m->v[kBelt] - m->v[kV]);
}
void event(Model* m) {
  if (m->mode[0] == 0 && fabs(spring(m)) >= m->v[kStatic]) {
    m->mode[0] = spring(m) > 0 ? -1 : 1;
  } else if (m->mode[0] != 0 && -m->mode[0] * (m->v[kBelt] - m->v[kV]) < 0) {
    m->mode[0] = 0;
    m->v[kV] = m->v[kBelt];
    m->jumped = true;
  }
}
