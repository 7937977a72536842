/* A pendulum by its angle: phi'' = -(g / l) sin(phi) - b phi'. der(phi) is the state omega. */
#include <math.h>

#include "tests/fmus/model.h"

const char* const kModelName = "fmu_pendulum";
enum { kPhi, kOmega, kOmegaRate, kLength, kDamping, kHeight };
const Variable kVariables[] = {{"phi", kState, 1, "rad", 0},         {"omega", kVelocity, 0, "rad/s", kPhi},
                               {"der(omega)", kDerivative, 0, "rad/s2", kOmega}, {"l", kParameter, 1, "m", 0},
                               {"b", kParameter, 0.1, "1/s", 0},     {"height", kOutput, 0, "m", 0}};
const int kVariableCount = 6, kIndicators = 0;
const double kStopTime = 5;

void start(Model* m) { (void)m; }
void derivatives(Model* m) {
  m->v[kOmegaRate] = -9.81 / m->v[kLength] * sin(m->v[kPhi]) - m->v[kDamping] * m->v[kOmega];
  m->v[kHeight] = -m->v[kLength] * cos(m->v[kPhi]);
}
void indicators(const Model* m, double* z) { (void)m, (void)z; }
void event(Model* m) { (void)m; }
