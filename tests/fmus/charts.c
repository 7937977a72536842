/* An angle phi with phi' = w, by the coordinate s = tan((phi - c pi) / 2) of the chart c: s' = w (1 + s^2) / 2. In one
 * chart s becomes infinite. At the end of a step with |s| > 1 the model asks for an event, which goes to the next
 * chart, s = -1 / s, and counts: the choice of states that tools leave to completedIntegratorStep. */
#include <math.h>

#include "tests/fmus/model.h"

const char* const kModelName = "fmu_charts";
enum { kS, kRate, kW, kLast, kChart, kSine };
const Variable kVariables[] = {{"s", kState, 0, "", 0},        {"der(s)", kDerivative, 0, "1/s", kS},
                               {"w", kParameter, 1, "1/s", 0}, {"last", kParameter, 100, "", 0},
                               {"chart", kOutput, 0, "", 0},   {"sine", kOutput, 0, "", 0}};
const int kVariableCount = 6, kIndicators = 0;
const double kStopTime = 10;

/* mode[0]: the chart. After the chart `last` the simulation ends. */
void start(Model* m) { (void)m; }
void derivatives(Model* m) {
  const double s = m->v[kS], sign = m->mode[0] % 2 == 0 ? 1 : -1;
  m->v[kRate] = m->v[kW] * (1 + s * s) / 2;
  m->v[kChart] = m->mode[0];
  m->v[kSine] = sign * 2 * s / (1 + s * s);
}
void indicators(const Model* m, double* z) { (void)m, (void)z; }
bool completed(Model* m) {
  const bool asks = fabs(m->v[kS]) > 1;
  m->ends = asks && m->mode[0] >= m->v[kLast];
  return asks;
}
void event(Model* m) {
  if (fabs(m->v[kS]) <= 1) return;
  m->v[kS] = -1 / m->v[kS];
  ++m->mode[0];
  m->jumped = true;
}
