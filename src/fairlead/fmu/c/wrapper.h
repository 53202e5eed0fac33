/* What the wrappers for both versions of the standard have in common: an instance and the order of its calls. */
#ifndef FAIRLEAD_WRAPPER_H
#define FAIRLEAD_WRAPPER_H

#include "run.h"

enum Stage { MADE, INITIALISING, STEPPING, IN_EVENT, TERMINATED };
enum Said { SAID_OK, SAID_WARNING, SAID_DISCARD, SAID_ERROR, SAID_FATAL };

typedef struct Instance Instance;
/* How a wrapper tells its master something. */
typedef void (*Tell)(Instance *instance, enum Said said, const char *category, const char *text);

struct Instance {
    Run *run;
    enum Stage stage;
    int begun_anew; /* something was set while initialising, after the run had begun */
    int with_events; /* event mode is used */
    int early;      /* a zone change ends a step */
    double last;    /* the stop time that the master has defined, or infinity */
    char *name;
    int logging;
    Tell tell;
    void *environment, *callback;
};

typedef struct {
    enum Stage stage;
    size_t size; /* of all of it */
    unsigned char bytes[];
} Saved;

Instance *instance_new(const char *name, const char *token, Tell tell, void *environment, void *callback, int logging);
void instance_free(Instance *instance);
enum Said instance_reset(Instance *instance);

/* SAID_OK if the instance is in one of the stages (bits 1 << stage), else told as an error of the function. */
enum Said expect(Instance *instance, const char *function, unsigned stages);
enum Said refuse(Instance *instance, const char *function, const char *why);
/* A function of the standard that this FMU says it does not have. */
enum Said not_offered(Instance *instance, const char *function);

enum Said set_up(Instance *instance, double start, double last);
enum Said initialised(Instance *instance, enum Stage next);
/* Numbers by value reference: 0 is time, then inputs, then outputs, then parameters. */
enum Said get_reals(Instance *instance, const unsigned references[], size_t n, double values[], size_t room);
enum Said set_reals(Instance *instance, const unsigned references[], size_t n, const double values[], size_t given);
enum Said settle(Instance *instance);
enum Said do_step(Instance *instance, double now, double step, int *changed);

size_t saved_size(const void *state);
enum Said save_state(Instance *instance, void **state);
enum Said restore_state(Instance *instance, const void *state);
enum Said write_state(Instance *instance, const void *state, unsigned char bytes[], size_t size);
enum Said read_state(Instance *instance, const unsigned char bytes[], size_t size, void **state);

#endif
