#include "base/load_unit.h"

#include "base/number_text.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Four digits of a number tell it then without a prefix [N], [W], [J]. */
#define TOLD_PLAIN 1e4

/* Of columns and axes. */
enum { LOAD_DIGITS = 4 };

static bool is_small(double size) { return size > 0 && size < TOLD_PLAIN; }

/* What is rounded up to the next unit is told in it, and nothing in that of full size. */
static load_unit unit_of_text(double load, int digits)
{
    char rounded[NUMBER_TEXT_SIZE];
    real_to_digits(fabs(load), digits, rounded);
    double newton = strtod(rounded, NULL);
    if (newton >= 1e7)
        return (load_unit){"MN", 1e-6};
    return is_small(newton) ? (load_unit){"N", 1} : (load_unit){"kN", 1e-3};
}

load_unit load_unit_for(double newton) { return unit_of_text(newton, LOAD_DIGITS); }

load_unit power_unit_for(double watt)
{
    load_unit unit = load_unit_for(watt);
    unit.name = unit.factor < 1e-3 ? "MW" : unit.factor < 1 ? "kW" : "W";
    return unit;
}

load_unit energy_unit_for(double joule)
{
    load_unit unit = load_unit_for(joule);
    unit.name = unit.factor < 1e-3 ? "MJ" : unit.factor < 1 ? "kJ" : "J";
    const bool many = unit.factor < 1e-3 && load_unit_for(joule * unit.factor).factor < 1; /* megajoules */
    return many ? (load_unit){"GJ", 1e-9} : unit;
}

/* As plain_text_of; beside larger ones of its unit a small number has no exponent either. */
static plain_text number_beside(double value, int digits)
{
    enum { PLACES_MOST = 15 };
    plain_text out = plain_text_of(value, digits);
    const char *exponent = strchr(out.text, 'e');
    if (!exponent || fabs(value) >= 1)
        return out;
    int behind = (int)(exponent - out.text) - (value < 0) - 2; /* digits behind the point */
    int places = (behind > 0 ? behind : 0) - (int)strtol(exponent + 1, NULL, 10);
    snprintf(out.text, sizeof out.text, "%.*f", places < PLACES_MOST ? places : PLACES_MOST, value);
    return out;
}

load_text load_text_of(double newton, int digits)
{
    load_text out;
    const load_unit unit = unit_of_text(newton, digits);
    snprintf(out.text, sizeof out.text, "%s %s", plain_text_of(newton * unit.factor, digits).text, unit.name);
    return out;
}

load_range_text load_range_text_of(double newton, double half, double largest, int digits)
{
    load_range_text out;
    const load_unit unit = unit_of_text(isfinite(largest) ? largest : fmax(fabs(newton), half), digits);
    const plain_text load = number_beside(newton * unit.factor, digits);
    if (isfinite(half))
        snprintf(out.text, sizeof out.text, "%s +- %s %s", load.text,
                 number_beside(half * unit.factor, digits - 1).text, unit.name);
    else
        snprintf(out.text, sizeof out.text, "%s %s", load.text, unit.name);
    return out;
}

load_unit kilonewtons_or_less(double newton)
{
    const load_unit unit = load_unit_for(newton);
    return unit.factor < 1 ? (load_unit){"kN", 1e-3} : unit;
}

load_unit kilojoules_or_less(double joule) { return is_small(joule) ? (load_unit){"J", 1} : (load_unit){"kJ", 1e-3}; }

load_unit megawatts_or_less(double watt) { return is_small(watt) ? (load_unit){"W", 1} : (load_unit){"MW", 1e-6}; }
