/* FMI 2.0 for co-simulation, by declarations of our own; the rest is in wrapper.c. */
#include "offered.h"
#include "wrapper.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void *Component;
typedef unsigned Reference;
typedef int Boolean;
typedef enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING } Status;
typedef enum { MODEL_EXCHANGE, CO_SIMULATION } Type;
typedef enum { DO_STEP_STATUS, PENDING_STATUS, LAST_TIME, TERMINATED_STATUS } StatusKind;
typedef struct {
    void (*logger)(void *environment, const char *name, Status status, const char *category, const char *form, ...);
    void *(*allocate)(size_t count, size_t size);
    void (*release)(void *memory);
    void (*step_finished)(void *environment, Status status);
    void *environment;
} Callbacks;

#define BETWEEN (1u << STEPPING)
#define ALIVE (1u << MADE | 1u << INITIALISING | 1u << STEPPING | 1u << TERMINATED)
#define EXPECT(stages) if (expect(c, __func__, stages) != SAID_OK) return ERROR

static void tell(Instance *instance, enum Said said, const char *category, const char *text) {
    const Callbacks *callbacks = instance->callback;
    if (callbacks != NULL && callbacks->logger != NULL && (instance->logging || said >= SAID_ERROR))
        callbacks->logger(callbacks->environment, instance->name, (Status)said, category, "%s", text);
}

OFFERED const char *fmi2GetTypesPlatform(void) { return "default"; }
OFFERED const char *fmi2GetVersion(void) { return "2.0"; }

OFFERED Status fmi2SetDebugLogging(Component c, Boolean on, size_t n, const char *const categories[]) {
    (void)n, (void)categories;
    EXPECT(ALIVE);
    ((Instance *)c)->logging = on;
    return OK;
}

OFFERED Component fmi2Instantiate(const char *name, Type type, const char *guid, const char *resources,
                                  const Callbacks *callbacks, Boolean visible, Boolean logging) {
    (void)resources, (void)visible;
    if (type != CO_SIMULATION) return NULL;
    return instance_new(name, guid, tell, NULL, (void *)callbacks, logging);
}

OFFERED void fmi2FreeInstance(Component c) { instance_free(c); }

OFFERED Status fmi2SetupExperiment(Component c, Boolean has_tolerance, double tolerance, double start, Boolean has_stop,
                                   double stop) {
    (void)has_tolerance, (void)tolerance;
    EXPECT(1u << MADE);
    return (Status)set_up(c, start, has_stop ? stop : INFINITY);
}

OFFERED Status fmi2EnterInitializationMode(Component c) {
    EXPECT(1u << MADE);
    ((Instance *)c)->stage = INITIALISING;
    return OK;
}

OFFERED Status fmi2ExitInitializationMode(Component c) {
    EXPECT(1u << INITIALISING);
    return (Status)initialised(c, STEPPING);
}

OFFERED Status fmi2Terminate(Component c) {
    EXPECT(BETWEEN);
    ((Instance *)c)->stage = TERMINATED;
    return OK;
}

OFFERED Status fmi2Reset(Component c) {
    EXPECT(ALIVE);
    return (Status)instance_reset(c);
}

OFFERED Status fmi2GetReal(Component c, const Reference references[], size_t n, double values[]) {
    EXPECT(ALIVE);
    return (Status)get_reals(c, references, n, values, n);
}

OFFERED Status fmi2SetReal(Component c, const Reference references[], size_t n, const double values[]) {
    EXPECT(1u << MADE | 1u << INITIALISING | BETWEEN);
    return (Status)set_reals(c, references, n, values, n);
}

/* There are variables of this type only: none of any other. */
#define NONE_OF(type, name)                                                                            \
    OFFERED Status fmi2Get##name(Component c, const Reference references[], size_t n, type values[]) { \
        (void)references, (void)values;                                                                \
        return n == 0 ? OK : (Status)not_offered(c, __func__);                                         \
    }                                                                                                  \
    OFFERED Status fmi2Set##name(Component c, const Reference references[], size_t n, const type values[]) { \
        (void)references, (void)values;                                                                \
        return n == 0 ? OK : (Status)not_offered(c, __func__);                                         \
    }
typedef const char *String;
NONE_OF(int, Integer)
NONE_OF(Boolean, Boolean)
NONE_OF(String, String)

OFFERED Status fmi2GetFMUstate(Component c, void **state) {
    EXPECT(ALIVE);
    return (Status)save_state(c, state);
}

OFFERED Status fmi2SetFMUstate(Component c, void *state) {
    EXPECT(ALIVE);
    return (Status)restore_state(c, state);
}

OFFERED Status fmi2FreeFMUstate(Component c, void **state) {
    (void)c;
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return OK;
}

OFFERED Status fmi2SerializedFMUstateSize(Component c, void *state, size_t *size) {
    EXPECT(ALIVE);
    if (state == NULL) return (Status)refuse(c, __func__, "there is no state.");
    *size = saved_size(state);
    return OK;
}

OFFERED Status fmi2SerializeFMUstate(Component c, void *state, char bytes[], size_t size) {
    EXPECT(ALIVE);
    return (Status)write_state(c, state, (unsigned char *)bytes, size);
}

OFFERED Status fmi2DeSerializeFMUstate(Component c, const char bytes[], size_t size, void **state) {
    EXPECT(ALIVE);
    return (Status)read_state(c, (const unsigned char *)bytes, size, state);
}

OFFERED Status fmi2GetDirectionalDerivative(Component c, const Reference unknown[], size_t n, const Reference known[],
                                            size_t m, const double seed[], double sensitivity[]) {
    (void)unknown, (void)n, (void)known, (void)m, (void)seed, (void)sensitivity;
    return (Status)not_offered(c, __func__);
}

OFFERED Status fmi2SetRealInputDerivatives(Component c, const Reference references[], size_t n, const int order[],
                                           const double values[]) {
    (void)references, (void)n, (void)order, (void)values;
    return (Status)not_offered(c, __func__);
}

OFFERED Status fmi2GetRealOutputDerivatives(Component c, const Reference references[], size_t n, const int order[],
                                            double values[]) {
    (void)references, (void)n, (void)order, (void)values;
    return (Status)not_offered(c, __func__);
}

OFFERED Status fmi2DoStep(Component c, double now, double step, Boolean no_way_back) {
    int changed;
    (void)no_way_back;
    EXPECT(BETWEEN);
    return (Status)do_step(c, now, step, &changed);
}

OFFERED Status fmi2CancelStep(Component c) { return (Status)not_offered(c, __func__); }

OFFERED Status fmi2GetStatus(Component c, StatusKind kind, Status *value) {
    (void)kind, (void)value;
    return (Status)not_offered(c, __func__);
}

OFFERED Status fmi2GetRealStatus(Component c, StatusKind kind, double *value) {
    EXPECT(ALIVE);
    if (kind != LAST_TIME) return (Status)not_offered(c, __func__);
    *value = run_time(((Instance *)c)->run);
    return OK;
}

OFFERED Status fmi2GetIntegerStatus(Component c, StatusKind kind, int *value) {
    (void)kind, (void)value;
    return (Status)not_offered(c, __func__);
}

OFFERED Status fmi2GetBooleanStatus(Component c, StatusKind kind, Boolean *value) {
    EXPECT(ALIVE);
    if (kind != TERMINATED_STATUS) return (Status)not_offered(c, __func__);
    *value = 0;
    return OK;
}

OFFERED Status fmi2GetStringStatus(Component c, StatusKind kind, const char **value) {
    (void)kind, (void)value;
    return (Status)not_offered(c, __func__);
}
