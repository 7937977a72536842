/* The part of the Functional Mock-up Interface, versions 2.0.4 and 3.0.1 (fmi-standard.org), that Model Exchange of
 * continuous systems needs, declared for this program. Types of functions end with TYPE, as the standard has them;
 * their names have fmi without a number where both versions agree. */
#ifndef IRK_FMI_H
#define IRK_FMI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Names of the standard: NOLINTBEGIN(readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

typedef void* fmiInstance;
typedef unsigned int fmiReference; /* fmi2ValueReference, fmi3ValueReference */
/* fmi2Status, fmi3Status; 5, pending, is of co-simulation only. */
typedef enum { fmiOK = 0, fmiWarning = 1, fmiDiscard = 2, fmiError = 3, fmiFatal = 4 } fmiStatus;

/* --- Version 2.0. Booleans are int. */

typedef struct {
  void (*logger)(void* environment, const char* instance, fmiStatus status, const char* category, const char* message,
                 ...);
  void* (*allocateMemory)(size_t count, size_t size);
  void (*freeMemory)(void* memory);
  void (*stepFinished)(void* environment, fmiStatus status);
  void* environment;
} fmi2CallbackFunctions;

typedef struct {
  int newDiscreteStatesNeeded;
  int terminateSimulation;
  int nominalsOfContinuousStatesChanged;
  int valuesOfContinuousStatesChanged;
  int nextEventTimeDefined;
  double nextEventTime;
} fmi2EventInfo;

typedef fmiInstance fmi2InstantiateTYPE(const char* instance, int kind /* 0: Model Exchange */, const char* guid,
                                        const char* resources, const fmi2CallbackFunctions* callbacks, int visible,
                                        int logging);
typedef fmiStatus fmi2SetupExperimentTYPE(fmiInstance, int has_tolerance, double tolerance, double start, int has_stop,
                                          double stop);
typedef fmiStatus fmi2EnterInitializationModeTYPE(fmiInstance);
typedef fmiStatus fmi2NewDiscreteStatesTYPE(fmiInstance, fmi2EventInfo*);
typedef fmiStatus fmi2CompletedIntegratorStepTYPE(fmiInstance, int no_former_state, int* enter_event_mode,
                                                  int* terminate);
typedef fmiStatus fmi2GetRealTYPE(fmiInstance, const fmiReference*, size_t, double*);
typedef fmiStatus fmi2SetRealTYPE(fmiInstance, const fmiReference*, size_t, const double*);
typedef fmiStatus fmi2SetIntegerTYPE(fmiInstance, const fmiReference*, size_t, const int*);
typedef fmiStatus fmi2SetBooleanTYPE(fmiInstance, const fmiReference*, size_t, const int*);
typedef fmiStatus fmi2GetDirectionalDerivativeTYPE(fmiInstance, const fmiReference* unknowns, size_t,
                                                   const fmiReference* knowns, size_t, const double* seed,
                                                   double* derivative);

/* --- The same functions in both versions: fmi2SetTime and fmi3SetTime, ... */

typedef void fmiFreeInstanceTYPE(fmiInstance);
typedef fmiStatus fmiExitInitializationModeTYPE(fmiInstance);
typedef fmiStatus fmiEnterEventModeTYPE(fmiInstance);
typedef fmiStatus fmiEnterContinuousTimeModeTYPE(fmiInstance);
typedef fmiStatus fmiSetTimeTYPE(fmiInstance, double);
typedef fmiStatus fmiSetContinuousStatesTYPE(fmiInstance, const double*, size_t);
typedef fmiStatus fmiGetContinuousStatesTYPE(fmiInstance, double*, size_t);
typedef fmiStatus fmiGetEventIndicatorsTYPE(fmiInstance, double*, size_t);
typedef fmiStatus fmiGetDerivativesTYPE(fmiInstance, double*, size_t); /* fmi3GetContinuousStateDerivatives */

/* fmi2GetFMUstate, fmi3GetFMUState, ... */
typedef fmiStatus fmiGetFMUStateTYPE(fmiInstance, void** state);
typedef fmiStatus fmiSetFMUStateTYPE(fmiInstance, void* state);
typedef fmiStatus fmiFreeFMUStateTYPE(fmiInstance, void** state);

/* --- Version 3.0. */

typedef void fmi3LogMessageCallback(void* environment, fmiStatus status, const char* category, const char* message);
typedef fmiInstance fmi3InstantiateModelExchangeTYPE(const char* instance, const char* token, const char* resources,
                                                     bool visible, bool logging, void* environment,
                                                     fmi3LogMessageCallback*);
typedef fmiStatus fmi3EnterInitializationModeTYPE(fmiInstance, bool has_tolerance, double tolerance, double start,
                                                  bool has_stop, double stop);
typedef fmiStatus fmi3UpdateDiscreteStatesTYPE(fmiInstance, bool* again, bool* terminate, bool* nominals_changed,
                                               bool* states_changed, bool* has_next_time, double* next_time);
typedef fmiStatus fmi3CompletedIntegratorStepTYPE(fmiInstance, bool no_former_state, bool* enter_event_mode,
                                                  bool* terminate);
typedef fmiStatus fmi3GetFloat64TYPE(fmiInstance, const fmiReference*, size_t, double*, size_t);
typedef fmiStatus fmi3SetFloat64TYPE(fmiInstance, const fmiReference*, size_t, const double*, size_t);
typedef fmiStatus fmi3SetInt32TYPE(fmiInstance, const fmiReference*, size_t, const int32_t*, size_t);
typedef fmiStatus fmi3SetBooleanTYPE(fmiInstance, const fmiReference*, size_t, const bool*, size_t);
typedef fmiStatus fmi3GetDirectionalDerivativeTYPE(fmiInstance, const fmiReference* unknowns, size_t,
                                                   const fmiReference* knowns, size_t, const double* seed, size_t,
                                                   double* derivative, size_t);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
