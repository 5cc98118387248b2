/* Mechanical properties of sea ice; see material.h. */
#include "ice/material.h"

#include "base/transcendental.h"
#include "base/vec.h"

#include <stdbool.h>

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

static double strip_length(const ice_material *m, double thickness, double water_weight)
{
    return sqrt(2) * ice_characteristic_length(m, thickness, water_weight, 1);
}

static bool breaks_under(const ice_material *m, double thickness, double end_load, double length)
{
    static const double largest_moment = 0.3223969419448344; /* exp(-pi/4) sin(pi/4), of end_load * length */
    return 6 * largest_moment * end_load * length > m->flexural_strength * thickness * thickness;
}

double ice_rafting_lift(const ice_material *a, double thickness_a, const ice_material *b, double thickness_b,
                        double water_weight)
{
    double length_a = strip_length(a, thickness_a, water_weight), length_b = strip_length(b, thickness_b, water_weight);
    double apart = 0.5 * (thickness_a + thickness_b);
    double lift = 0.5 * water_weight * apart / (1 / length_a + 1 / length_b);
    bool breaks = breaks_under(a, thickness_a, lift, length_a) || breaks_under(b, thickness_b, lift, length_b);
    return breaks ? HUGE_VAL : lift;
}

double ice_crushing_pressure(const ice_material *m, double area)
{
    if (m->crushing_exponent == 0)
        return m->crushing_strength;
    return area > 0 ? m->crushing_strength * real_pow(area, m->crushing_exponent) : 0;
}
