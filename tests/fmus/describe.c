/* Prints the modelDescription.xml of a model: describe VERSION. */
#include <stdio.h>
#include <stdlib.h>

#include "tests/fmus/model.h"

static const char* causality(Kind kind) {
  return kind == kParameter ? "parameter" : kind == kInput ? "input" : kind == kOutput ? "output" : "local";
}

/* Variables of the XML are numbered from 1 on; the value reference of variable i is i. A velocity is one variable: the
 * derivative of its state, and a state. */
static void variable(int version, int i) {
  const Variable* const v = &kVariables[i];
  const Array* const array = arrayOf(i);
  if (v->kind == kSize) {
    printf("    <UInt64 name=\"%s\" valueReference=\"%d\" causality=\"structuralParameter\" variability=\"fixed\" "
           "start=\"%g\"/>\n", v->name, i, v->start);
    return;
  }
  const int has_start = v->kind != kDerivative && v->kind != kOutput;
  const int differentiates = v->kind == kDerivative || v->kind == kVelocity;
  const char* const variability = v->kind == kParameter ? "fixed" : "continuous";
  printf("    <%s name=\"%s\" valueReference=\"%d\" causality=\"%s\" variability=\"%s\"%s%s",
         version == 2 ? "ScalarVariable" : "Float64", v->name, i, causality(v->kind), variability,
         has_start && v->kind != kInput ? " initial=\"exact\"" : "", version == 2 ? "><Real" : "");
  if (v->unit[0]) printf(" unit=\"%s\"", v->unit);
  if (has_start && array && array->starts) {
    printf(" start=\"%s\"", array->starts);
  } else if (has_start) {
    printf(" start=\"%.17g\"", v->start);
  }
  if (differentiates) printf(" derivative=\"%d\"", version == 2 ? v->of + 1 : v->of);
  if (!array) {
    printf(version == 2 ? "/></ScalarVariable>\n" : "/>\n");
    return;
  }
  printf("><Dimension ");
  if (array->rows_of >= 0) {
    printf("valueReference=\"%d\"/>", array->rows_of);
  } else {
    printf("start=\"%d\"/>", array->rows);
  }
  if (array->columns) printf("<Dimension start=\"%d\"/>", array->columns);
  printf("</Float64>\n");
}

static void structure(int version) {
  printf("  <ModelStructure>\n%s", version == 2 ? "    <Derivatives>\n" : "");
  for (int state = 0; state < kVariableCount; ++state) {
    if (kVariables[state].kind != kState && kVariables[state].kind != kVelocity) continue;
    for (int i = 0; i < kVariableCount; ++i) {
      const Kind kind = kVariables[i].kind;
      if ((kind != kDerivative && kind != kVelocity) || kVariables[i].of != state) continue;
      if (version == 2) printf("      <Unknown index=\"%d\"/>\n", i + 1);
      if (version == 3) printf("    <ContinuousStateDerivative valueReference=\"%d\"/>\n", i);
    }
  }
  if (version == 2) printf("    </Derivatives>\n");
  for (int i = 0; version == 3 && i < kIndicators; ++i) printf("    <EventIndicator valueReference=\"%d\"/>\n", 1000 + i);
  printf("  </ModelStructure>\n");
}

int main(int count, char** arguments) {
  const int version = count > 1 ? atoi(arguments[1]) : 2;
  printf("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"%d.0\" modelName=\"%s\" ", version,
         kModelName);
  if (version == 2) {
    printf("guid=\"{test}\" numberOfEventIndicators=\"%d\">\n", kIndicators);
    printf("  <ModelExchange modelIdentifier=\"%s\" completedIntegratorStepNotNeeded=\"%s\" canGetAndSetFMUstate=\"true\"/>\n",
           kModelName, completed ? "false" : "true");
  } else {
    printf("instantiationToken=\"{test}\">\n  <ModelExchange modelIdentifier=\"%s\" needsCompletedIntegratorStep=\"%s\" "
           "providesDirectionalDerivatives=\"%s\"/>\n", kModelName, completed ? "true" : "false", product ? "true" : "false");
  }
  printf("  <DefaultExperiment startTime=\"0\" stopTime=\"%.17g\" tolerance=\"1e-6\"/>\n  <ModelVariables>\n", kStopTime);
  for (int i = 0; i < kVariableCount; ++i) variable(version, i);
  for (int i = 0; version == 3 && i < kIndicators; ++i) {
    printf("    <Float64 name=\"indicator%d\" valueReference=\"%d\" causality=\"local\" variability=\"continuous\"/>\n", i,
           1000 + i);
  }
  printf("  </ModelVariables>\n");
  structure(version);
  printf("</fmiModelDescription>\n");
  return 0;
}
