/* FMI 3.0 for co-simulation, by declarations of our own; the rest is in wrapper.c. */
#include "offered.h"
#include "wrapper.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

typedef void *Component;
typedef uint32_t Reference;
typedef enum { OK, WARNING, DISCARD, ERROR, FATAL } Status;
typedef void (*LogMessage)(void *environment, Status status, const char *category, const char *text);

#define ALIVE (1u << MADE | 1u << INITIALISING | 1u << STEPPING | 1u << IN_EVENT | 1u << TERMINATED)
#define SETTABLE (1u << MADE | 1u << INITIALISING | 1u << STEPPING | 1u << IN_EVENT)
#define EXPECT(stages) if (expect(c, __func__, stages) != SAID_OK) return ERROR

static void tell(Instance *instance, enum Said said, const char *category, const char *text) {
    LogMessage log = (LogMessage)instance->callback;
    if (log != NULL && (instance->logging || said >= SAID_ERROR)) log(instance->environment, (Status)said, category, text);
}

OFFERED const char *fmi3GetVersion(void) { return "3.0"; }

OFFERED Status fmi3SetDebugLogging(Component c, bool on, size_t n, const char *const categories[]) {
    (void)n, (void)categories;
    EXPECT(ALIVE);
    ((Instance *)c)->logging = on;
    return OK;
}

OFFERED Component fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                              bool logging, bool with_events, bool may_return_early,
                                              const Reference required[], size_t n_required, void *environment,
                                              LogMessage log, void *intermediate_update) {
    (void)resources, (void)visible, (void)required, (void)n_required, (void)intermediate_update;
    Instance *instance = instance_new(name, token, tell, environment, (void *)log, logging);
    if (instance != NULL) {
        instance->with_events = with_events;
        instance->early = with_events && may_return_early;
    }
    return instance;
}

/* Only co-simulation is offered. Arguments are those of the standard, and not looked at. */
OFFERED Component fmi3InstantiateModelExchange(void) { return NULL; }
OFFERED Component fmi3InstantiateScheduledExecution(void) { return NULL; }

OFFERED void fmi3FreeInstance(Component c) { instance_free(c); }

OFFERED Status fmi3EnterInitializationMode(Component c, bool has_tolerance, double tolerance, double start,
                                           bool has_stop, double stop) {
    (void)has_tolerance, (void)tolerance;
    EXPECT(1u << MADE);
    enum Said said = set_up(c, start, has_stop ? stop : INFINITY);
    if (said == SAID_OK) ((Instance *)c)->stage = INITIALISING;
    return (Status)said;
}

OFFERED Status fmi3ExitInitializationMode(Component c) {
    EXPECT(1u << INITIALISING);
    return (Status)initialised(c, ((Instance *)c)->with_events ? IN_EVENT : STEPPING);
}

OFFERED Status fmi3EnterEventMode(Component c) {
    EXPECT(1u << STEPPING);
    ((Instance *)c)->stage = IN_EVENT;
    return OK;
}

OFFERED Status fmi3UpdateDiscreteStates(Component c, bool *again, bool *terminate, bool *nominals, bool *values,
                                        bool *has_next, double *next) {
    EXPECT(1u << IN_EVENT);
    *again = *terminate = *nominals = *values = *has_next = false;
    *next = 0.0;
    return (Status)settle(c);
}

OFFERED Status fmi3EnterStepMode(Component c) {
    EXPECT(1u << IN_EVENT);
    ((Instance *)c)->stage = STEPPING;
    return OK;
}

OFFERED Status fmi3Terminate(Component c) {
    EXPECT(1u << STEPPING | 1u << IN_EVENT);
    ((Instance *)c)->stage = TERMINATED;
    return OK;
}

OFFERED Status fmi3Reset(Component c) {
    EXPECT(ALIVE);
    return (Status)instance_reset(c);
}

OFFERED Status fmi3DoStep(Component c, double now, double step, bool no_way_back, bool *events, bool *terminate,
                          bool *early, double *reached) {
    int changed = 0;
    (void)no_way_back;
    EXPECT(1u << STEPPING);
    Instance *instance = c;
    enum Said said = do_step(instance, now, step, &changed);
    *reached = run_time(instance->run);
    *events = instance->with_events && changed;
    *early = said == SAID_OK && *reached < now + step && changed;
    *terminate = false;
    return (Status)said;
}

