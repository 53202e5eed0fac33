/* See pivots.h. Rows are exchanged where the planned one is small beside another (threshold pivoting), columns stay.
   The matrix is full while that is worked out: it happens once or twice in a run, and most factors are zero. */
#include "pivots.h"
#include "image.h"
#include "model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TRUSTED = 0.1; /* of the largest of a column: a planned pivot that stays */
static const double VANISHES = 1e-14; /* of what a pivot is the difference of, as in replan.py */

static int64_t number(const unsigned char *memory, int64_t at) { return *(const int64_t *)(memory + at); }
static const int64_t *whole_at(const unsigned char *memory, int64_t at) { return (const int64_t *)(intptr_t)number(memory, at); }
static const double *reals_at(const unsigned char *memory, int64_t at) { return (const double *)(intptr_t)number(memory, at); }

/* Lengths of the arrays in `words`. */
static void lengths(const unsigned char *memory, int64_t n_lower, int64_t n_upper, int64_t length[N_REPLACED]) {
    int64_t n = number(memory, AT_N), reduced = number(memory, AT_N_REDUCED), matrix = number(memory, AT_N_MATRIX);
    const int64_t known[N_REPLACED] = {reduced, n, matrix, reduced + 1, n_lower, reduced + 1,
                                       n_upper, reduced + 1, n_upper, n_lower, n_upper};
    memcpy(length, known, sizeof known);
}

/* The scaled matrix, row by row; 0 where it has something that is no finite number. */
static int spread(const unsigned char *memory, int64_t n, double *a) {
    const int64_t *starts = whole_at(memory, AT_AT_MATRIX_STARTS), *rows = whole_at(memory, AT_AT_MATRIX_ROWS);
    const int64_t *order = whole_at(memory, AT_AT_COLUMN_ORDER);
    const double *values = reals_at(memory, AT_AT_MATRIX), *row_scale = reals_at(memory, AT_AT_ROW_SCALE);
    const double *column_scale = reals_at(memory, AT_AT_COLUMN_SCALE);
    for (int64_t k = 0; k < n; k++)
        for (int64_t p = starts[k]; p < starts[k + 1]; p++) {
            double value = values[p] * row_scale[rows[p]] * column_scale[order[k]];
            if (!isfinite(value)) return 0;
            a[rows[p] * n + k] = value;
        }
    return 1;
}

/* taken[k]: the row that is the k-th pivot; 0 where the matrix is singular. In place, L and U of these rows. */
static int eliminate(int64_t n, double *a, int64_t *taken, char *used) {
    for (int64_t k = 0; k < n; k++) {
        int64_t best = -1;
        double largest = 0.0;
        for (int64_t i = 0; i < n; i++)
            if (!used[i] && fabs(a[i * n + k]) > largest) {
                largest = fabs(a[i * n + k]);
                best = i;
            }
        if (best < 0) return 0;
        if (!used[k] && fabs(a[k * n + k]) >= TRUSTED * largest) best = k;
        double terms = fabs(a[best * n + k]);
        for (int64_t j = 0; j < k; j++) terms += fabs(a[best * n + j] * a[taken[j] * n + k]);
        if (!(fabs(a[best * n + k]) > VANISHES * terms)) return 0;
        taken[k] = best;
        used[best] = 1;
        for (int64_t i = 0; i < n; i++) {
            if (used[i] || a[i * n + k] == 0.0) continue;
            double factor = a[i * n + k] /= a[best * n + k];
            for (int64_t j = k + 1; j < n; j++)
                if (a[best * n + j] != 0.0) a[i * n + j] -= factor * a[best * n + j];
        }
    }
    return 1;
}

/* in[i * n + j]: 1 where L or U has an entry, whatever the numbers are; how many L and U have off the diagonal. */
static void fill_in(int64_t n, char *in, int64_t *n_lower, int64_t *n_upper) {
    for (int64_t k = 0; k < n; k++)
        for (int64_t i = k + 1; i < n; i++)
            if (in[i * n + k])
                for (int64_t j = k + 1; j < n; j++) in[i * n + j] |= in[k * n + j];
    *n_lower = *n_upper = 0;
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = 0; j < n; j++)
            if (in[i * n + j]) *(i > j ? n_lower : n_upper) += i != j;
}

