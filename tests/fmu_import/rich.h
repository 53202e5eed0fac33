/* Models of FMI 3.0 with arrays, events and clocks, for the tests. Every call in a mode that the standard forbids fails. */
#ifndef RICH_H
#define RICH_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INSTANTIATED = 1, CONFIGURATION = 2, INITIALIZATION = 4, EVENT = 8, STEP = 16 };
enum { MOST = 64, TEXT = 64, CLOCKS = 8 };
/* References of clocks: 100 and on. */
enum { R, Q, P, G, D, TRIGGER, OUT, FOURTH };

typedef struct {
    char kind[16];
    int mode;
    bool events, early;
    double t, next;
    uint64_t n, m;                                        /* matrix: sizes */
    double u[MOST], w[MOST], y[MOST];
    int32_t k[2];
    bool b[2];
    char text[2][TEXT];
    double h, v, e, g;                                    /* ball */
    int32_t bounces, counter, updates, visits;
    bool touches;
    bool active[CLOCKS];                                  /* clocked */
    int32_t ticks[CLOCKS];
    double interval[CLOCKS], last[CLOCKS], due;
    bool told;
    double sampled, sum, total;
} Rich;

static int wrong(const char *format, ...) {
    va_list more;
    va_start(more, format);
    vfprintf(stderr, format, more);
    va_end(more);
    fprintf(stderr, "\n");
    fflush(stderr);
    return 3;
}

static Rich *rich(const char *kind, bool events, bool early) {
    Rich *m = calloc(1, sizeof *m);
    strncpy(m->kind, kind, sizeof m->kind - 1);
    m->mode = INSTANTIATED;
    m->events = events;
    m->early = early;
    m->n = 2; m->m = 3;
    for (int k = 0; k < MOST; k++) m->w[k] = 1;
    m->h = 1; m->e = 0.5; m->g = 10;
    m->counter = 1;
    m->next = strcmp(kind, "strict") ? 1 : 0.1;
    m->interval[R] = 0.25; m->interval[Q] = 0.5; m->interval[P] = 0.3; m->interval[G] = 0.1;
    if (!strcmp(kind, "lost")) m->interval[P] = NAN;
    m->last[R] = 0.1 - 0.25;                              /* its shift is 0.1 */
    m->last[Q] = -0.5; m->last[P] = 0.15 - 0.3; m->last[G] = 0;
    return m;
}

static bool is(const Rich *m, const char *kind) { return !strcmp(m->kind, kind); }

/* h' = v, v' = -g up to the ground, where the step ends; the bounce is in update(). */
static int fly(Rich *m, double step, double *done, bool *event) {
    if (m->touches) return wrong("it lies on the ground, and nobody handled that");
    double until = m->v == 0 && m->h == 0 && m->g == 0 ? INFINITY : (m->v + sqrt(m->v * m->v + 2 * m->g * m->h)) / m->g;
    *event = until <= step;
    *done = *event ? until : step;
    m->h += m->v * *done - m->g * *done * *done / 2;
    m->v -= m->g * *done;
    if (*event) { m->h = 0; m->touches = true; }
    return 0;
}

/* 0: done, 2: discarded, 3: error */
static int go(Rich *m, double t, double step, bool *event, double *done) {
    *event = false;
    *done = step;
    if (fabs(t - m->t) > 1e-12) return wrong("a step begins at %.17g, and it is at %.17g", t, m->t);
    if (is(m, "ball")) {
        int status = fly(m, step, done, event);
        if (status) return status;
    }
    if ((is(m, "stair") || is(m, "strict")) && t + step > m->next + 1e-9) return wrong("a step passes over the event at %.17g", m->next);
    if (is(m, "choosy") && step > 0.03) return 2;
    if (is(m, "choosy")) m->h *= exp(-step);
    if (is(m, "stands")) { *event = true; *done = 0; }
    if (is(m, "beyond")) { *event = true; *done = 2 * step; }
    m->t = t + *done;
    return 0;
}

static int tick(Rich *m, int one) {
    double expected = one == D ? m->due : m->last[one] + m->interval[one];
    if (one != TRIGGER && fabs(m->t - expected) > 1e-9)
        return wrong("clock %d ticks at %.17g, and %.17g is its time", one, m->t, expected);
    m->active[one] = true;
    m->ticks[one]++;
    m->last[one] = m->t;
    if (one == R) {
        m->active[OUT] = m->ticks[R] % 2 == 0;            /* every second one */
        m->active[FOURTH] = m->ticks[R] % 4 == 0;         /* of these every second one */
        m->due = m->t + 0.05;                             /* the countdown */
        m->told = false;
    }
    if (one == G) m->interval[G] += 0.1;
    return 0;
}

/* Discrete states; true where they need another update. */
static bool update(Rich *m) {
    m->updates++;
    if (is(m, "crash") && m->t > 0.15) { volatile int *nowhere = 0; *nowhere = 1; }
    if (is(m, "hang") && m->t > 0.15) for (;;) pause();
    if (m->active[R]) m->sum += m->sampled;
    memset(m->active, 0, sizeof m->active);
    if (is(m, "unsettled")) return true;
    if (is(m, "ball") && m->touches) {
        m->touches = false;
        m->v = -m->e * m->v;
        m->bounces++;
        if (m->v < 0.1) { m->v = 0; m->g = 0; }
        return true;
    }
    if (is(m, "stair") && m->t >= m->next - 1e-9) { m->counter++; m->next += 1; }
    if (is(m, "strict") && m->t >= m->next) { m->counter++; m->next += 0.1; }
    return false;
}

#endif
