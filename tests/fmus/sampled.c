/* A motor with a sampled controller: every 0.1 s the controller reads the angle and holds its torque. The simulation
 * ends when the angle reaches `limit`. */
#include <math.h>

#include "tests/fmus/model.h"

const char* const kModelName = "fmu_sampled";
enum { kPhi, kOmega, kOmegaRate, kGain, kDamping, kTarget, kLimit, kTorque };
const Variable kVariables[] = {{"phi", kState, 0, "rad", 0},       {"omega", kVelocity, 0, "rad/s", kPhi},
                               {"der(omega)", kDerivative, 0, "rad/s2", kOmega}, {"k", kParameter, 4, "1/s2", 0},
                               {"b", kParameter, 2, "1/s", 0},     {"target", kInput, 1, "rad", 0},
                               {"limit", kParameter, 100, "rad", 0}, {"torque", kOutput, 0, "1/s2", 0}};
const int kVariableCount = 8, kIndicators = 1;
const double kStopTime = 3;
static const double kPeriod = 0.1;

/* mode[0] counts the samples. */
static void sample(Model* m) {
  m->v[kTorque] = m->v[kGain] * (m->v[kTarget] - m->v[kPhi]);
  m->next_time = ++m->mode[0] * kPeriod;
}
void start(Model* m) { sample(m); }
void derivatives(Model* m) { m->v[kOmegaRate] = m->v[kTorque] - m->v[kDamping] * m->v[kOmega]; }
void indicators(const Model* m, double* z) { z[0] = m->v[kLimit] - m->v[kPhi]; }
void event(Model* m) {
  if (m->time >= m->next_time) sample(m);
  m->ends = m->v[kPhi] > m->v[kLimit];
}
