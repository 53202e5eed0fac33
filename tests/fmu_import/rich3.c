/* FMI 3, co-simulation with event mode, around rich.h. */
#include "fmi3FunctionTypes.h"
#include "rich.h"

#define IN(modes, name) if (!(((Rich *)c)->mode & (modes))) return wrong(name " in mode %d", ((Rich *)c)->mode)

const char *fmi3GetVersion(void) { return "3.0"; }
fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean events,
    fmi3Boolean early, const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    return rich(token, events, early);
}
void fmi3FreeInstance(fmi3Instance c) { free(c); }
#define MOVE(name, from, to) fmi3Status fmi3##name(fmi3Instance c) { IN(from, #name); ((Rich *)c)->mode = to; return fmi3OK; }
MOVE(EnterConfigurationMode, INSTANTIATED, CONFIGURATION)
MOVE(ExitConfigurationMode, CONFIGURATION, INSTANTIATED)
MOVE(EnterStepMode, EVENT, STEP)
fmi3Status fmi3EnterEventMode(fmi3Instance c) {
    IN(STEP, "EnterEventMode");
    if (!((Rich *)c)->events) return wrong("event mode was not asked for");
    ((Rich *)c)->mode = EVENT;
    ((Rich *)c)->visits++;
    return fmi3OK;
}
fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean a, fmi3Float64 b, fmi3Float64 start, fmi3Boolean d,
                                       fmi3Float64 e) {
    IN(INSTANTIATED, "EnterInitializationMode");
    ((Rich *)c)->mode = INITIALIZATION;
    ((Rich *)c)->t = start;
    return fmi3OK;
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
    IN(INITIALIZATION, "ExitInitializationMode");
    ((Rich *)c)->mode = ((Rich *)c)->events ? EVENT : STEP;
    return fmi3OK;
}
fmi3Status fmi3Terminate(fmi3Instance c) { return fmi3OK; }

enum { SIZE_N = 1, SIZE_M, VECTOR = 10, WEIGHTS, RESULT, WHOLES, SUM, NAMES, LENGTH, SWITCHES, SWITCHED,
       HEIGHT = 30, SPEED, RESTITUTION, GRAVITY, BOUNCES, COUNTER, UPDATES, VISITS, FREE, SAMPLED = 50, TOTAL,
       TICKS = 60, PERIOD = 70 };

/* Where a number lies, and how many there are. */
static double *numbers(Rich *m, fmi3ValueReference r, size_t *count) {
    *count = 1;
    switch (r) {
        case VECTOR: *count = m->n; return m->u;
        case WEIGHTS: *count = m->n * m->m; return m->w;
        case RESULT:
            *count = m->m;
            for (size_t i = 0; i < m->m; i++) {
                m->y[i] = 0;
                for (size_t j = 0; j < m->n; j++) m->y[i] += m->w[i * m->n + j] * m->u[j];
            }
            return m->y;
        case HEIGHT: return &m->h;
        case SPEED: return &m->v;
        case RESTITUTION: return &m->e;
        case GRAVITY: return &m->g;
        case FREE: return &m->u[0];
        case SAMPLED: return &m->sampled;
        case TOTAL: m->total = m->sum + m->sampled; return &m->total;
        case PERIOD: return &m->interval[P];
        default: return 0;
    }
}

