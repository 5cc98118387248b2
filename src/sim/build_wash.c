#include "sim/build_wash.h"

#include "base/transcendental.h"
#include "sim/build_station.h"

#include <math.h>

/* Where no diameter is given: largest thrust over the area of the propeller's disc at full scale [Pa]; pressures go
   with size.  By momentum theory the power of 160 N for each kilowatt, which is usual (sim/build_station.c), goes with
   it at a figure of merit of 0.75: T / P = 0.75 * 2 / U0 and U0 = sqrt(2 T / (rho A)). */
static const double DISC_LOAD = 45e3;
/* Axes of propellers: apart, in diameters; under the waterline, in draughts. */
static const double SPACING = 1.5, DEPTH = 0.6;

static double diameter_of(double given, double thrust, double size)
{
    return automatic_or(given, sqrt(4 * thrust / (PI * DISC_LOAD * size)));
}

wash_model build_wash(const scenario *s, const scenario_vessel *keys, const vessel_model *hull)
{
    double size = scenario_size(s);
    const scenario_propulsion *p = &keys->propulsion;
    wash_model out = {.active = keys->wash.active, .spread = keys->wash.spread, .reach = keys->wash.reach};
    for (int32_t i = 0; i < keys->thrusters.count && i < VESSEL_THRUSTERS_MOST; i++) {
        const scenario_thruster *t = &keys->thrusters.data[i];
        out.thruster[i] = diameter_of(t->diameter, thruster_largest_thrust(t), size);
    }
    if (!vessel_drives_itself(keys))
        return out;
    out.propellers = (int32_t)p->propellers;
    out.diameter = diameter_of(p->propeller_diameter, p->bollard_pull / (double)p->propellers, size);
    out.spacing = automatic_or(p->propeller_spacing, SPACING * out.diameter);
    out.z = automatic_or(p->propeller_z, -DEPTH * hull->particulars.draught) - hull->centre.z;
    return out;
}
