/* A small model that fmu.c makes an FMU of, for tests. Written for them. */
#ifndef IRK_TEST_FMU_MODEL_H
#define IRK_TEST_FMU_MODEL_H

#include <stdbool.h>

enum { kMaxVariables = 32 };

/* kVelocity: the derivative of `of` and a state itself, with one value reference for both. */
typedef enum { kParameter, kInput, kState, kDerivative, kVelocity, kOutput } Kind;

typedef struct {
  const char* name;
  Kind kind;
  double start;
  const char* unit;
  int of; /* of a derivative and a velocity: the number of the state */
} Variable;

/* Values by the number of the variable, which is its value reference; and what the model remembers. */
typedef struct {
  double time;
  double v[kMaxVariables];
  double next_time; /* of the next event; below 0: none */
  int mode[4];
  bool jumped; /* set by `event`: states have changed */
  bool ends;   /* set by `event` */
} Model;

extern const char* const kModelName;
extern const Variable kVariables[];
extern const int kVariableCount, kIndicators;
extern const double kStopTime;

void start(Model*);       /* after the start values are set */
void derivatives(Model*); /* also outputs */
void indicators(const Model*, double* z);
void event(Model*); /* in event mode: may change states, mode and next_time */

/* Null where a model has none. */
bool completed(Model*) __attribute__((weak)); /* at the end of a step: whether it asks for an event; may set `ends` */

#endif
