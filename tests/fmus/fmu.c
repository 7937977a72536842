/* The functions of the standard for a model (model.h), of the version FMI (2 or 3). IRK_DAMAGE: a fault. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/own/fmu/fmi.h"
#include "tests/fmus/model.h"

#define EXPORT __attribute__((visibility("default")))

typedef struct {
  Model model;
#if FMI == 2
  const fmi2CallbackFunctions* callbacks;
#else
  fmi3LogMessageCallback* log;
  void* environment;
#endif
} Instance;

static int damaged(const char* by) {
  const char* const damage = getenv("IRK_DAMAGE");
  return damage && strcmp(damage, by) == 0;
}
static void say(Instance* instance, const char* text) {
#if FMI == 2
  instance->callbacks->logger(instance->callbacks->environment, "test", fmiError, "error", "%s", text);
#else
  instance->log(instance->environment, fmiError, "error", text);
#endif
}

static int isState(int i) { return kVariables[i].kind == kState || kVariables[i].kind == kVelocity; }
/* The number of the derivative of state `state`. */
static int derivativeOf(int state) {
  for (int i = 0; i < kVariableCount; ++i) {
    const Kind kind = kVariables[i].kind;
    if ((kind == kDerivative || kind == kVelocity) && kVariables[i].of == state) return i;
  }
  return -1;
}

static int sizeOf(int i) {
  const Array* const array = arrayOf(i);
  return !array ? 1 : array->columns == 0 ? array->rows : array->rows * array->columns;
}
/* The place of a variable's first number. */
static int placeOf(int i) {
  int place = 0;
  for (int k = 0; k < i; ++k) place += sizeOf(k);
  return place;
}

static Instance* make(void) {
  Instance* instance = calloc(1, sizeof(Instance));
  for (int i = 0; i < kVariableCount; ++i) {
    const Array* const array = arrayOf(i);
    char* next = array ? (char*)array->starts : NULL;
    for (int j = 0; j < sizeOf(i); ++j) {
      instance->model.v[placeOf(i) + j] = next ? strtod(next, &next) : kVariables[i].start;
    }
  }
  instance->model.next_time = -1;
  return instance;
}
static fmiStatus initialize(Instance* instance) {
  if (damaged("initialize")) {
    say(instance, "the table of friction is empty");
    return fmiError;
  }
  start(&instance->model);
  return fmiOK;
}
/* One pass of event mode. */
static void pass(Instance* instance) {
  Model* const model = &instance->model;
  model->jumped = false;
  event(model);
  if (damaged("time") && model->mode[0] > 0) model->next_time = 7;
}

#define NAME2(version, name) fmi##version##name
#define NAME1(version, name) NAME2(version, name)
#define NAME(name) NAME1(FMI, name)

