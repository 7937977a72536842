/* A small model that fmu.c makes an FMU of, for tests. Written for them. */
#ifndef IRK_TEST_FMU_MODEL_H
#define IRK_TEST_FMU_MODEL_H

#include <stdbool.h>

enum { kMaxNumbers = 32 };

/* kVelocity: the derivative of `of` and a state itself, with one value reference for both. kSize: a structural
 * parameter, the size of arrays. */
typedef enum { kParameter, kInput, kState, kDerivative, kVelocity, kOutput, kSize } Kind;

typedef struct {
  const char* name;
  Kind kind;
  double start;
  const char* unit;
  int of; /* of a derivative and a velocity: the number of the state */
} Variable;

/* A variable that is an array (version 3). Without `starts` the variable's start is that of each element. */
typedef struct {
  int variable, rows, columns; /* columns: 0 of a vector */
  const char* starts;
  int rows_of; /* the number of the variable that is the number of rows, or -1 */
} Array;

/* Numbers in the order of the variables, whose numbers are their value references; and what the model remembers. An
 * array takes as many places as it has elements, another variable one. */
typedef struct {
  double time;
  double v[kMaxNumbers];
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
extern const Array kArrays[] __attribute__((weak)); /* the last one has no rows */
bool completed(Model*) __attribute__((weak)); /* at the end of a step: whether it asks for an event; may set `ends` */
/* The Jacobian times `seed`. */
void product(const Model*, const double* seed, double* derivatives) __attribute__((weak));

static inline const Array* arrayOf(int variable) {
  for (const Array* array = kArrays; array && array->rows > 0; ++array) {
    if (array->variable == variable) return array;
  }
  return 0;
}

#endif
