/* The stiffness of a loaded edge, and what it stood on; see edge_give.h. */
#include "ice/edge_give.h"

#include "base/transcendental.h"
#include "ice/wedge.h"

#define TABLE_SELF edge_support_table
TABLE_DEFINE(edge_support, EDGE_SUPPORT_FIELDS)
#undef TABLE_SELF

/* Westergaard's thick-plate radius holds below this many thicknesses. */
static const double THICK_PLATE_LIMIT = 1.724;

/* Turns in which the water's mass follows the place of the largest moment: the last changes it by less than 1 %. */
enum { MASS_TURNS = 4 };

/* Turns in which the area under wedges and strip is shared by what each carries: C changes little with the area. */
enum { SHARING_TURNS = 4 };

double fracture_wedge_width(int32_t wedges) { return 2 * real_tan(PI / (2.0 * wedges)); }

double fracture_loaded_radius(double area, double share, double thickness, bool thick)
{
    double a = sqrt(area / share);
    if (thick && a < THICK_PLATE_LIMIT * thickness)
        return sqrt(1.6 * a * a + thickness * thickness) - 0.675 * thickness;
    return a;
}

int32_t edge_support_nearest(const edge_support_table *supports, const body_table *bodies, int32_t surface, vec3 place,
                             double reach)
{
    vec3 at = body_to_local(bodies, surface, place);
    double least = reach;
    int32_t best = -1;
    for (int32_t i = 0; i < supports->count; i++) {
        if (supports->surface[i] != surface || supports->generation[i] != bodies->generation[surface])
            continue;
        double way = vec3_length(vec3_sub(supports->place[i], at));
        if (way < least) {
            least = way;
            best = i;
        }
    }
    return best;
}

edge_stand edge_stand_find(const edge_support_table *supports, const body_table *bodies, int32_t surface, vec3 place,
                           double reach)
{
    int32_t best = edge_support_nearest(supports, bodies, surface, place, reach);
    if (best < 0)
        return EDGE_STAND_STRAIGHT;
    return (edge_stand){.wedges = supports->wedges[best],
                        .part = supports->part[best],
                        .strip = supports->strip[best],
                        .strip_bears = supports->strip_bears[best],
                        .impulse = supports->impulse[best],
                        .up = supports->rise[best],
                        .rise = edge_rise_time(supports->impulse[best], supports->load[best]),
                        .known = supports->known[best] != 0,
                        .over = supports->over[best] != 0};
}

double edge_reach(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area)
{
    double length = ice_characteristic_length(ice, thickness, e->water_density, e->gravity);
    double share = e->wedges * fracture_wedge_width(e->wedges) / 2;
    double radius = fracture_loaded_radius(horizontal_area, share, thickness, e->thick_plate_radius);
    return length * wedge_breaking_estimate(radius / length);
}

double edge_rise_time(double impulse, double load) { return load > 0 ? 2 * impulse / load : HUGE_VAL; }

wedge_ramp edge_rise(const edge_compliance *e, const ice_material *ice, double thickness, double radius, double time)
{
    wedge_ramp r = WEDGE_RAMP_STATIC;
    if (!e->inertia || !(time < HUGE_VAL))
        return r;
    double length = ice_characteristic_length(ice, thickness, e->water_density, e->gravity), a = radius / length;
    double water = e->water_density * 4 / PI * length * wedge_breaking_estimate(a);
    for (int turn = 0; turn < MASS_TURNS; turn++) {
        double mass = ice->density * thickness + water * r.place;
        r = wedge_ramp_at(a, time / sqrt(mass / (e->water_density * e->gravity)));
    }
    return r;
}

/* Of the ice of this part of N whole wedges [1]. */
static double wedges_width(const edge_compliance *e, double wedges)
{
    return e->wedges * fracture_wedge_width(e->wedges) * fmax(wedges, EDGE_LEAST_ICE);
}

double edge_stiffness(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                      edge_stand stand)
{
    double length = ice_characteristic_length(ice, thickness, e->water_density, e->gravity);
    double width = wedges_width(e, stand.wedges);
    double radius = fracture_loaded_radius(horizontal_area, width / 2, thickness, e->thick_plate_radius);
    double tip = wedge_tip_deflection(radius / length) * edge_rise(e, ice, thickness, radius, stand.rise).tip;
    return e->water_density * e->gravity * (length * length * width / tip + stand.strip);
}

/* Moment per width at the flexural strength [N]. */
static double strength_moment(const ice_material *ice, double thickness)
{
    return ice->flexural_strength * thickness * thickness / 6;
}

double edge_strip_bears(double width, double arm, double thickness)
{
    return thickness * thickness * width / (6 * arm);
}

edge_bearing edge_bears(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                        double wedges, double strip)
{
    double length = ice_characteristic_length(ice, thickness, e->water_density, e->gravity);
    double width = wedges_width(e, wedges), point = strength_moment(ice, thickness) * width;
    edge_bearing b = {0};
    /* Nevel's C is at least 1, and grows slowly with the area that the wedges stand on. */
    double part = strip > 0 ? point / (point + strip) : 1;
    for (int turn = 0; turn < (strip > 0 ? SHARING_TURNS : 1); turn++) {
        b.radius = fracture_loaded_radius(part * horizontal_area, width / 2, thickness, e->thick_plate_radius);
        wedge w = wedge_solve(b.radius / length);
        b.place = w.x_max;
        b.load = point * w.capacity + strip;
        part = point * w.capacity / b.load;
    }
    return b;
}

double edge_breaking_load(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                          edge_stand stand, double load)
{
    double strip = ice->flexural_strength * stand.strip_bears;
    double least = strength_moment(ice, thickness) * wedges_width(e, stand.wedges) + strip;
    if (load * WEDGE_RAMP_MOST_MOMENT < least)
        return HUGE_VAL;
    edge_bearing b = edge_bears(e, ice, thickness, horizontal_area, stand.wedges, strip);
    return b.load / edge_rise(e, ice, thickness, b.radius, stand.rise).moment;
}
