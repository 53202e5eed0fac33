/* See tuned.h. */
#include "tuned.h"
#include "model.h"

#include <math.h>
#include <string.h>

static double followed(const Follower *one, double p) {
    switch (one->law) {
    case LAW_LINEAR: return one->offset + one->slope * p;
    case LAW_INVERSE: return one->offset + one->slope * (1.0 / p);
    case LAW_SQUARE: return one->offset + one->slope * (p * p);
    case LAW_INVERSE_SQUARE: return one->offset + one->slope * (1.0 / (p * p));
    case LAW_ROOT: return one->offset + one->slope * sqrt(p);
    case LAW_INVERSE_ROOT: return one->offset + one->slope * (1.0 / sqrt(p));
    case LAW_THREE_HALVES: return one->offset + one->slope * (p * sqrt(p));
    case LAW_INVERSE_THREE_HALVES: return one->offset + one->slope * (1.0 / (p * sqrt(p)));
    case LAW_CUBE: return one->offset + one->slope * (p * p * p);
    case LAW_INVERSE_CUBE: return one->offset + one->slope * (1.0 / (p * p * p));
    case LAW_FOURTH: return one->offset + one->slope * (p * p * (p * p));
    case LAW_INVERSE_FOURTH: return one->offset + one->slope * (1.0 / (p * p * (p * p)));
    case LAW_SQUARED_LINE: {
        const double line = one->offset + one->slope * p;
        return line * line;
    }
    default: return 1.0 / (one->offset + one->slope * p);
    }
}

void tuned_apply(unsigned char *memory, const double values[]) {
    for (int64_t k = 0; k < N_FOLLOWERS; k++) {
        const Follower *one = &model_followers[k];
        const double value = followed(one, values[one->parameter]);
        memcpy(memory + one->at, &value, sizeof value);
    }
}

void kept_save(const unsigned char *memory, unsigned char *room) {
    for (int64_t k = 0; k < N_KEPT; room += model_kept[k++].length)
        memcpy(room, memory + model_kept[k].at, model_kept[k].length);
}

void kept_restore(unsigned char *memory, const unsigned char *room) {
    for (int64_t k = 0; k < N_KEPT; room += model_kept[k++].length)
        memcpy(memory + model_kept[k].at, room, model_kept[k].length);
}
