/* See wrapper.h. */
#include "wrapper.h"
#include "model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 1400 };
#define LAST_REFERENCE (N_INPUTS + N_OUTPUTS + N_TUNED)
static const double SAME_TIME = 1e-9; /* of a step: what a master's sums may be off */

static enum Said say(Instance *instance, enum Said said, const char *form, ...) {
    char text[TEXT];
    va_list given;
    va_start(given, form);
    vsnprintf(text, sizeof text, form, given);
    va_end(given);
    instance->tell(instance, said, said >= SAID_ERROR ? "logStatusError" : "logStatusWarning", text);
    return said;
}

Instance *instance_new(const char *name, const char *token, Tell tell, void *environment, void *callback, int logging) {
    Instance *instance = calloc(1, sizeof *instance);
    if (instance == NULL) return NULL;
    instance->tell = tell;
    instance->environment = environment;
    instance->callback = callback;
    instance->logging = logging;
    instance->last = INFINITY;
    instance->name = strdup(name == NULL ? "" : name);
    if (token == NULL || strcmp(token, MODEL_TOKEN) != 0) {
        say(instance, SAID_ERROR, "The token is not that of %s: its description and its library are not of one export.",
            MODEL_IDENTIFIER);
        instance_free(instance);
        return NULL;
    }
    instance->run = run_new();
    if (instance->run == NULL || instance->name == NULL) {
        say(instance, SAID_ERROR, "There is no memory for another instance of %s.", MODEL_IDENTIFIER);
        instance_free(instance);
        return NULL;
    }
    return instance;
}

void instance_free(Instance *instance) {
    if (instance == NULL) return;
    run_free(instance->run);
    free(instance->name);
    free(instance);
}

enum Said instance_reset(Instance *instance) {
    run_reset(instance->run);
    instance->stage = MADE;
    instance->begun_anew = 0;
    instance->last = INFINITY;
    return SAID_OK;
}

enum Said refuse(Instance *instance, const char *function, const char *why) {
    return say(instance, SAID_ERROR, "%s: %s", function, why);
}

enum Said expect(Instance *instance, const char *function, unsigned stages) {
    static const char *const names[] = {"before its initialisation", "being initialised", "between two steps",
                                        "in event mode", "terminated"};
    if (instance == NULL) return SAID_ERROR;
    if (stages & 1u << instance->stage) return SAID_OK;
    return say(instance, SAID_ERROR, "%s: not allowed while the instance is %s.", function, names[instance->stage]);
}

enum Said not_offered(Instance *instance, const char *function) {
    if (instance == NULL) return SAID_ERROR;
    return say(instance, SAID_ERROR, "%s: this FMU does not offer that; its description says so.", function);
}

enum Said set_up(Instance *instance, double start, double last) {
    double own = run_time(instance->run);
    if (!(fabs(start - own) <= SAME_TIME * fmax(1.0, fabs(own))))
        return say(instance, SAID_ERROR, "This FMU begins at t = %.9g s, and start is %.9g s. Export it with another "
                   "run.start.", own, start);
    instance->last = last;
    return SAID_OK;
}

static enum Said failed(Instance *instance) {
    return say(instance, SAID_ERROR, "%s", run_message(instance->run));
}

/* To before the start, with what was set since. */
static void back_to_start(Instance *instance) {
    double inputs[N_INPUTS + 1], parameters[N_TUNED + 1];
    for (int k = 0; k < N_INPUTS; k++) inputs[k] = run_input(instance->run, k);
    for (int k = 0; k < N_TUNED; k++) parameters[k] = run_parameter(instance->run, k);
    run_reset(instance->run);
    for (int k = 0; k < N_TUNED; k++) run_tune(instance->run, k, parameters[k]);
    for (int k = 0; k < N_INPUTS; k++)
        if (inputs[k] != run_input(instance->run, k)) run_set(instance->run, k, inputs[k]);
    instance->begun_anew = 0;
}

/* While initialising what is set last counts: the run begins again with it. */
static enum Said begin(Instance *instance) {
    if (instance->begun_anew) back_to_start(instance);
    return run_begin(instance->run) ? failed(instance) : SAID_OK;
}

enum Said initialised(Instance *instance, enum Stage next) {
    enum Said said = begin(instance);
    if (said == SAID_OK) instance->stage = next;
    return said;
}

enum Said get_reals(Instance *instance, const unsigned references[], size_t n, double values[], size_t room) {
    double outputs[N_OUTPUTS + 1];
    int known = 0;
    if (room != n) return refuse(instance, "get", "every variable is one number.");
    for (size_t k = 0; k < n; k++) {
        unsigned at = references[k];
        if (at == 0) {
            values[k] = run_time(instance->run);
        } else if (at <= N_INPUTS) {
            values[k] = run_input(instance->run, (int)at - 1);
        } else if (at <= N_INPUTS + N_OUTPUTS) {
            if (!known) {
                enum Said said = instance->stage == INITIALISING || instance->stage == MADE ? begin(instance) : SAID_OK;
                if (said != SAID_OK) return said;
                if (run_outputs(instance->run, outputs)) return failed(instance);
                known = 1;
            }
            values[k] = outputs[at - N_INPUTS - 1];
        } else if (at <= LAST_REFERENCE) {
            values[k] = run_parameter(instance->run, (int)(at - N_INPUTS - N_OUTPUTS - 1));
        } else {
            return say(instance, SAID_ERROR, "get: there is no variable with the value reference %u.", at);
        }
    }
    return SAID_OK;
}

