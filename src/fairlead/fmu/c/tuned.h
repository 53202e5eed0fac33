/* Parameters that can be set while a run goes on (fairlead/fmu/tuned.py). */
#ifndef FAIRLEAD_TUNED_H
#define FAIRLEAD_TUNED_H

#include <stdint.h>

/* A number of memory that follows a parameter. */
enum {
    LAW_LINEAR, LAW_INVERSE, LAW_SQUARE, LAW_INVERSE_SQUARE, LAW_ROOT, LAW_INVERSE_ROOT, LAW_THREE_HALVES,
    LAW_INVERSE_THREE_HALVES, LAW_CUBE, LAW_INVERSE_CUBE, LAW_FOURTH, LAW_INVERSE_FOURTH, LAW_SQUARED_LINE,
    LAW_RECIPROCAL
};
typedef struct { int64_t at; int parameter, law; double offset, slope; } Follower;

/* When a parameter can be set: until the start, from then on, or always. */
enum { WHEN_BEFORE, WHEN_AFTER, WHEN_ALWAYS };
typedef struct { const char *name; double value, low, high; int when; } Parameter;

/* Stretches of memory that a run goes on with: where, how long. */
typedef struct { int64_t at, length; } Kept;

/* Work out all numbers that follow these values. */
void tuned_apply(unsigned char *memory, const double values[]);
/* Copy what a run goes on with out of its memory, and back; KEPT_BYTES. */
void kept_save(const unsigned char *memory, unsigned char *room);
void kept_restore(unsigned char *memory, const unsigned char *room);

#endif