static int allowed(Rich *m, fmi3ValueReference r, bool set) {
    bool clocked = r == SAMPLED || r == TOTAL;
    if (clocked && m->mode != INITIALIZATION && !(m->mode == EVENT && m->active[R]))
        return wrong("variable %u without the tick of its clock, in mode %d", r, m->mode);
    if (set && !(m->mode & (INSTANTIATED | INITIALIZATION | EVENT | STEP))) return wrong("set in mode %d", m->mode);
    if (!set && m->mode == CONFIGURATION) return wrong("get in mode %d", m->mode);
    return 0;
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Float64 v[], size_t total) {
    size_t at = 0, count;
    for (size_t k = 0; k < n; k++) {
        if (allowed(c, r[k], false)) return fmi3Error;
        double *from = numbers(c, r[k], &count);
        if (!from || at + count > total) return wrong("%zu values are wanted of %u", total, r[k]);
        memcpy(v + at, from, count * sizeof *v);
        at += count;
    }
    return at == total ? fmi3OK : wrong("%zu values are wanted, and there are %zu", total, at);
}
fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Float64 v[], size_t total) {
    size_t at = 0, count;
    for (size_t k = 0; k < n; k++) {
        if (allowed(c, r[k], true)) return fmi3Error;
        double *to = numbers(c, r[k], &count);
        if (!to || at + count > total) return wrong("%zu values are given to %u", total, r[k]);
        memcpy(to, v + at, count * sizeof *v);
        at += count;
    }
    return at == total ? fmi3OK : wrong("%zu values are given, and there are %zu", total, at);
}
fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Int32 v[], size_t total) {
    Rich *m = c;
    for (size_t k = 0; k < n; k++) switch (r[k]) {
        case SUM: v[k] = m->k[0] + m->k[1]; break;
        case LENGTH: v[k] = (int)(10 * strlen(m->text[0]) + strlen(m->text[1])); break;
        case SWITCHED: v[k] = 2 * m->b[0] + m->b[1]; break;
        case BOUNCES: v[k] = m->bounces; break;
        case COUNTER: v[k] = m->counter; break;
        case UPDATES: v[k] = m->updates; break;
        case VISITS: v[k] = m->visits; break;
        default: if (r[k] < TICKS || r[k] >= TICKS + CLOCKS) return fmi3Error; v[k] = m->ticks[r[k] - TICKS];
    }
    return fmi3OK;
}
fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Int32 v[], size_t total) {
    if (n != 1 || r[0] != WHOLES || total != 2) return fmi3Error;
    memcpy(((Rich *)c)->k, v, sizeof ((Rich *)c)->k);
    return fmi3OK;
}
fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3UInt64 v[], size_t total) {
    IN(CONFIGURATION, "SetUInt64");
    for (size_t k = 0; k < n; k++) *(r[k] == SIZE_N ? &((Rich *)c)->n : &((Rich *)c)->m) = v[k];
    return fmi3OK;
}
fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3UInt64 v[], size_t total) {
    for (size_t k = 0; k < n; k++) v[k] = r[k] == SIZE_N ? ((Rich *)c)->n : ((Rich *)c)->m;
    return fmi3OK;
}
fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Boolean v[], size_t total) {
    if (n != 1 || r[0] != SWITCHES || total != 2) return fmi3Error;
    if (((Rich *)c)->events) IN(INSTANTIATED | INITIALIZATION | EVENT, "SetBoolean, of a discrete input,");
    memcpy(((Rich *)c)->b, v, sizeof ((Rich *)c)->b);
    return fmi3OK;
}
fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3String v[], size_t total) {
    if (n != 1 || r[0] != NAMES || total != 2) return fmi3Error;
    for (int k = 0; k < 2; k++) strncpy(((Rich *)c)->text[k], v[k], TEXT - 1);
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 t, fmi3Float64 step, fmi3Boolean final, fmi3Boolean *event,
                      fmi3Boolean *end, fmi3Boolean *early, fmi3Float64 *reached) {
    IN(STEP, "DoStep");
    Rich *m = c;
    double done;
    int status = go(m, t, step, event, &done);
    *end = false;
    *early = *event;
    *reached = t + done;
    return *early && !m->early ? wrong("early return was not allowed") : status;
}
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *end, fmi3Boolean *nominals,
                                    fmi3Boolean *values, fmi3Boolean *defined, fmi3Float64 *next) {
    IN(EVENT, "UpdateDiscreteStates");
    Rich *m = c;
    *again = update(m);
    *end = *nominals = *values = false;
    *defined = is(m, "stair") || is(m, "never") || is(m, "strict");
    *next = m->next;
    return fmi3OK;
}
fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Clock v[]) {
    IN(EVENT, "SetClock");
    for (size_t k = 0; k < n; k++) if (v[k] && tick(c, r[k] - 100)) return fmi3Error;
    return fmi3OK;
}
fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Clock v[]) {
    IN(EVENT, "GetClock");
    for (size_t k = 0; k < n; k++) {
        if (r[k] - 100 == FOURTH && !((Rich *)c)->active[OUT]) return wrong("clock 107 without the tick of its clock");
        v[k] = ((Rich *)c)->active[r[k] - 100];
    }
    return fmi3OK;
}
fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Float64 v[],
                                  fmi3IntervalQualifier q[]) {
    IN(INITIALIZATION | EVENT, "GetIntervalDecimal");
    Rich *m = c;
    for (size_t k = 0; k < n; k++) {
        v[k] = m->interval[r[k] - 100];
        q[k] = fmi3IntervalChanged;
        if (r[k] - 100 == P) m->last[P] = 0.15 - m->interval[P];
        if (r[k] - 100 == D) {
            bool known = m->due > m->t + 1e-9;
            q[k] = !known ? fmi3IntervalNotYetKnown : m->told ? fmi3IntervalUnchanged : fmi3IntervalChanged;
            v[k] = 0.05;
            m->told = known;
        }
    }
    return fmi3OK;
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Float64 v[]) {
    IN(INITIALIZATION, "GetShiftDecimal");
    for (size_t k = 0; k < n; k++) v[k] = r[k] - 100 == P ? 0.15 : 0;
    return fmi3OK;
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Float64 v[]) {
    IN(INITIALIZATION, "SetIntervalDecimal");
    for (size_t k = 0; k < n; k++) {
        ((Rich *)c)->interval[r[k] - 100] = v[k];
        ((Rich *)c)->last[r[k] - 100] = -v[k];
    }
    return fmi3OK;
}
fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *s) {
    *s = malloc(sizeof(Rich));
    memcpy(*s, c, sizeof(Rich));
    return fmi3OK;
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState s) { memcpy(c, s, sizeof(Rich)); return fmi3OK; }
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *s) { free(*s); *s = 0; return fmi3OK; }