static int is_parameter(unsigned at) { return at > N_INPUTS + N_OUTPUTS && at <= LAST_REFERENCE; }

static enum Said set_parameter(Instance *instance, int parameter, double value) {
    const char *name = model_parameters[parameter].name;
    if (instance->stage == MADE || instance->stage == INITIALISING) back_to_start(instance); /* an output may be read */
    const char *why = run_tune(instance->run, parameter, value);
    if (why == NULL) return SAID_OK;
    return say(instance, SAID_ERROR, "set: %s = %.9g %s. It can be set from %.9g to %.9g.", name, value, why,
               model_parameters[parameter].low, model_parameters[parameter].high);
}

enum Said set_reals(Instance *instance, const unsigned references[], size_t n, const double values[], size_t given) {
    if (given != n) return refuse(instance, "set", "every variable is one number.");
    for (size_t k = 0; k < n; k++) {
        unsigned at = references[k];
        if ((at == 0 || at > N_INPUTS) && !is_parameter(at))
            return say(instance, SAID_ERROR, "set: the value reference %u is of no input and no parameter.", at);
        if (!isfinite(values[k]))
            return say(instance, SAID_ERROR, "set: %s is given a value that is not a finite number.",
                       at <= N_INPUTS ? model_inputs[at - 1] : model_parameters[at - N_INPUTS - N_OUTPUTS - 1].name);
    }
    for (size_t k = 0; k < n; k++) {
        int input = (int)references[k] - 1;
        if (is_parameter(references[k])) {
            enum Said said = set_parameter(instance, input - N_INPUTS - N_OUTPUTS, values[k]);
            if (said != SAID_OK) return said;
        } else if (instance->stage == INITIALISING || instance->stage == MADE) {
            instance->begun_anew = 1;
            run_set(instance->run, input, values[k]);
        } else if (values[k] != run_input(instance->run, input)) { /* a value that stays is no event */
            run_set(instance->run, input, values[k]);
        }
    }
    return SAID_OK;
}

enum Said do_step(Instance *instance, double now, double step, int *changed) {
    double t = run_time(instance->run), goal = now + step;
    *changed = 0;
    if (!(step >= 0.0) || !isfinite(goal)) return refuse(instance, "DoStep", "the step is no length of time.");
    if (fabs(now - t) > SAME_TIME * fmax(step, fabs(t)))
        return say(instance, SAID_ERROR, "DoStep: the step begins at t = %.17g s, and the instance is at %.17g s.", now, t);
    if (goal > instance->last + SAME_TIME * fmax(step, fabs(instance->last)))
        return say(instance, SAID_ERROR, "DoStep: the step ends at t = %.17g s, beyond the stop time %.17g s that was set. "
                   "Leave it undefined, or end there.", goal, instance->last);
    if (goal < t) goal = t;
    return run_advance(instance->run, goal, instance->early, changed) ? failed(instance) : SAID_OK;
}

/* On what was set in event mode. */
enum Said settle(Instance *instance) { return run_settle(instance->run) ? failed(instance) : SAID_OK; }

size_t saved_size(const void *state) { return ((const Saved *)state)->size; }

enum Said save_state(Instance *instance, void **state) {
    if (instance->stage == MADE || instance->stage == INITIALISING) {
        enum Said said = begin(instance);
        if (said != SAID_OK) return said;
    }
    size_t size = sizeof(Saved) + run_state_size(instance->run);
    Saved *saved = *state;
    if (saved == NULL || saved->size != size) {
        saved = realloc(saved, size);
        if (saved == NULL) return refuse(instance, "get state", "there is no memory for it.");
        memset(saved, 0, size);
    }
    saved->stage = instance->stage;
    saved->size = size;
    run_save(instance->run, saved->bytes);
    *state = saved;
    return SAID_OK;
}

enum Said restore_state(Instance *instance, const void *state) {
    const Saved *saved = state;
    if (saved == NULL) return refuse(instance, "set state", "there is no state.");
    if (run_restore(instance->run, saved->bytes, saved->size - sizeof *saved))
        return refuse(instance, "set state", "it is not of this model, or there is no memory for it.");
    instance->stage = saved->stage;
    instance->begun_anew = 0;
    return SAID_OK;
}

enum Said write_state(Instance *instance, const void *state, unsigned char bytes[], size_t size) {
    if (state == NULL || size < saved_size(state)) return refuse(instance, "serialise", "there is no room for the state.");
    memcpy(bytes, state, saved_size(state));
    return SAID_OK;
}

enum Said read_state(Instance *instance, const unsigned char bytes[], size_t size, void **state) {
    Saved head;
    if (size < sizeof head) return refuse(instance, "deserialise", "these bytes are no state.");
    memcpy(&head, bytes, sizeof head);
    if (head.size != size || (unsigned)head.stage > TERMINATED)
        return refuse(instance, "deserialise", "these bytes are no state.");
    Saved *saved = malloc(size);
    if (saved == NULL) return refuse(instance, "deserialise", "there is no memory for it.");
    memcpy(saved, bytes, size);
    *state = saved;
    return SAID_OK;
}
