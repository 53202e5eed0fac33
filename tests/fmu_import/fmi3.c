/* FMI 3, co-simulation, around models.h: the functions that a simple importer calls. */
#include "fmi3FunctionTypes.h"
#include "models.h"

const char *fmi3GetVersion(void) { return "3.0"; }
fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean events,
    fmi3Boolean early, const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    return events || early ? 0 : make(token);
}
void fmi3FreeInstance(fmi3Instance m) { free(m); }
fmi3Status fmi3EnterInitializationMode(fmi3Instance m, fmi3Boolean a, fmi3Float64 b, fmi3Float64 c, fmi3Boolean d,
                                       fmi3Float64 e) {
    return fmi3OK;
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance m) { return fmi3OK; }
fmi3Status fmi3Terminate(fmi3Instance m) { return fmi3OK; }

#define PASS(Name, field)                                                                                           \
    fmi3Status fmi3Get##Name(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3##Name v[], size_t m) {    \
        follow(c);                                                                                                  \
        for (size_t k = 0; k < n; k++) v[k] = (fmi3##Name)((Model *)c)->field[r[k]];                                \
        return fmi3OK;                                                                                              \
    }                                                                                                               \
    fmi3Status fmi3Set##Name(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3##Name v[],          \
                             size_t m) {                                                                            \
        for (size_t k = 0; k < n; k++) ((Model *)c)->field[r[k]] = v[k];                                            \
        return fmi3OK;                                                                                              \
    }
PASS(Float64, number)
PASS(Float32, number)
PASS(Int8, whole)
PASS(UInt8, whole)
PASS(Int16, whole)
PASS(UInt16, whole)
PASS(Int32, whole)
PASS(UInt32, whole)
PASS(Int64, whole)
PASS(UInt64, whole)
PASS(Boolean, truth)
fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3String v[], size_t m) {
    for (size_t k = 0; k < n; k++) strncpy(((Model *)c)->text, v[k], TEXT - 1);
    return fmi3OK;
}
fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 t, fmi3Float64 step, fmi3Boolean final, fmi3Boolean *event,
                      fmi3Boolean *end, fmi3Boolean *early, fmi3Float64 *reached) {
    *event = *early = 0;
    *reached = t + step;
    *end = !strcmp(((Model *)c)->kind, "ends") && t >= 0.045;
    return run(c, t, step);
}
fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *s) {
    *s = malloc(sizeof(Model));
    memcpy(*s, c, sizeof(Model));
    return fmi3OK;
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState s) { memcpy(c, s, sizeof(Model)); return fmi3OK; }
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *s) { free(*s); *s = 0; return fmi3OK; }

/* Never called, and demanded by FMPy. */
#define NOT(name) int name(void) { return 3; }
NOT(fmi3SetDebugLogging) NOT(fmi3InstantiateModelExchange) NOT(fmi3InstantiateScheduledExecution)
NOT(fmi3EnterEventMode) NOT(fmi3Reset) NOT(fmi3GetString) NOT(fmi3GetBinary) NOT(fmi3GetClock)
NOT(fmi3SetBinary) NOT(fmi3SetClock) NOT(fmi3GetNumberOfVariableDependencies) NOT(fmi3GetVariableDependencies)
NOT(fmi3SerializedFMUStateSize) NOT(fmi3SerializeFMUState) NOT(fmi3DeserializeFMUState)
NOT(fmi3GetDirectionalDerivative) NOT(fmi3GetAdjointDerivative) NOT(fmi3EnterConfigurationMode)
NOT(fmi3ExitConfigurationMode) NOT(fmi3GetIntervalDecimal) NOT(fmi3GetIntervalFraction) NOT(fmi3GetShiftDecimal)
NOT(fmi3GetShiftFraction) NOT(fmi3SetIntervalDecimal) NOT(fmi3SetIntervalFraction) NOT(fmi3SetShiftDecimal)
NOT(fmi3SetShiftFraction) NOT(fmi3EvaluateDiscreteStates) NOT(fmi3UpdateDiscreteStates)
NOT(fmi3EnterContinuousTimeMode) NOT(fmi3CompletedIntegratorStep) NOT(fmi3SetTime) NOT(fmi3SetContinuousStates)
NOT(fmi3GetContinuousStateDerivatives) NOT(fmi3GetEventIndicators) NOT(fmi3GetContinuousStates)
NOT(fmi3GetNominalsOfContinuousStates) NOT(fmi3GetNumberOfEventIndicators) NOT(fmi3GetNumberOfContinuousStates)
NOT(fmi3EnterStepMode) NOT(fmi3GetOutputDerivatives) NOT(fmi3ActivateModelPartition)
