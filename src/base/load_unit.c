#include "base/load_unit.h"

#include <stdbool.h>

/* Four digits of a number tell it then without a prefix [N], [W], [J]. */
#define TOLD_PLAIN 1e4

load_unit load_unit_for(double newton)
{
    if (newton >= 1e7)
        return (load_unit){"MN", 1e-6};
    return newton >= TOLD_PLAIN ? (load_unit){"kN", 1e-3} : (load_unit){"N", 1};
}

static bool is_small(double size) { return size > 0 && size < TOLD_PLAIN; }

load_unit kilonewtons_or_less(double newton)
{
    return is_small(newton) ? (load_unit){"N", 1} : (load_unit){"kN", 1e-3};
}

load_unit kilojoules_or_less(double joule) { return is_small(joule) ? (load_unit){"J", 1} : (load_unit){"kJ", 1e-3}; }

load_unit megawatts_or_less(double watt) { return is_small(watt) ? (load_unit){"W", 1} : (load_unit){"MW", 1e-6}; }

load_unit gigajoules_or_less(double joule, double watt)
{
    if (!is_small(watt))
        return (load_unit){"GJ", 1e-9};
    return joule < TOLD_PLAIN ? (load_unit){"J", 1} : (load_unit){"kJ", 1e-3};
}
