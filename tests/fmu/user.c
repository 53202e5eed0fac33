/* A program that uses every call of a library of `pushed` (exported.py): 5 N of friction on 2 kg, a pull as the input.
   It prints what it reads, a line each. */
#include "pushed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MUST(call) if (call) return fprintf(stderr, #call ": %s\n", pushed_message(run)), 1

int main(void) {
    double speed, all[pushed_OUTPUTS];
    int changed;
    pushed *run = pushed_new(), *other = pushed_new();
    if (run == NULL || other == NULL) return 1;
    printf("%s %s\n", pushed_input_name(pushed_INPUT_pull), pushed_output_name(pushed_OUTPUT_speed));
    printf("%d %d\n", pushed_input_name(-1) == NULL, pushed_output_name(pushed_OUTPUTS) == NULL);

    MUST(pushed_set(run, pushed_INPUT_pull, 9.0));
    MUST(pushed_advance(run, 0.1, 0, NULL));
    MUST(pushed_get(run, pushed_OUTPUT_speed, &speed));
    printf("%a %a\n", pushed_time(run), speed);

    size_t size = pushed_state_size(run);
    unsigned char *state = malloc(size);
    MUST(pushed_save(run, state, size));
    MUST(pushed_set(run, pushed_INPUT_pull, 0.0));
    MUST(pushed_advance(run, 0.5, 1, &changed));
    printf("%d %a\n", changed, pushed_time(run));
    MUST(pushed_restore(other, state, size));
    MUST(pushed_set(other, pushed_INPUT_pull, 5.0));
    MUST(pushed_advance(other, 0.2, 0, &changed));
    MUST(pushed_outputs(other, all));
    printf("%d %a %a\n", changed, pushed_time(other), all[pushed_OUTPUT_speed]);

    if (pushed_advance(run, 0.01, 0, NULL) != -1) return 1;
    printf("%s\n", pushed_message(run));
    if (pushed_set(run, 7, 1.0) != -1) return 1;
    printf("%s\n", pushed_message(run));
    if (pushed_set(run, 0, NAN) != -1) return 1;
    printf("%s\n", pushed_message(run));
    if (pushed_get(run, 7, &speed) != -1) return 1;
    printf("%s\n", pushed_message(run));
    if (pushed_save(run, state, size - 1) != -1) return 1;
    printf("%s\n", pushed_message(run));
    memset(state, 1, size);
    if (pushed_restore(run, state, size) != -1) return 1;
    printf("%s\n", pushed_message(run));

    pushed_reset(run);
    printf("%a\n", pushed_time(run));
    pushed_free(run);
    pushed_free(other);
    free(state);
    return 0;
}
