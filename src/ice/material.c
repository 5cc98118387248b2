/* Mechanical properties of sea ice; see material.h. */
#include "ice/material.h"

#include "base/transcendental.h"
#include "base/vec.h"

double ice_plate_stiffness(const ice_material *m, double thickness)
{
    double nu = m->poisson_ratio;
    return m->elastic_modulus * thickness * thickness * thickness / (12 * (1 - nu * nu));
}

double ice_characteristic_length(const ice_material *m, double thickness, double water_density, double gravity)
{
    /* The fourth root as two square roots: correctly rounded each, so that scaling by powers of 16 is exact. */
    return sqrt(sqrt(ice_plate_stiffness(m, thickness) / (water_density * gravity)));
}

double ice_ridging_line_load(double resistance, double thickness, double width)
{
    static const double newton_per_meganewton = 1e6, thickness_exponent = 1.25, width_exponent = -0.54;
    if (!(resistance > 0 && width > 0))
        return HUGE_VAL;
    return newton_per_meganewton * resistance * real_pow(thickness, thickness_exponent) *
           real_pow(width, width_exponent);
}

double ice_crushing_pressure(const ice_material *m, double area)
{
    if (m->crushing_exponent == 0)
        return m->crushing_strength;
    return area > 0 ? m->crushing_strength * real_pow(area, m->crushing_exponent) : 0;
}
