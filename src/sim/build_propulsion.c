#include "sim/build_propulsion.h"

#include "base/transcendental.h"
#include "sim/turning.h"

#include <math.h>

/* Where nothing is given, parts of the length: thrust at the stern, the aim, the way back before a ram. */
static const double STERN = 0.45, LOOKAHEAD = 2.5, RAM = 1;
/* A leg is no shorter than this part of the length: a ship passes the corners of shorter ones in a step or two, and
   cannot tell on which side of them she is. */
static const double LEAST_LEG = 0.05;
/* Way points within this part of the length of where she starts are behind her: a leg there would turn her about. */
static const double AT_START = 0.5;

static double wanted_speed(const scenario_propulsion *p, double round)
{
    if (p->pattern.kind != PATTERN_NONE && !is_automatic(p->pattern.period))
        return round / p->pattern.period;
    return automatic_or(p->speed, HUGE_VAL);
}

static manoeuvring ship_of(const scenario *s, const vessel_model *hull, const world *w, int32_t body)
{
    const hull_particulars *h = &hull->particulars;
    manoeuvring out = {.mass = w->bodies.mass[body], .inertia = w->bodies.inertia[body].zz};
    if (hull->has_hydrodynamics) {
        const matrix6 *a = &hull->hydrodynamics.added_mass;
        out.a11 = a->m[0][0];
        out.a22 = a->m[1][1];
        out.a26 = a->m[1][5];
        out.inertia += a->m[5][5];
    }
    if (s->environment.water) {
        double density = s->environment.water_density;
        hull_lift lift = hull_lift_of(h->length, h->beam, h->draught, hull->floats.volume, density);
        out.whole = hull_lift_moved(lift, h->midships - hull->centre.x);
        /* A table was measured on a hull that is held askew: it has all of u v, and nothing of turning. */
        if (hull->flows.water.count > 0)
            out.whole.y_v = out.whole.n_v = 0;
    }
    return out;
}

static rudder rudders_of(const scenario *s, const scenario_propulsion *p, const vessel_model *hull)
{
    const hull_particulars *h = &hull->particulars;
    double block = hull->floats.volume / (h->length * h->beam * h->draught);
    double area = automatic_or(p->rudder_area, rudder_area(h->length, h->beam, h->draught, block));
    if (!s->environment.water || !(area > 0))
        return (rudder){0};
    return rudder_of(area, (int)p->propellers, hull->wash.diameter, block, s->environment.water_density);
}

static propulsion_settings propulsion_settings_of(const scenario_propulsion *p, double length, double beam)
{
    double third = real_pow(p->power, 1.0 / 3);
    return (propulsion_settings){.bollard_pull = p->bollard_pull * third * third,
                                 .open_water_speed = p->open_water_speed * third,
                                 .astern = p->astern,
                                 .steering_most = radians(p->steering_angle_deg),
                                 .steering_rate = radians(p->steering_rate_deg),
                                 .steering_x = automatic_or(p->steering_x, -STERN * length),
                                 .lookahead = automatic_or(p->lookahead, LOOKAHEAD * length),
                                 .beset_speed = p->beset_speed,
                                 .beset_time = p->beset_time,
                                 .ram_distance = automatic_or(p->ram_distance, RAM * length),
                                 .x = p->pattern.x,
                                 .y = p->pattern.y,
                                 .distance = p->pattern.distance,
                                 .width = p->pattern.width,
                                 .aside = p->pattern.aside,
                                 .track_limit = automatic_or(p->track_limit, beam)};
}

/* A speed that a period asks for is known to this part, or after so many turns. */
#define SPEED_PRECISION 1e-3
enum { MOST_SPEED_TURNS = 20 };

/* The speed that is wanted, and how the ship turns at it.  A period gives the speed by the length of a round, which
   depends on how the ship turns at that speed: found from that of a round without turns on. */
static void give_speed(context *ctx, const model *m, int32_t vessel, const scenario_propulsion *p,
                       propulsion_settings *s)
{
    pattern_shape shape = {p->pattern.kind, s->distance, s->width, s->aside};
    double speed = wanted_speed(p, track_of_pattern(&shape, 0).length);
    for (int turn = 0; turn < MOST_SPEED_TURNS; turn++) {
        s->speed = speed;
        double made = fmin(s->speed, s->open_water_speed);
        s->steering_most = radians(p->steering_angle_deg);
        s->steering_most = turning_helm_of(ctx, m, vessel, s, made);
        s->turning = turning_ability_of(ctx, m, vessel, s, made);
        s->turning.corner = fmax(s->turning.corner, automatic_or(p->turning_radius, 0));
        speed = wanted_speed(p, track_of_pattern(&shape, s->turning.corner).length);
        if (!(fabs(speed - s->speed) > SPEED_PRECISION * speed))
            break;
    }
    s->speed = speed;
}

static vec2 point_of(const scenario_propulsion *p, int32_t i)
{
    return vec2_make(p->waypoints.data[i].x, p->waypoints.data[i].y);
}

int32_t course_first(const scenario_propulsion *p, vec2 begins, double length)
{
    int32_t i = 0;
    while (i + 1 < p->waypoints.count && vec2_length(vec2_sub(point_of(p, i), begins)) < AT_START * length)
        i++;
    return i;
}

int32_t course_next(const scenario_propulsion *p, int32_t last, double length)
{
    int32_t i = last + 1;
    while (i < p->waypoints.count && vec2_length(vec2_sub(point_of(p, i), point_of(p, last))) < LEAST_LEG * length)
        i++;
    return i;
}

fram_status build_propulsion(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                             world *w, fram_error *error)
{
    const scenario_propulsion *p = &entry->keys->propulsion;
    if (!vessel_drives_itself(entry->keys))
        return FRAM_OK;
    vec3 at = w->bodies.position[w->vessels.body[vessel]];
    double length = w->vessels.length[vessel];
    int32_t count = w->course.count;
    if (!table_resize(ctx, &w->course, &course_table_info, count + p->waypoints.count))
        return error_memory(error);
    int32_t i = course_first(p, vec2_make(at.x, at.y), length);
    for (; i < p->waypoints.count; i = course_next(p, i, length)) {
        w->course.vessel[count] = vessel;
        w->course.place[count++] = point_of(p, i);
    }
    if (!table_resize(ctx, &w->course, &course_table_info, count))
        return error_memory(error);
    const vessel_model *hull = &m->vessels.data[vessel];
    propulsion_settings settings = propulsion_settings_of(p, length, hull->particulars.beam);
    settings.transient = s->run.transient;
    settings.ship = ship_of(s, hull, w, w->vessels.body[vessel]);
    settings.rudder = rudders_of(s, p, hull);
    give_speed(ctx, m, vessel, p, &settings);
    return propulsion_add(ctx, &settings, p->pattern.kind, p->pattern.forecast, vessel, &w->vessels, &w->bodies,
                          &w->propulsion, error);
}
