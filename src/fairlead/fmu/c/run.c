/* See run.h. The same calls of the same loop on the same memory as fairlead/outside.py. */
#include "run.h"
#include "image.h"
#include "model.h"
#include "pivots.h"
#include "tuned.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE = 1024, LINE = 64 };
static const double NEAR_END = 1e-9; /* share of the span's end that no goal may be nearer to */

struct Run {
    unsigned char *memory, *room;
    int begun;
    int ended;   /* a status that ends a run, or 0 */
    int changes; /* zone changes since they were last counted */
    Pivots *pivots;       /* that the run has come upon, or NULL */
    int64_t replanned_at; /* how often was factorised when it did */
    double tuned[N_TUNED + 1], asked[N_TUNED + 1]; /* values of parameters in force, and as they were set last */
    int tune_due;
    char message[MESSAGE];
};

/* Beside the arena a state has what the run itself knows, and what model it is of. */
typedef struct {
    char token[sizeof MODEL_TOKEN];
    int32_t begun, ended;
    int64_t replanned_at;
    int64_t n_lower, n_upper; /* of its pivots, which follow the arena; -1 for those of the plan */
    double tuned[N_TUNED + 1], asked[N_TUNED + 1];
    int64_t tune_due;
} Header;

static int64_t *whole(const Run *run, int64_t at) { return (int64_t *)(run->memory + at); }
static double *real(const Run *run, int64_t at) { return (double *)(run->memory + at); }

static void link_up(Run *run) {
    for (int64_t k = 0; k < N_LINKS; k++) {
        const Link *link = &fairlead_links[k];
        const void *target = link->kind == LINK_MEMORY   ? (const void *)(run->memory + link->target)
                             : link->kind == LINK_SHARED ? (const void *)(fairlead_shared + link->target)
                                                         : (const void *)model_functions[link->target];
        *whole(run, link->at) = (int64_t)(intptr_t)target;
    }
}

static void fill(Run *run) {
    for (int64_t k = 0; k < N_RUNS; k++)
        memcpy(run->memory + fairlead_runs[k].at, fairlead_bytes + fairlead_runs[k].from, fairlead_runs[k].length);
    tuned_apply(run->memory, run->tuned);
    link_up(run);
    run->begun = run->ended = run->changes = 0;
    run->replanned_at = -1;
    run->message[0] = 0;
}

static void fill_anew(Run *run) {
    memset(run->memory, 0, MEMORY_BYTES);
    fill(run);
}

static void with_own_parameters(Run *run) {
    for (int k = 0; k < N_TUNED; k++) run->tuned[k] = run->asked[k] = model_parameters[k].value;
    run->tune_due = 0;
}

static void forget_pivots(Run *run) {
    free(run->pivots);
    run->pivots = NULL;
}

Run *run_new(void) {
    Run *run = calloc(1, sizeof *run);
    if (run == NULL) return NULL;
    run->room = calloc(1, MEMORY_BYTES + LINE);
    if (run->room == NULL) {
        free(run);
        return NULL;
    }
    run->memory = run->room + (LINE - (uintptr_t)run->room % LINE) % LINE;
    with_own_parameters(run);
    fill(run);
    return run;
}

void run_free(Run *run) {
    if (run == NULL) return;
    free(run->pivots);
    free(run->room);
    free(run);
}

void run_reset(Run *run) {
    forget_pivots(run);
    with_own_parameters(run);
    fill_anew(run);
}

double run_time(const Run *run) { return *real(run, AT_T); }

long long run_overruns(const Run *run) { return *whole(run, AT_OVERRUNS); }

void run_set(Run *run, int input, double value) {
    real(run, AT_SET_VALUES)[input] = value;
    *whole(run, AT_SET_DUE) = 1;
}

double run_input(const Run *run, int input) { return real(run, AT_SET_VALUES)[input]; }

const char *run_tune(Run *run, int parameter, double value) {
    const Parameter *one = &model_parameters[parameter];
    if (value == run->asked[parameter]) return NULL;
    if (!(value >= one->low && value <= one->high)) return "is beyond its range";
    if (run->begun && one->when == WHEN_BEFORE) return "says how a run begins, and changes nothing now";
    if (!run->begun && one->when == WHEN_AFTER) return "can be set after the start only: the start follows it otherwise";
    run->asked[parameter] = value;
    run->tune_due = 1;
    return NULL;
}

double run_parameter(const Run *run, int parameter) { return run->asked[parameter]; }

const char *run_message(const Run *run) { return run->message; }

