/* A stiff direct-current motor with ten states: current (a millisecond), speed and angle, and a shaft of three disks
 * whose brake engages and releases at two speeds (hysteresis). */
#include "tests/fmus/model.h"

const char* const kModelName = "fmu_motor";
enum { kAngle, kSpeed = kAngle + 4, kSpeedRate = kSpeed + 4, kCurrent = kSpeedRate + 4, kHeat, kCurrentRate, kHeatRate,
       kVoltage };
const Variable kVariables[] = {{"phi1", kState, 0, "rad", 0},
                               {"phi2", kState, 0, "rad", 0},
                               {"phi3", kState, 0, "rad", 0},
                               {"phi4", kState, 0, "rad", 0},
                               {"w1", kVelocity, 0, "rad/s", kAngle},
                               {"w2", kVelocity, 0, "rad/s", kAngle + 1},
                               {"w3", kVelocity, 0, "rad/s", kAngle + 2},
                               {"w4", kVelocity, 0, "rad/s", kAngle + 3},
                               {"der(w1)", kDerivative, 0, "rad/s2", kSpeed},
                               {"der(w2)", kDerivative, 0, "rad/s2", kSpeed + 1},
                               {"der(w3)", kDerivative, 0, "rad/s2", kSpeed + 2},
                               {"der(w4)", kDerivative, 0, "rad/s2", kSpeed + 3},
                               {"current", kState, 0, "A", 0},
                               {"heat", kState, 0, "K", 0},
                               {"der(current)", kDerivative, 0, "A/s", kCurrent},
                               {"der(heat)", kDerivative, 0, "K/s", kHeat},
                               {"voltage", kInput, 24, "V", 0}};
const int kVariableCount = 17, kIndicators = 1;
const double kStopTime = 2;
static const double kOn = 60, kOff = 40; /* rad/s: the brake of the last disk */

/* mode[0]: 1 while it brakes. */
void start(Model* m) { (void)m; }
void derivatives(Model* m) {
  const double stiffness = 2000, damping = 0.2, inertia = 0.01;
  double* const v = m->v;
  v[kCurrentRate] = (v[kVoltage] - 0.5 * v[kCurrent] - 0.3 * v[kSpeed]) / 1e-4;
  v[kHeatRate] = 0.5 * v[kCurrent] * v[kCurrent] / 100 - 0.1 * v[kHeat];
  double torque = 0.3 * v[kCurrent];
  for (int i = 0; i < 4; ++i) {
    double shaft = m->mode[0] * 8.0 + 0.01 * v[kSpeed + 3];
    if (i < 3) shaft = stiffness * (v[kAngle + i] - v[kAngle + i + 1]) + damping * (v[kSpeed + i] - v[kSpeed + i + 1]);
    v[kSpeedRate + i] = (torque - shaft) / inertia;
    torque = shaft;
  }
}
void indicators(const Model* m, double* z) {
  z[0] = m->mode[0] ? m->v[kSpeed + 3] - kOff : kOn - m->v[kSpeed + 3];
}
void event(Model* m) {
  if (!m->mode[0] && m->v[kSpeed + 3] > kOn) {
    m->mode[0] = 1;
  } else if (m->mode[0] && m->v[kSpeed + 3] < kOff) {
    m->mode[0] = 0;
  }
}
