#include "ice/crowd.h"

enum { PAIRS_ALWAYS = 10000, PAIRS_A_FLOE = 30 };

int64_t crowd_most_pairs(int32_t floes) { return PAIRS_ALWAYS + (int64_t)PAIRS_A_FLOE * floes; }

fram_status crowd_refuse(const char *file, int32_t floes, fram_error *error)
{
    return error_set(
        error, FRAM_ERROR_INPUT, file, 0, NULL,
        "expected floes side by side, of which about 3 pairs for every floe lie close; found more than %lld "
        "pairs of %d floes that lie over one another: leave out all but one of those in one place",
        (long long)crowd_most_pairs(floes), (int)floes);
}