int run_refuse(Run *run, const char *why) {
    snprintf(run->message, MESSAGE, "%s", why);
    return -1;
}

/* Why a run ends, with what to look at first (fairlead/integrate/sentences.py). */
static void tell(Run *run, int status) {
    const char *unknown = N_UNKNOWNS > 0 ? model_unknowns[*whole(run, AT_WORST)] : "";
    const int64_t culprit = *whole(run, AT_CULPRIT);
    double t = run_time(run);
    switch (status) {
    case STATUS_STEP_FLOOR:
        snprintf(run->message, MESSAGE, "t = %.6g s: the step size fell to its floor because of the error of %s. "
                 "A law may jump inside its zone.", t, unknown);
        break;
    case STATUS_NOT_FINITE:
        snprintf(run->message, MESSAGE, "t = %.6g s: %s is not a finite number, whatever the step. A law divides by "
                 "zero, overflows, or is read beyond the range in which it has values.", t, unknown);
        break;
    case STATUS_NOT_SETTLED:
        snprintf(run->message, MESSAGE, "t = %.6g s: zones did not settle. Two laws contradict each other there.", t);
        break;
    case STATUS_INCONSISTENT:
        snprintf(run->message, MESSAGE, "t = %.6g s: no consistent values found for the algebraic unknowns, least of "
                 "all for %s.", t, unknown);
        break;
    case STATUS_SINGULAR:
        snprintf(run->message, MESSAGE, "t = %.6g s: the equations do not determine %s.", t,
                 culprit >= 0 && culprit < N_UNKNOWNS ? model_unknowns[culprit] : "all unknowns");
        break;
    case STATUS_CHATTER:
        snprintf(run->message, MESSAGE, "t = %.6g s: %s switches to and fro faster than its dwell.", t,
                 culprit >= 0 && culprit < N_MACHINES ? model_machines[culprit] : "a contact");
        break;
    case STATUS_MAX_STEPS:
        snprintf(run->message, MESSAGE, "t = %.6g s: the budget of steps (run.max_steps) is used up.", t);
        break;
    case STATUS_MAX_EVENTS:
        snprintf(run->message, MESSAGE, "t = %.6g s: the budget of events (run.max_events) is used up.", t);
        break;
    case STATUS_REBOUND_RUBS:
        snprintf(run->message, MESSAGE, "t = %.6g s: a stop rebounds while friction takes part in the impact.", t);
        break;
    case STATUS_GIVEN_APART:
        snprintf(run->message, MESSAGE, "t = %.6g s: given motions move apart what parts without give hold together.", t);
        break;
    case STATUS_REPLAN:
        snprintf(run->message, MESSAGE, "t = %.6g s: there is no memory to choose another order of pivots.", t);
        break;
    default:
        snprintf(run->message, MESSAGE, "t = %.6g s: the run ended with status %d.", t, status);
    }
}

static int end(Run *run, int status) {
    run->ended = status;
    tell(run, status);
    return -1;
}

/* Other pivots; without any the equations are singular (underway.py). */
static int replan(Run *run) {
    int again = *whole(run, AT_FACTORISATIONS) <= run->replanned_at + 1;
    enum Found said = PIVOTS_SINGULAR; /* a full matrix has all pivots to choose */
    if (!again && !*whole(run, AT_DENSE)) {
        Pivots *found = NULL;
        said = pivots_choose(run->memory, &found);
        if (said == PIVOTS_FOUND) {
            forget_pivots(run);
            run->pivots = found;
            pivots_link(run->memory, found);
            *whole(run, AT_REDUCED_VALID) = 0;
            *whole(run, AT_REPLANS) += 1;
        }
    }
    run->replanned_at = *whole(run, AT_FACTORISATIONS);
    if (said == PIVOTS_NO_ROOM) return end(run, STATUS_REPLAN);
    if (*whole(run, AT_MIDWAY)) *whole(run, AT_REPLANNED) = 1;
    else if (said == PIVOTS_SINGULAR && *whole(run, AT_PHASE) == PHASE_SETTLE && !again) *whole(run, AT_NO_PIVOTS) = 1;
    else if (said == PIVOTS_SINGULAR) return end(run, STATUS_SINGULAR);
    return 0;
}

/* Enter the loop for at most so many trial steps, and empty what it recorded. */
static int enter(Run *run, int64_t attempts) {
    int status = (int)fairlead_advance((int64_t)(intptr_t)run->memory, attempts);
    run->changes += (int)*whole(run, AT_EVENTS);
    *whole(run, AT_ROWS) = *whole(run, AT_EVENTS) = 0;
    switch (status) {
    case STATUS_PAUSED:
    case STATUS_BUFFER_FULL:
        return 0;
    case STATUS_REPLAN:
        return replan(run);
    default:
        return end(run, status);
    }
}

