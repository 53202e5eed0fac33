/* What the exporter generates for one model: data (data.py) and constants (model.h, by header.py). */
#ifndef FAIRLEAD_IMAGE_H
#define FAIRLEAD_IMAGE_H

#include <stdint.h>

#define HIDDEN __attribute__((visibility("hidden")))

/* Addresses in memory: where, kind of target, target. */
enum { LINK_MEMORY, LINK_SHARED, LINK_FUNCTION };
typedef struct { int64_t at, kind, target; } Link;
/* Stretches of memory that are not zero before the start: where, how long, where their bytes begin. */
typedef struct { int64_t at, length, from; } Stretch;

/* Where a run ends, since no law says what follows: there sign * (recorded value) > most (analysis/record/ends.py). */
typedef struct { int column; double sign, most; const char *sentence; } End;

extern HIDDEN const Link fairlead_links[];
extern HIDDEN const Stretch fairlead_runs[];
extern HIDDEN const unsigned char fairlead_bytes[];
extern HIDDEN const unsigned char fairlead_shared[];

/* The loop: advance(address of the structs, trial steps at most) -> status. */
extern HIDDEN int64_t fairlead_advance(int64_t structs, int64_t attempts);

#endif