/* Never called, and demanded by FMPy. */
#define NOT(name) int name(void) { return wrong(#name); }
NOT(fmi3SetDebugLogging) NOT(fmi3InstantiateModelExchange) NOT(fmi3InstantiateScheduledExecution) NOT(fmi3Reset)
NOT(fmi3GetFloat32) NOT(fmi3GetInt8) NOT(fmi3GetUInt8) NOT(fmi3GetInt16) NOT(fmi3GetUInt16) NOT(fmi3GetUInt32)
NOT(fmi3GetInt64) NOT(fmi3GetBoolean) NOT(fmi3GetString) NOT(fmi3GetBinary)
NOT(fmi3SetFloat32) NOT(fmi3SetInt8) NOT(fmi3SetUInt8) NOT(fmi3SetInt16) NOT(fmi3SetUInt16) NOT(fmi3SetUInt32)
NOT(fmi3SetInt64) NOT(fmi3SetBinary)
NOT(fmi3GetNumberOfVariableDependencies) NOT(fmi3GetVariableDependencies)
NOT(fmi3SerializedFMUStateSize) NOT(fmi3SerializeFMUState) NOT(fmi3DeserializeFMUState)
NOT(fmi3GetDirectionalDerivative) NOT(fmi3GetAdjointDerivative) NOT(fmi3GetIntervalFraction)
NOT(fmi3GetShiftFraction) NOT(fmi3SetIntervalFraction) NOT(fmi3SetShiftDecimal)
NOT(fmi3SetShiftFraction) NOT(fmi3EvaluateDiscreteStates)
NOT(fmi3EnterContinuousTimeMode) NOT(fmi3CompletedIntegratorStep) NOT(fmi3SetTime) NOT(fmi3SetContinuousStates)
NOT(fmi3GetContinuousStateDerivatives) NOT(fmi3GetEventIndicators) NOT(fmi3GetContinuousStates)
NOT(fmi3GetNominalsOfContinuousStates) NOT(fmi3GetNumberOfEventIndicators) NOT(fmi3GetNumberOfContinuousStates)
NOT(fmi3GetOutputDerivatives) NOT(fmi3ActivateModelPartition)
