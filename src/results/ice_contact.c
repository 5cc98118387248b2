#include "results/ice_contact.h"

#include <math.h>

ice_contact ice_contact_of(const double *time, const double *load, int32_t count)
{
    ice_contact c = {.last = HUGE_VAL};
    for (int32_t i = 0; i < count; i++) {
        if (load[i] == 0)
            continue;
        if (c.last < HUGE_VAL)
            c.longest = fmax(c.longest, time[i] - c.last);
        c.last = time[i];
    }
    c.quiet = c.last < HUGE_VAL ? time[count - 1] - c.last : 0;
    return c;
}
