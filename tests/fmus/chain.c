/* Three masses between two walls, with four equal springs: arrays of version 3. */
#include "tests/fmus/model.h"

const char* const kModelName = "fmu_chain";
/* Places of the numbers; the variables have the numbers 0, 1, 2, ... */
enum { kSizeOf, kU, kV = kU + 3, kRateOfV = kV + 3, kMass = kRateOfV + 3, kForce = kMass + 3, kStretch = kForce + 3,
       kStiffness = kStretch + 4 };
const Variable kVariables[] = {{"n", kSize, 3, "", 0},         {"u", kState, 0, "m", 0},
                               {"v", kVelocity, 0, "m/s", 1},  {"der(v)", kDerivative, 0, "m/s2", 2},
                               {"m", kParameter, 1, "kg", 0},  {"f", kInput, 0, "N", 0},
                               {"stretch", kOutput, 0, "m", 0}, {"c", kParameter, 2, "N/m", 0}};
const Array kArrays[] = {{1, 3, 0, "1 0 -1", 0}, {2, 3, 0, 0, 0}, {3, 3, 0, 0, 0}, {4, 3, 0, 0, -1},
                         {5, 3, 0, 0, 0},        {6, 2, 2, 0, -1}, {0, 0, 0, 0, 0}};
const int kVariableCount = 8, kIndicators = 0;
const double kStopTime = 3;

void start(Model* m) { (void)m; }
static double forceOf(const double* u, int i) { return (i > 0 ? u[i - 1] : 0) - 2 * u[i] + (i < 2 ? u[i + 1] : 0); }
void derivatives(Model* m) {
  double* const v = m->v;
  for (int i = 0; i < 3; ++i) v[kRateOfV + i] = (v[kStiffness] * forceOf(v + kU, i) + v[kForce + i]) / v[kMass + i];
  for (int i = 0; i < 4; ++i) v[kStretch + i] = (i < 3 ? v[kU + i] : 0) - (i > 0 ? v[kU + i - 1] : 0);
}
void product(const Model* m, const double* seed, double* to) {
  for (int i = 0; i < 3; ++i) {
    to[i] = seed[3 + i];
    to[3 + i] = m->v[kStiffness] * forceOf(seed, i) / m->v[kMass + i];
  }
}
void indicators(const Model* m, double* z) { (void)m, (void)z; }
void event(Model* m) { (void)m; }
