/* The calls of library.h: those of run.h under the name of the model, with their arguments looked at. */
#include "model.h"
#include "offered.h"
#include "run.h"

#include <math.h>
#include <stdio.h>

#define JOIN(prefix, name) prefix##_##name
#define JOINED(prefix, name) JOIN(prefix, name)
#define OF_MODEL(name) JOINED(MODEL_PREFIX, name)

OFFERED Run *OF_MODEL(new)(void) { return run_new(); }
OFFERED void OF_MODEL(free)(Run *run) { run_free(run); }
OFFERED void OF_MODEL(reset)(Run *run) { run_reset(run); }
OFFERED double OF_MODEL(time)(const Run *run) { return run_time(run); }
OFFERED long long OF_MODEL(overruns)(const Run *run) { return run_overruns(run); }
OFFERED const char *OF_MODEL(message)(const Run *run) { return run_message(run); }

OFFERED int OF_MODEL(set)(Run *run, int input, double value) {
    if (input < 0 || input >= N_INPUTS) return run_refuse(run, "set: there is no input of this number.");
    if (!isfinite(value)) return run_refuse(run, "set: the value is not a finite number.");
    run_set(run, input, value);
    return 0;
}

OFFERED int OF_MODEL(tune)(Run *run, int parameter, double value) {
    if (parameter < 0 || parameter >= N_TUNED) return run_refuse(run, "tune: there is no parameter of this number.");
    const Parameter *one = &model_parameters[parameter];
    const char *why = isfinite(value) ? run_tune(run, parameter, value) : "is no number";
    char text[400];
    if (why == NULL) return 0;
    snprintf(text, sizeof text, "tune: %s = %.9g %s. It can be set from %.9g to %.9g.", one->name, value, why, one->low, one->high);
    return run_refuse(run, text);
}

OFFERED int OF_MODEL(advance)(Run *run, double goal, int until_change, int *changed) {
    int any = 0;
    if (!isfinite(goal)) return run_refuse(run, "advance: the time is not a finite number.");
    if (goal < run_time(run)) return run_refuse(run, "advance: the run is beyond this time already.");
    int said = run_advance(run, goal, until_change, &any);
    if (changed != NULL) *changed = any;
    return said;
}

OFFERED int OF_MODEL(outputs)(Run *run, double *values) { return run_outputs(run, values); }

OFFERED int OF_MODEL(get)(Run *run, int output, double *value) {
    double all[N_OUTPUTS + 1];
    if (output < 0 || output >= N_OUTPUTS) return run_refuse(run, "get: there is no output of this number.");
    if (run_outputs(run, all)) return -1;
    *value = all[output];
    return 0;
}

OFFERED size_t OF_MODEL(state_size)(Run *run) {
    run_begin(run);
    return run_state_size(run);
}

OFFERED int OF_MODEL(save)(Run *run, unsigned char *state, size_t size) {
    if (run_begin(run)) return -1;
    if (size < run_state_size(run)) return run_refuse(run, "save: there is no room for the state.");
    run_save(run, state);
    return 0;
}

OFFERED int OF_MODEL(restore)(Run *run, const unsigned char *state, size_t size) {
    if (run_restore(run, state, size))
        return run_refuse(run, "restore: these bytes are no state of this model, or there is no memory for it.");
    return 0;
}

OFFERED const char *OF_MODEL(input_name)(int input) {
    return input >= 0 && input < N_INPUTS ? model_inputs[input] : NULL;
}
OFFERED const char *OF_MODEL(parameter_name)(int parameter) {
    return parameter >= 0 && parameter < N_TUNED ? model_parameters[parameter].name : NULL;
}
OFFERED const char *OF_MODEL(output_name)(int output) {
    return output >= 0 && output < N_OUTPUTS ? model_outputs[output] : NULL;
}
