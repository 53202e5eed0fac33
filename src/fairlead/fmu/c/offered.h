/* What a library offers to programs; all else in it stays its own. */
#ifndef FAIRLEAD_OFFERED_H
#define FAIRLEAD_OFFERED_H

#ifdef _WIN32
#define OFFERED __declspec(dllexport)
#else
#define OFFERED __attribute__((visibility("default")))
#endif

#endif
