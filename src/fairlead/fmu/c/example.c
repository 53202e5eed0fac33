/* Runs MODEL for STOP s, and prints its outputs every PERIOD s. In this folder:

   cc example.c -o example -L FOLDER -lNAME -Wl,-rpath,FOLDER && ./example */
#include "NAME.h"

#include <stdio.h>

int main(void) {
    double values[NAME_OUTPUTS];
    NAME *run = NAME_new();
    if (run == NULL) return 1;
    for (int k = 0; k <= STEPS; k++) {
        if (NAME_advance(run, PERIOD * k, 0, NULL) || NAME_outputs(run, values)) {
            fprintf(stderr, "%s\n", NAME_message(run));
            return 1;
        }
        printf("%g s", NAME_time(run));
        for (int j = 0; j < NAME_OUTPUTS; j++) printf("  %s %g", NAME_output_name(j), values[j]);
        printf("\n");
    }
    NAME_free(run);
    return 0;
}
