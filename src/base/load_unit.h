/* Units in which pages and texts tell loads, powers and energies: by their size, so that those of a model are seen. */
#ifndef BASE_LOAD_UNIT_H
#define BASE_LOAD_UNIT_H

typedef struct load_unit {
    const char *name;
    double factor; /* of the number in N, W or J */
} load_unit;

/* N, kN or MN. */
load_unit load_unit_for(double newton);

/* What keeps to one unit at full size, whatever the size: kN, kJ, MW and GJ, and N, J, W and J (or kJ) of what is under
   1e4 N, J or W, but for nothing.  An energy in GJ goes with the power that it is of. */
load_unit kilonewtons_or_less(double newton);
load_unit kilojoules_or_less(double joule);
load_unit megawatts_or_less(double watt);
load_unit gigajoules_or_less(double joule, double watt);

#endif
