/* Other pivots where the planned ones lose accuracy: what replan.py does in Python, with an order of its own. */
#ifndef FAIRLEAD_PIVOTS_H
#define FAIRLEAD_PIVOTS_H

#include <stddef.h>
#include <stdint.h>

/* Arrays of the plan that another order of rows changes, one after another behind their lengths; the order in which
   header.py lists where their addresses lie. */
enum { ROW_ORDER, ROW_PLACE, MATRIX_ROWS, LOWER_STARTS, LOWER_ROWS, UPPER_STARTS, UPPER_ROWS, USING_STARTS,
       USING_COLUMNS, LOWER, UPPER, N_REPLACED };

typedef struct {
    int64_t n_lower, n_upper;
    int64_t words[];
} Pivots;

enum Found { PIVOTS_FOUND, PIVOTS_SINGULAR, PIVOTS_NO_ROOM };

/* Choose rows for the matrix that could not be factorised, in the order of columns that there is. */
enum Found pivots_choose(const unsigned char *memory, Pivots **found);
/* Bytes of pivots with so many entries in L and U. */
size_t pivots_bytes(const unsigned char *memory, int64_t n_lower, int64_t n_upper);
/* Put these arrays in place of those of the plan. */
void pivots_link(unsigned char *memory, Pivots *pivots);

#endif
