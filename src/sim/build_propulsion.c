#include "sim/build_propulsion.h"

#include "base/transcendental.h"

#include <math.h>

/* Where nothing is given, parts of the length: thrust at the stern, the aim, the way back before a ram. */
static const double STERN = 0.45, LOOKAHEAD = 2.5, RAM = 1;

static double wanted_speed(const scenario_propulsion *p)
{
    pattern_shape shape = {p->pattern.kind, p->pattern.distance, p->pattern.width};
    if (p->pattern.kind != PATTERN_NONE && !is_automatic(p->pattern.period))
        return pattern_length(&shape) / p->pattern.period;
    return automatic_or(p->speed, HUGE_VAL);
}

static hull_lift lift_of(const scenario *s, const vessel_model *hull)
{
    const hull_particulars *h = &hull->particulars;
    if (!s->environment.water)
        return (hull_lift){0};
    return hull_lift_of(h->length, h->beam, h->draught, hull->floats.volume, s->environment.water_density);
}

static propulsion_settings settings_of(const scenario_propulsion *p, double length, hull_lift lift)
{
    double third = real_pow(p->power, 1.0 / 3);
    return (propulsion_settings){.bollard_pull = p->bollard_pull * third * third,
                                 .open_water_speed = p->open_water_speed * third,
                                 .astern = p->astern,
                                 .speed = wanted_speed(p),
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
                                 .lift = lift};
}

fram_status build_propulsion(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                             world *w, fram_error *error)
{
    const scenario_propulsion *p = &entry->keys->propulsion;
    if (is_automatic(p->bollard_pull))
        return FRAM_OK;
    int32_t had = w->course.count;
    if (!table_resize(ctx, &w->course, &course_table_info, had + p->waypoints.count))
        return error_memory(error);
    for (int32_t i = 0; i < p->waypoints.count; i++) {
        w->course.vessel[had + i] = vessel;
        w->course.place[had + i] = vec2_make(p->waypoints.data[i].x, p->waypoints.data[i].y);
    }
    propulsion_settings settings = settings_of(p, w->vessels.length[vessel], lift_of(s, &m->vessels.data[vessel]));
    return propulsion_add(ctx, &settings, p->pattern.kind, vessel, &w->vessels, &w->bodies, &w->propulsion, error);
}
