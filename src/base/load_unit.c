#include "base/load_unit.h"

#include "base/number_text.h"
#include "base/text.h"

#include <math.h>

/* Four digits of a number tell it then without a prefix [N], [W], [J]. */
#define TOLD_PLAIN 1e4

load_unit load_unit_for(double newton)
{
    if (newton >= 1e7)
        return (load_unit){"MN", 1e-6};
    return newton >= TOLD_PLAIN ? (load_unit){"kN", 1e-3} : (load_unit){"N", 1};
}

/* What is rounded up to the next unit is told in it, and nothing in that of full size. */
static load_unit unit_of_text(double newton, int digits)
{
    char rounded[NUMBER_TEXT_SIZE];
    real_to_digits(fabs(newton), digits, rounded);
    double size = strtod(rounded, NULL);
    return size > 0 ? load_unit_for(size) : (load_unit){"kN", 1e-3};
}

load_text load_text_of(double newton, int digits)
{
    load_text out;
    const load_unit unit = unit_of_text(newton, digits);
    snprintf(out.text, sizeof out.text, "%s %s", plain_text_of(newton * unit.factor, digits).text, unit.name);
    return out;
}

load_range_text load_range_text_of(double newton, double half, int digits)
{
    load_range_text out;
    const load_unit unit = unit_of_text(newton, digits);
    if (isfinite(half))
        snprintf(out.text, sizeof out.text, "%s +- %s %s", plain_text_of(newton * unit.factor, digits).text,
                 plain_text_of(half * unit.factor, digits - 1).text, unit.name);
    else
        snprintf(out.text, sizeof out.text, "%s", load_text_of(newton, digits).text);
    return out;
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