OFFERED Status fmi3GetFloat64(Component c, const Reference references[], size_t n, double values[], size_t n_values) {
    EXPECT(ALIVE);
    return (Status)get_reals(c, references, n, values, n_values);
}

OFFERED Status fmi3SetFloat64(Component c, const Reference references[], size_t n, const double values[],
                              size_t n_values) {
    EXPECT(SETTABLE);
    return (Status)set_reals(c, references, n, values, n_values);
}

OFFERED Status fmi3GetFMUState(Component c, void **state) {
    EXPECT(ALIVE);
    return (Status)save_state(c, state);
}

OFFERED Status fmi3SetFMUState(Component c, void *state) {
    EXPECT(ALIVE);
    return (Status)restore_state(c, state);
}

OFFERED Status fmi3FreeFMUState(Component c, void **state) {
    (void)c;
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return OK;
}

OFFERED Status fmi3SerializedFMUStateSize(Component c, void *state, size_t *size) {
    EXPECT(ALIVE);
    if (state == NULL) return (Status)refuse(c, __func__, "there is no state.");
    *size = saved_size(state);
    return OK;
}

OFFERED Status fmi3SerializeFMUState(Component c, void *state, uint8_t bytes[], size_t size) {
    EXPECT(ALIVE);
    return (Status)write_state(c, state, bytes, size);
}

OFFERED Status fmi3DeserializeFMUState(Component c, const uint8_t bytes[], size_t size, void **state) {
    EXPECT(ALIVE);
    return (Status)read_state(c, bytes, size, state);
}

/* Variables are of the type Float64 only. Arguments behind the number of references are not looked at. */
#define NONE_OF(name)                                                                      \
    OFFERED Status fmi3Get##name(Component c, const Reference references[], size_t n) {    \
        (void)references;                                                                  \
        return n == 0 ? OK : (Status)not_offered(c, __func__);                             \
    }                                                                                      \
    OFFERED Status fmi3Set##name(Component c, const Reference references[], size_t n) {    \
        (void)references;                                                                  \
        return n == 0 ? OK : (Status)not_offered(c, __func__);                             \
    }
NONE_OF(Float32)
NONE_OF(Int8)
NONE_OF(UInt8)
NONE_OF(Int16)
NONE_OF(UInt16)
NONE_OF(Int32)
NONE_OF(UInt32)
NONE_OF(Int64)
NONE_OF(UInt64)
NONE_OF(Boolean)
NONE_OF(String)
NONE_OF(Binary)
NONE_OF(Clock)
NONE_OF(IntervalDecimal)
NONE_OF(IntervalFraction)
NONE_OF(ShiftDecimal)
NONE_OF(ShiftFraction)

/* What the description says is not offered. Arguments behind the instance are not looked at. */
#define NOT_OFFERED(name) \
    OFFERED Status fmi3##name(Component c) { return (Status)not_offered(c, __func__); }
NOT_OFFERED(GetNumberOfVariableDependencies)
NOT_OFFERED(GetVariableDependencies)
NOT_OFFERED(GetDirectionalDerivative)
NOT_OFFERED(GetAdjointDerivative)
NOT_OFFERED(EnterConfigurationMode)
NOT_OFFERED(ExitConfigurationMode)
NOT_OFFERED(EvaluateDiscreteStates)
NOT_OFFERED(EnterContinuousTimeMode)
NOT_OFFERED(CompletedIntegratorStep)
NOT_OFFERED(SetTime)
NOT_OFFERED(SetContinuousStates)
NOT_OFFERED(GetContinuousStateDerivatives)
NOT_OFFERED(GetEventIndicators)
NOT_OFFERED(GetContinuousStates)
NOT_OFFERED(GetNominalsOfContinuousStates)
NOT_OFFERED(GetNumberOfEventIndicators)
NOT_OFFERED(GetNumberOfContinuousStates)
NOT_OFFERED(GetOutputDerivatives)
NOT_OFFERED(ActivateModelPartition)