EXPORT fmiStatus NAME(SetTime)(fmiInstance c, double t) {
  ((Instance*)c)->model.time = t;
  return fmiOK;
}
EXPORT fmiStatus NAME(SetContinuousStates)(fmiInstance c, const double* x, size_t n) {
  size_t k = 0;
  for (int i = 0; i < kVariableCount && k < n; ++i) {
    for (int j = 0; isState(i) && j < sizeOf(i); ++j) ((Instance*)c)->model.v[placeOf(i) + j] = x[k++];
  }
  return fmiOK;
}
EXPORT fmiStatus NAME(GetContinuousStates)(fmiInstance c, double* x, size_t n) {
  size_t k = 0;
  for (int i = 0; i < kVariableCount && k < n; ++i) {
    for (int j = 0; isState(i) && j < sizeOf(i); ++j) x[k++] = ((Instance*)c)->model.v[placeOf(i) + j];
  }
  return fmiOK;
}
EXPORT fmiStatus NAME(GetNominalsOfContinuousStates)(fmiInstance c, double* x, size_t n) {
  (void)c;
  for (size_t k = 0; k < n; ++k) x[k] = 1;
  return fmiOK;
}
static fmiStatus getDerivatives(fmiInstance c, double* dx, size_t n) {
  Model* const model = &((Instance*)c)->model;
  size_t k = 0;
  derivatives(model);
  for (int i = 0; i < kVariableCount && k < n; ++i) {
    for (int j = 0; isState(i) && j < sizeOf(i); ++j) dx[k++] = model->v[placeOf(derivativeOf(i)) + j];
  }
  if (damaged("not finite")) dx[n - 1] = NAN;
  return damaged("discards") && model->time > 0.1 ? fmiDiscard : fmiOK;
}
EXPORT fmiStatus NAME(GetEventIndicators)(fmiInstance c, double* z, size_t n) {
  (void)n;
  derivatives(&((Instance*)c)->model);
  indicators(&((Instance*)c)->model, z);
  return fmiOK;
}
/* The numbers of n variables: an error unless there are `count`. */
static fmiStatus requireCount(const fmiReference* r, size_t n, size_t count) {
  size_t numbers = 0;
  for (size_t k = 0; k < n; ++k) numbers += (size_t)sizeOf((int)r[k]);
  return numbers == count ? fmiOK : fmiError;
}
static fmiStatus setReal(fmiInstance c, const fmiReference* r, size_t n, const double* values, size_t count) {
  for (size_t k = 0; k < n; ++k) {
    for (int j = 0; j < sizeOf((int)r[k]); ++j) ((Instance*)c)->model.v[placeOf((int)r[k]) + j] = *values++;
  }
  return requireCount(r, n, count);
}
static fmiStatus getReal(fmiInstance c, const fmiReference* r, size_t n, double* values, size_t count) {
  derivatives(&((Instance*)c)->model);
  for (size_t k = 0; k < n; ++k) {
    for (int j = 0; j < sizeOf((int)r[k]); ++j) *values++ = ((Instance*)c)->model.v[placeOf((int)r[k]) + j];
  }
  return requireCount(r, n, count);
}
/* What the end of a step asks for. */
static bool asks(fmiInstance c) { return completed && completed(&((Instance*)c)->model); }
EXPORT fmiStatus NAME(ExitInitializationMode)(fmiInstance c) { return (void)c, fmiOK; }
EXPORT fmiStatus NAME(EnterEventMode)(fmiInstance c) { return (void)c, fmiOK; }
#ifndef LACKS_A_FUNCTION
EXPORT fmiStatus NAME(EnterContinuousTimeMode)(fmiInstance c) { return (void)c, fmiOK; }
#endif

