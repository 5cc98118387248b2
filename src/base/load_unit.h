/* Units in which pages and texts tell loads, powers and energies: by their size, so that those of a model are seen. */
#ifndef BASE_LOAD_UNIT_H
#define BASE_LOAD_UNIT_H

typedef struct load_unit {
    const char *name;
    double factor; /* of the number in N, W or J */
} load_unit;

/* N, kN or MN: the rule of every load that is told, by its size, rounded as it is told to four digits; nothing is in
   kN.  Columns, tables and axes are in that of their largest. */
load_unit load_unit_for(double newton);
/* W, kW or MW by the same rule, and J, kJ, MJ or GJ with a further step at 1e10 J. */
load_unit power_unit_for(double watt);
load_unit energy_unit_for(double joule);

/* A load with its unit, "9.64 N", "-739 kN", "26.1 MN", to so many significant digits and without an exponent
   (plain_text_of); nothing is "0 kN". */
enum { LOAD_TEXT_SIZE = 48 };
typedef struct load_text {
    char text[LOAD_TEXT_SIZE];
} load_text;
load_text load_text_of(double newton, int digits);
/* The same of a load and half its interval, in one unit: "739 +- 169 kN"; half: NaN without an interval.  largest: of
   the loads of its column, whose unit it has ("0.003 MN"); NaN: it has that of the larger one of its own. */
typedef struct load_range_text {
    char text[2 * LOAD_TEXT_SIZE];
} load_range_text;
load_range_text load_range_text_of(double newton, double half, double largest, int digits);

/* Of columns that are to keep to one unit at full size, whatever the size, as programs read them: kN, kJ and MW, and N,
   J and W of what is under 1e4 N, J or W, but for nothing. */
load_unit kilonewtons_or_less(double newton);
load_unit kilojoules_or_less(double joule);
load_unit megawatts_or_less(double watt);

#endif