/* One trial step that does not go beyond `goal`, of a run that is settled. */
static int step(Run *run, double goal) {
    double due = *real(run, AT_T_NEXT);
    *real(run, AT_T_NEXT) = goal < due ? goal : due;
    int said = enter(run, 1);
    if (*real(run, AT_T_NEXT) == goal && goal < due) *real(run, AT_T_NEXT) = due;
    return said;
}

/* The units of the unknowns, which are those at the start of a run (fairlead/integrate/prepare.py). In memory where
   there are parameters, and then a part of the state. */
static double *units(const Run *run) { return (double *)(intptr_t)*whole(run, AT_AT_COLUMN_SCALE); }
enum { UNITS_BYTES = N_TUNED > 0 ? N_UNKNOWNS * sizeof(double) : 0 };

static void take_units(Run *run) {
    const double *y = (const double *)(intptr_t)*whole(run, AT_AT_Y), *cap = (const double *)(intptr_t)*whole(run, AT_AT_CAP);
    const double *absolute = (const double *)(intptr_t)*whole(run, AT_AT_ABSOLUTE);
    const double *relative = (const double *)(intptr_t)*whole(run, AT_AT_RELATIVE);
    for (int k = 0; k < N_UNKNOWNS; k++) units(run)[k] = fmin(absolute[k] + relative[k] * fabs(y[k]), cap[k]);
}

/* Go on with the values of parameters that were set: as a run that begins where this one is (fairlead/tuning.py). */
static int go_over(Run *run) {
    if (!run->tune_due) return 0;
    unsigned char *room = malloc(KEPT_BYTES + 1);
    if (room == NULL) return run_refuse(run, "There is no memory to change a parameter.");
    memcpy(run->tuned, run->asked, sizeof run->tuned);
    run->tune_due = 0;
    if (!run->begun) {
        tuned_apply(run->memory, run->tuned);
    } else {
        const double t = run_time(run);
        const int64_t overruns = *whole(run, AT_OVERRUNS);
        kept_save(run->memory, room);
        forget_pivots(run);
        fill_anew(run);
        kept_restore(run->memory, room);
        *real(run, AT_STOP) = t + (*real(run, AT_STOP) - *real(run, AT_START));
        *real(run, AT_START) = *real(run, AT_T) = t;
        *whole(run, AT_OVERRUNS) = overruns;
        take_units(run);
        run->begun = 1;
    }
    free(room);
    return 0;
}

/* Everything that is recorded, where the run is. */
static void read_recorded(const Run *run, double *all) {
    typedef void (*Outputs)(int64_t, double, const double *, double *);
    Outputs outputs = (Outputs)(intptr_t)*whole(run, AT_CALL_OUTPUTS);
    outputs(*whole(run, AT_CONTEXT), run_time(run), (const double *)(intptr_t)*whole(run, AT_AT_Y), all);
}

/* End where no law says what follows, as where a part is used up (fairlead/analysis/record/ends.py). */
static int end_without_law(Run *run) {
    if (N_ENDS == 0) return 0;
    double all[N_RECORDED + 1];
    read_recorded(run, all);
    for (int k = 0; k < N_ENDS; k++)
        if (model_ends[k].sign * all[model_ends[k].column] > model_ends[k].most) {
            run->ended = STATUS_ENDED;
            snprintf(run->message, MESSAGE, "t = %.6g s: %s", run_time(run), model_ends[k].sentence);
            return -1;
        }
    return 0;
}

int run_begin(Run *run) {
    if (run->begun) return 0;
    if (go_over(run)) return -1;
    run->begun = 1;
    while (run_time(run) == *real(run, AT_START) && *whole(run, AT_PHASE) != PHASE_TRY)
        if (enter(run, 0)) return -1;
    return 0;
}

/* Settle where the run is, if that is due: a settlement asks anew when the next time event is. */
static int settle_if_due(Run *run) {
    while (*whole(run, AT_PHASE) != PHASE_TRY)
        if (enter(run, 0)) return -1;
    return 0;
}

int run_settle(Run *run) {
    if (run_begin(run) || go_over(run) || settle_if_due(run)) return -1;
    while (*whole(run, AT_SET_DUE))
        if (step(run, run_time(run))) return -1;
    return settle_if_due(run);
}

