/* FMI 2, co-simulation, around models.h: the functions that a simple importer calls. */
#include "fmi2FunctionTypes.h"
#include "models.h"

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token, fmi2String place,
                              const fmi2CallbackFunctions *calls, fmi2Boolean visible, fmi2Boolean logging) {
    return make(token);
}
void fmi2FreeInstance(fmi2Component m) { free(m); }
fmi2Status fmi2SetDebugLogging(fmi2Component m, fmi2Boolean on, size_t n, const fmi2String what[]) { return fmi2OK; }
fmi2Status fmi2SetupExperiment(fmi2Component m, fmi2Boolean a, fmi2Real b, fmi2Real c, fmi2Boolean d, fmi2Real e) {
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component m) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component m) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component m) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component m) { return fmi2Error; }

#define PASS(Name, type, field)                                                                                     \
    fmi2Status fmi2Get##Name(fmi2Component c, const fmi2ValueReference r[], size_t n, type v[]) {                   \
        follow(c);                                                                                                  \
        for (size_t k = 0; k < n; k++) v[k] = (type)((Model *)c)->field[r[k]];                                      \
        return fmi2OK;                                                                                              \
    }                                                                                                               \
    fmi2Status fmi2Set##Name(fmi2Component c, const fmi2ValueReference r[], size_t n, const type v[]) {             \
        for (size_t k = 0; k < n; k++) ((Model *)c)->field[r[k]] = v[k];                                            \
        return fmi2OK;                                                                                              \
    }
PASS(Real, fmi2Real, number)
PASS(Integer, fmi2Integer, whole)
PASS(Boolean, fmi2Boolean, truth)
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2String v[]) {
    for (size_t k = 0; k < n; k++) v[k] = ((Model *)c)->text;
    return fmi2OK;
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2String v[]) {
    for (size_t k = 0; k < n; k++) strncpy(((Model *)c)->text, v[k], TEXT - 1);
    return fmi2OK;
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real step, fmi2Boolean final) {
    return !strcmp(((Model *)c)->kind, "ends") && t >= 0.045 ? fmi2Discard : run(c, t, step);
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind what, fmi2Boolean *v) {
    *v = what == fmi2Terminated && strcmp(((Model *)c)->kind, "choosy");
    return fmi2OK;
}
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind what, fmi2Real *v) {
    *v = ((Model *)c)->reached;
    return what == fmi2LastSuccessfulTime && *v > 0 ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *s) {
    *s = malloc(sizeof(Model));
    memcpy(*s, c, sizeof(Model));
    return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s) { memcpy(c, s, sizeof(Model)); return fmi2OK; }
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *s) { free(*s); *s = 0; return fmi2OK; }

/* Never called, and demanded by FMPy. */
#define NOT(name) int name(void) { return 3; }
NOT(fmi2SerializedFMUstateSize) NOT(fmi2SerializeFMUstate) NOT(fmi2DeSerializeFMUstate)
NOT(fmi2GetDirectionalDerivative) NOT(fmi2EnterEventMode) NOT(fmi2NewDiscreteStates)
NOT(fmi2EnterContinuousTimeMode) NOT(fmi2CompletedIntegratorStep) NOT(fmi2SetTime) NOT(fmi2SetContinuousStates)
NOT(fmi2GetDerivatives) NOT(fmi2GetEventIndicators) NOT(fmi2GetContinuousStates)
NOT(fmi2GetNominalsOfContinuousStates) NOT(fmi2SetRealInputDerivatives) NOT(fmi2GetRealOutputDerivatives)
NOT(fmi2CancelStep) NOT(fmi2GetStatus) NOT(fmi2GetIntegerStatus)
NOT(fmi2GetStringStatus)
