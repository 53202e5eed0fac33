/* A master for one FMU of version 3 without inputs: it compiles against the headers of the standard, and links no Python.

   master LIBRARY TOKEN H STEPS OUTPUTS INSTANCES
   prints the outputs of all instances after every step in hexadecimal, one line each, and the size of the process [kB]
   before the first and after the last step (0 on Windows). */
#include "fmi3Functions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(file) LoadLibraryA(file)
#define SYMBOL(library, name) GetProcAddress(library, name)
typedef HMODULE Library;
static const char *why(void) { return "the library cannot be loaded"; }
static long kilobytes(void) { return 0; }
#else
#include <dlfcn.h>
#include <sys/resource.h>
#define OPEN(file) dlopen(file, RTLD_NOW | RTLD_LOCAL)
#define SYMBOL(library, name) dlsym(library, name)
typedef void *Library;
static const char *why(void) { return dlerror(); }
static long kilobytes(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
}
#endif

static void complain(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String text) {
    (void)e;
    fprintf(stderr, "%d %s: %s\n", status, category, text);
}

#define FIND(name) name##TYPE *name = (name##TYPE *)SYMBOL(library, #name)
#define MUST(call) if ((call) != fmi3OK) return fprintf(stderr, "failed: " #call "\n"), 1

int main(int argc, char *argv[]) {
    if (argc != 7) return 2;
    Library library = OPEN(argv[1]);
    if (library == NULL) return fprintf(stderr, "%s\n", why()), 1;
    FIND(fmi3InstantiateCoSimulation);
    FIND(fmi3EnterInitializationMode);
    FIND(fmi3ExitInitializationMode);
    FIND(fmi3DoStep);
    FIND(fmi3GetFloat64);
    FIND(fmi3FreeInstance);
    double h = atof(argv[3]);
    int steps = atoi(argv[4]), outputs = atoi(argv[5]), count = atoi(argv[6]);
    fmi3ValueReference references[64];
    for (int k = 0; k < outputs; k++) references[k] = k + 1;
    fmi3Instance *instances = calloc(count, sizeof *instances);
    for (int i = 0; i < count; i++) {
        instances[i] = fmi3InstantiateCoSimulation("one", argv[2], "", 0, 0, 0, 0, NULL, 0, NULL, complain, NULL);
        if (instances[i] == NULL) return 1;
        MUST(fmi3EnterInitializationMode(instances[i], 0, 0.0, 0.0, 0, 0.0));
        MUST(fmi3ExitInitializationMode(instances[i]));
    }
    long before = 0;
    double t = 0.0;
    for (int k = 0; k < steps; k++) {
        if (k == steps / 10) before = kilobytes();
        for (int i = 0; i < count; i++) {
            fmi3Boolean event, end, early;
            double reached, values[64], first[64];
            MUST(fmi3DoStep(instances[i], t, h, 0, &event, &end, &early, &reached));
            MUST(fmi3GetFloat64(instances[i], references, outputs, values, outputs));
            if (i == 0) {
                memcpy(first, values, sizeof first);
                for (int j = 0; j < outputs; j++) printf("%a ", values[j]);
                printf("\n");
            } else if (memcmp(first, values, outputs * sizeof *values)) {
                return fprintf(stderr, "instance %d differs from the first one\n", i), 1;
            }
        }
        t += h;
    }
    printf("%ld %ld\n", before, kilobytes());
    for (int i = 0; i < count; i++) fmi3FreeInstance(instances[i]);
    return 0;
}