/* Patterns of L, of U, and of U by rows. */
static void write_patterns(int64_t n, const char *in, int64_t *const at[N_REPLACED]) {
    int64_t lower = 0, upper = 0, using = 0;
    for (int64_t k = 0; k < n; k++) {
        at[LOWER_STARTS][k] = lower;
        at[UPPER_STARTS][k] = upper;
        at[USING_STARTS][k] = using;
        for (int64_t i = 0; i < k; i++)
            if (in[i * n + k]) at[UPPER_ROWS][upper++] = i;
        for (int64_t i = k + 1; i < n; i++) {
            if (in[i * n + k]) at[LOWER_ROWS][lower++] = i;
            if (in[k * n + i]) at[USING_COLUMNS][using++] = i;
        }
    }
    at[LOWER_STARTS][n] = lower;
    at[UPPER_STARTS][n] = upper;
    at[USING_STARTS][n] = using;
}

static void places(const unsigned char *memory, Pivots *pivots, int64_t *at[N_REPLACED]) {
    int64_t length[N_REPLACED], *next = pivots->words;
    lengths(memory, pivots->n_lower, pivots->n_upper, length);
    for (int k = 0; k < N_REPLACED; k++) {
        at[k] = next;
        next += length[k];
    }
}

size_t pivots_bytes(const unsigned char *memory, int64_t n_lower, int64_t n_upper) {
    int64_t length[N_REPLACED], sum = 0;
    lengths(memory, n_lower, n_upper, length);
    for (int k = 0; k < N_REPLACED; k++) sum += length[k];
    return sizeof(Pivots) + 8 * sum;
}

/* The plan with these rows as pivots. */
static Pivots *planned(const unsigned char *memory, int64_t n, const int64_t *taken, int64_t *place, char *in) {
    const int64_t *starts = whole_at(memory, AT_AT_MATRIX_STARTS), *rows = whole_at(memory, AT_AT_MATRIX_ROWS);
    const int64_t *order = whole_at(memory, AT_AT_ROW_ORDER);
    int64_t n_lower, n_upper, *at[N_REPLACED];
    for (int64_t k = 0; k < n; k++) place[taken[k]] = k;
    for (int64_t k = 0; k < n; k++)
        for (int64_t p = starts[k]; p < starts[k + 1]; p++) in[place[rows[p]] * n + k] = 1;
    fill_in(n, in, &n_lower, &n_upper);
    Pivots *made = calloc(1, pivots_bytes(memory, n_lower, n_upper));
    if (made == NULL) return NULL;
    made->n_lower = n_lower;
    made->n_upper = n_upper;
    places(memory, made, at);
    for (int64_t k = 0; k < number(memory, AT_N); k++) at[ROW_PLACE][k] = -1;
    for (int64_t k = 0; k < n; k++) {
        at[ROW_ORDER][k] = order[taken[k]];
        at[ROW_PLACE][order[taken[k]]] = k;
    }
    for (int64_t p = 0; p < starts[n]; p++) at[MATRIX_ROWS][p] = place[rows[p]];
    write_patterns(n, in, at);
    return made;
}

enum Found pivots_choose(const unsigned char *memory, Pivots **found) {
    int64_t n = number(memory, AT_N_REDUCED);
    double *a = calloc(n * n, sizeof *a);
    char *used = calloc(n, 1), *in = calloc(n * n, 1);
    int64_t *taken = calloc(n, sizeof *taken), *place = calloc(n, sizeof *place);
    enum Found said = PIVOTS_NO_ROOM;
    if (a != NULL && used != NULL && in != NULL && taken != NULL && place != NULL) {
        said = PIVOTS_SINGULAR;
        if (spread(memory, n, a) && eliminate(n, a, taken, used)) {
            *found = planned(memory, n, taken, place, in);
            said = *found == NULL ? PIVOTS_NO_ROOM : PIVOTS_FOUND;
        }
    }
    free(a), free(used), free(in), free(taken), free(place);
    return said;
}

void pivots_link(unsigned char *memory, Pivots *pivots) {
    int64_t *at[N_REPLACED];
    places(memory, pivots, at);
    for (size_t k = 0; k < sizeof model_replaced / sizeof *model_replaced; k++)
        *(int64_t *)(memory + model_replaced[k][1]) = (int64_t)(intptr_t)at[model_replaced[k][0]];
}
