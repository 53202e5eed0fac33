/* A run of one model, stepped from outside: what fairlead's Model.start gives in Python, in C.

   Numbers are in SI. Runs are independent of each other; one run is used by one thread at a time. Inputs and outputs
   are numbered from zero in the order of the model description. */
#ifndef FAIRLEAD_RUN_H
#define FAIRLEAD_RUN_H

#include <stddef.h>

typedef struct Run Run;

/* A new run, before its start; NULL without memory for it. run_free ends it. */
Run *run_new(void);
void run_free(Run *run);
/* Back to before the start, inputs too. */
void run_reset(Run *run);

/* The time reached [s]. */
double run_time(const Run *run);
/* Made with run.real_time: steps so far that met the bound on their work, or were taken again. */
long long run_overruns(const Run *run);
/* Set an input from here on. It takes effect in the next run_settle or run_advance, or from the start. */
void run_set(Run *run, int input, double value);
/* An input as it was set last. */
double run_input(const Run *run, int input);
/* Set a parameter from here on, as inputs; NULL, or why it cannot be set to that. */
const char *run_tune(Run *run, int parameter, double value);
/* A parameter as it was set last. */
double run_parameter(const Run *run, int parameter);

/* These return 0, or -1 where the run cannot go on: run_message says why, and the run stays where it got to. */

/* Settle at the start, if that was not done. */
int run_begin(Run *run);
/* Settle where the run is, on what was set. */
int run_settle(Run *run);
/* Go on to `goal` [s], or until zones have changed if `until_change`; `changed` says whether they have. */
int run_advance(Run *run, double goal, int until_change, int *changed);
/* All outputs where the run is. */
int run_outputs(Run *run, double *values);
const char *run_message(const Run *run);
/* Say why something asked of the run is not done; -1. */
int run_refuse(Run *run, const char *why);

/* The state of a run that has begun, in run_state_size(run) bytes that any run of this library can go on from. */
size_t run_state_size(const Run *run);
void run_save(const Run *run, unsigned char *state);
/* -1 for bytes that are no state of this model, or without memory for it. */
int run_restore(Run *run, const unsigned char *state, size_t size);

#endif
