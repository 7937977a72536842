/* A ball that bounces on a rigid floor: at an impact v jumps to -e v. */
#include "tests/fmus/model.h"

const char* const kModelName = "fmu_ball";
enum { kHeight, kSpeed, kSpeedRate, kRestitution };
const Variable kVariables[] = {{"h", kState, 1, "m", 0},
                               {"v", kVelocity, 0, "m/s", kHeight},
                               {"der(v)", kDerivative, 0, "m/s2", kSpeed},
                               {"e", kParameter, 0.7, "", 0}};
const int kVariableCount = 4, kIndicators = 1;
const double kStopTime = 2;

void start(Model* m) { (void)m; }
void derivatives(Model* m) { m->v[kSpeedRate] = -9.81; }
void indicators(const Model* m, double* z) { z[0] = m->v[kHeight]; }
void event(Model* m) {
  if (m->v[kHeight] > 0 || m->v[kSpeed] >= 0) return;
  m->v[kHeight] = 0;
  m->v[kSpeed] *= -m->v[kRestitution];
  m->jumped = true;
}