#if FMI == 2
/* Version 3 lives without. */
EXPORT fmiStatus fmi2GetFMUstate(fmiInstance c, void** state) {
  if (!*state) *state = malloc(sizeof(Model));
  memcpy(*state, &((Instance*)c)->model, sizeof(Model));
  return fmiOK;
}
EXPORT fmiStatus fmi2SetFMUstate(fmiInstance c, void* state) {
  memcpy(&((Instance*)c)->model, state, sizeof(Model));
  return fmiOK;
}
EXPORT fmiStatus fmi2FreeFMUstate(fmiInstance c, void** state) {
  (void)c;
  free(*state);
  *state = NULL;
  return fmiOK;
}
EXPORT fmiInstance fmi2Instantiate(const char* name, int kind, const char* guid, const char* resources,
                                   const fmi2CallbackFunctions* callbacks, int visible, int logging) {
  (void)name, (void)kind, (void)guid, (void)resources, (void)visible, (void)logging;
  if (damaged("instantiate")) return NULL;
  Instance* const instance = make();
  instance->callbacks = callbacks;
  return instance;
}
EXPORT void fmi2FreeInstance(fmiInstance c) { free(c); }
EXPORT fmiStatus fmi2SetupExperiment(fmiInstance c, int has_tolerance, double tolerance, double t, int has_stop,
                                     double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((Instance*)c)->model.time = t;
  return fmiOK;
}
EXPORT fmiStatus fmi2EnterInitializationMode(fmiInstance c) { return initialize(c); }
EXPORT fmiStatus fmi2NewDiscreteStates(fmiInstance c, fmi2EventInfo* info) {
  const Model* const model = &((Instance*)c)->model;
  pass(c);
  info->valuesOfContinuousStatesChanged = model->jumped;
  info->newDiscreteStatesNeeded = damaged("does not settle");
  info->terminateSimulation = model->ends;
  info->nextEventTimeDefined = model->next_time >= 0;
  info->nextEventTime = model->next_time;
  return fmiOK;
}
EXPORT fmiStatus fmi2CompletedIntegratorStep(fmiInstance c, int keep, int* enter, int* ends) {
  (void)keep;
  *enter = asks(c);
  *ends = ((Instance*)c)->model.ends;
  return damaged("step") ? fmiError : fmiOK;
}
EXPORT fmiStatus fmi2GetDerivatives(fmiInstance c, double* dx, size_t n) { return getDerivatives(c, dx, n); }
EXPORT fmiStatus fmi2SetReal(fmiInstance c, const fmiReference* r, size_t n, const double* values) {
  return setReal(c, r, n, values, n);
}
EXPORT fmiStatus fmi2GetReal(fmiInstance c, const fmiReference* r, size_t n, double* values) {
  return getReal(c, r, n, values, n);
}
#else
EXPORT fmiInstance fmi3InstantiateModelExchange(const char* name, const char* token, const char* resources,
                                                bool visible, bool logging, void* environment,
                                                fmi3LogMessageCallback* log) {
  (void)name, (void)token, (void)resources, (void)visible, (void)logging;
  if (damaged("instantiate")) return NULL;
  Instance* const instance = make();
  instance->log = log;
  instance->environment = environment;
  return instance;
}
EXPORT void fmi3FreeInstance(fmiInstance c) { free(c); }
EXPORT fmiStatus fmi3EnterInitializationMode(fmiInstance c, bool has_tolerance, double tolerance, double t,
                                             bool has_stop, double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((Instance*)c)->model.time = t;
  return initialize(c);
}
EXPORT fmiStatus fmi3UpdateDiscreteStates(fmiInstance c, bool* again, bool* ends, bool* nominals, bool* states,
                                          bool* has_next, double* next) {
  const Model* const model = &((Instance*)c)->model;
  pass(c);
  *again = damaged("does not settle");
  *ends = model->ends;
  *nominals = false;
  *states = model->jumped;
  *has_next = model->next_time >= 0;
  *next = model->next_time;
  return fmiOK;
}
EXPORT fmiStatus fmi3CompletedIntegratorStep(fmiInstance c, bool keep, bool* enter, bool* ends) {
  (void)keep;
  *enter = asks(c);
  *ends = ((Instance*)c)->model.ends;
  return damaged("step") ? fmiError : fmiOK;
}
EXPORT fmiStatus fmi3GetContinuousStateDerivatives(fmiInstance c, double* dx, size_t n) {
  return getDerivatives(c, dx, n);
}
EXPORT fmiStatus fmi3SetFloat64(fmiInstance c, const fmiReference* r, size_t n, const double* values, size_t count) {
  return setReal(c, r, n, values, count);
}
EXPORT fmiStatus fmi3GetFloat64(fmiInstance c, const fmiReference* r, size_t n, double* values, size_t count) {
  return getReal(c, r, n, values, count);
}
EXPORT fmiStatus fmi3GetDirectionalDerivative(fmiInstance c, const fmiReference* unknowns, size_t unknown_count,
                                              const fmiReference* knowns, size_t known_count, const double* seed,
                                              size_t seeds, double* derivative, size_t derivative_count) {
  if (requireCount(unknowns, unknown_count, derivative_count) != fmiOK) return fmiError;
  if (requireCount(knowns, known_count, seeds) != fmiOK) return fmiError;
  product(&((Instance*)c)->model, seed, derivative);
  return fmiOK;
}
#endif