int run_advance(Run *run, double goal, int until_change, int *changed) {
    *changed = 0;
    if (run_begin(run) || go_over(run)) return -1;
    if (goal == run_time(run)) return run_settle(run);
    double stop = *real(run, AT_STOP);
    /* the span is a scale of times, and its end no event */
    if (goal >= stop - NEAR_END * fmax(fabs(stop), stop - *real(run, AT_START)))
        *real(run, AT_STOP) = *real(run, AT_START) + 2.0 * (goal - *real(run, AT_START));
    if (run_settle(run)) return -1;
    run->changes = 0;
    if (end_without_law(run)) return -1;
    while (run_time(run) < goal && !(until_change && run->changes > 0))
        if (step(run, goal) || end_without_law(run)) return -1;
    *changed = run->changes > 0;
    return 0;
}

int run_outputs(Run *run, double *values) {
    if (run_begin(run)) return -1;
    double all[N_RECORDED + 1];
    read_recorded(run, all);
    for (int k = 0; k < N_OUTPUTS; k++) {
        values[k] = all[model_columns[model_columns_starts[k]]];
        for (int j = model_columns_starts[k] + 1; j < model_columns_starts[k + 1]; j++) {
            const double other = all[model_columns[j]];
            if (model_takes_largest[k] ? other > values[k] : other < values[k]) values[k] = other;
        }
    }
    return 0;
}

static size_t pivots_of(const Run *run, int64_t n_lower, int64_t n_upper) {
    return n_lower < 0 ? 0 : pivots_bytes(run->memory, n_lower, n_upper);
}

size_t run_state_size(const Run *run) {
    const Pivots *pivots = run->pivots;
    return sizeof(Header) + STATE_BYTES + UNITS_BYTES + (pivots == NULL ? 0 : pivots_of(run, pivots->n_lower, pivots->n_upper));
}

void run_save(const Run *run, unsigned char *state) {
    Header header;
    memset(&header, 0, sizeof header);
    memcpy(header.token, MODEL_TOKEN, sizeof MODEL_TOKEN);
    header.begun = run->begun;
    header.ended = run->ended;
    header.replanned_at = run->replanned_at;
    memcpy(header.tuned, run->tuned, sizeof header.tuned);
    memcpy(header.asked, run->asked, sizeof header.asked);
    header.tune_due = run->tune_due;
    header.n_lower = run->pivots == NULL ? -1 : run->pivots->n_lower;
    header.n_upper = run->pivots == NULL ? -1 : run->pivots->n_upper;
    memcpy(state, &header, sizeof header);
    memcpy(state + sizeof header, run->memory, STATE_BYTES);
    for (int64_t k = 0; k < N_LINKS; k++) /* addresses belong to a run, and are no part of its state */
        if (fairlead_links[k].at < STATE_BYTES) memset(state + sizeof header + fairlead_links[k].at, 0, 8);
    if (UNITS_BYTES > 0) memcpy(state + sizeof header + STATE_BYTES, units(run), UNITS_BYTES);
    if (run->pivots != NULL)
        memcpy(state + sizeof header + STATE_BYTES + UNITS_BYTES, run->pivots, pivots_of(run, header.n_lower, header.n_upper));
}

int run_restore(Run *run, const unsigned char *state, size_t size) {
    Header header;
    Pivots *pivots = NULL;
    if (size < sizeof header + STATE_BYTES + UNITS_BYTES) return -1;
    memcpy(&header, state, sizeof header);
    size_t more = size - sizeof header - STATE_BYTES - UNITS_BYTES;
    if (memcmp(header.token, MODEL_TOKEN, sizeof MODEL_TOKEN)) return -1;
    if (more != pivots_of(run, header.n_lower, header.n_upper)) return -1;
    if (more > 0) {
        pivots = malloc(more);
        if (pivots == NULL) return -1;
        memcpy(pivots, state + sizeof header + STATE_BYTES + UNITS_BYTES, more);
    }
    memcpy(run->tuned, header.tuned, sizeof header.tuned);
    memcpy(run->asked, header.asked, sizeof header.asked);
    run->tune_due = (int)header.tune_due;
    tuned_apply(run->memory, run->tuned);
    memcpy(run->memory, state + sizeof header, STATE_BYTES);
    link_up(run);
    if (UNITS_BYTES > 0) memcpy(units(run), state + sizeof header + STATE_BYTES, UNITS_BYTES);
    forget_pivots(run);
    run->pivots = pivots;
    if (pivots != NULL) pivots_link(run->memory, pivots);
    run->begun = header.begun;
    run->ended = header.ended;
    run->replanned_at = header.replanned_at;
    run->message[0] = 0;
    return 0;
}
