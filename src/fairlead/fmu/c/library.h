/* MODEL: a run that is stepped from outside. Made by fairlead VERSION.

   Numbers are in SI; inputs, outputs and parameters are numbered from zero (see the end of this file). Runs are independent of each
   other, and one run is used by one thread at a time. Functions that return an int return 0, or -1 where that could not
   be done; NAME_message then says why. */
#ifndef FAIRLEAD_NAME_H
#define FAIRLEAD_NAME_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct NAME NAME;

/* A new run before its start; NULL without memory for it. NAME_free ends it, NAME_reset takes it back to there. */
NAME *NAME_new(void);
void NAME_free(NAME *run);
void NAME_reset(NAME *run);

/* The time reached [s]. */
double NAME_time(const NAME *run);
/* Of a library made with run.real_time: steps so far that met the bound on their work, or were taken again. */
long long NAME_overruns(const NAME *run);
/* Set an input from here on: it takes effect at the beginning of the next advance, or from the start. */
int NAME_set(NAME *run, int input, double value);
/* Set a parameter that can be tuned, likewise; the run goes on with it from where it is. */
int NAME_tune(NAME *run, int parameter, double value);
/* Go on to the time `goal` [s]. With `until_change` it returns early after a step in which a zone changed; `changed`,
   which may be NULL, tells whether one did since the call began. Where a run fails it stays where it got to. */
int NAME_advance(NAME *run, double goal, int until_change, int *changed);
/* An output, or all of them, where the run is. */
int NAME_get(NAME *run, int output, double *value);
int NAME_outputs(NAME *run, double *values);
/* Why the last call that returned -1 did so; an empty text before. */
const char *NAME_message(const NAME *run);

/* Where a run is, in NAME_state_size(run) bytes, from which any run of this library can go on. They are read as they
   are: take none from anybody whom you would not give the machine. */
size_t NAME_state_size(NAME *run);
int NAME_save(NAME *run, unsigned char *state, size_t size);
int NAME_restore(NAME *run, const unsigned char *state, size_t size);

/* Names as in the netlist; NULL for a number that none has. */
const char *NAME_input_name(int input);
const char *NAME_output_name(int output);
const char *NAME_parameter_name(int parameter);

VARIABLES

#ifdef __cplusplus
}
#endif

#endif
