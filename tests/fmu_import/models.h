/* Small models for the tests of foreign FMUs: numbers, whole numbers, truths and one text, by value reference. */
#ifndef MODELS_H
#define MODELS_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIZE = 32, TEXT = 128 };

typedef struct {
    char kind[16];
    double number[SIZE];
    int64_t whole[SIZE];
    int truth[SIZE];
    char text[TEXT];
    double reached; /* in a step that was discarded */
} Model;

/* The kind is the token in the description. */
static Model *make(const char *kind) {
    Model *m = calloc(1, sizeof *m);
    strncpy(m->kind, kind, sizeof m->kind - 1);
    if (!strcmp(kind, "decay")) { m->number[0] = 1.0; m->number[1] = 1.0; }
    if (!strcmp(kind, "choosy")) m->number[0] = 1.0;
    if (!strcmp(kind, "ball")) { m->number[0] = 1.0; m->number[1] = 0.0; m->number[2] = 0.5; m->number[3] = 10.0; }
    return m;
}

/* h' = v, v' = -g; v becomes -e v where h = 0: parabolas, one after the other. */
static void fall(Model *m, double step) {
    double *h = &m->number[0], *v = &m->number[1], e = m->number[2], g = m->number[3];
    for (;;) {
        double until = (*v + sqrt(*v * *v + 2 * g * *h)) / g;
        if (until > step) break;
        *v = -e * (*v - g * until);
        *h = 0;
        m->whole[0]++;
        step -= until;
    }
    *h += *v * step - g * step * step / 2;
    *v -= g * step;
}

/* 0: done, 2: discarded after a part of it, 3: error */
static int run(Model *m, double t, double step) {
    if (!strcmp(m->kind, "choosy")) {
        double part = step > 0.03 ? 0.02 : step;
        m->number[0] *= exp(-part);
        m->reached = t + part;
        return part < step ? 2 : 0;
    }
    if (!strcmp(m->kind, "decay")) m->number[0] *= exp(-m->number[1] * step);
    if (!strcmp(m->kind, "ball")) fall(m, step);
    if (!strcmp(m->kind, "counter")) { m->whole[0]++; m->truth[0] = !m->truth[0]; m->number[0] = t; m->number[1] = step; }
    if (!strcmp(m->kind, "talks")) { printf("{\"outputs\": [666]}\n"); fflush(stdout); m->number[0] += 1; }
    if (t < 0.045) return 0;
    if (!strcmp(m->kind, "crash")) { volatile int *nowhere = 0; *nowhere = 1; }
    if (!strcmp(m->kind, "leave")) { fprintf(stderr, "no licence\n"); exit(3); }
    if (!strcmp(m->kind, "scold")) { fprintf(stderr, "no licence\n"); return 3; }
    if (!strcmp(m->kind, "hang")) for (;;) pause();
    if (!strcmp(m->kind, "nan")) m->number[0] = sqrt(-1.0);
    if (!strcmp(m->kind, "error")) return 3;
    return 0;
}

/* Outputs that follow inputs at once: 0 to 15 are inputs, 16 to 31 outputs. */
static void follow(Model *m) {
    if (strcmp(m->kind, "feed")) return;
    for (int k = 0; k < SIZE / 2; k++) {
        m->number[k + SIZE / 2] = m->number[k];
        m->whole[k + SIZE / 2] = m->whole[k];
        m->truth[k + SIZE / 2] = m->truth[k];
    }
    m->whole[SIZE - 1] = (int64_t)strlen(m->text);
}

#endif
