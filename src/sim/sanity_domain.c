/* A vessel and the domain that it lies in: outside of it, or without room to turn.  See sim/sanity.h. */
#include "base/number_text.h"
#include "sim/sanity_parts.h"

#include <math.h>
#include <stdio.h>

/* What a vessel turns about in a field of floes, global: amidships, or its turret.  Beyond the edge of a drifting sheet
   there is open water, not a band: there the ship is looked at as it lies.  reach: from there along X and Y; a vessel
   that is led keeps its heading. */
static vec2 turns_about(const scenario *scene, const scenario_vessel *v, vec3 start, vec2 *reach)
{
    bool turret = v->mode == VESSEL_FREE && v->mooring.turret && v->mooring.lines.count > 0;
    turret = turret && scene->ice.source != ICE_LEVEL;
    double c = real_cos(radians(start.z)), s = real_sin(radians(start.z));
    double x = turret ? v->mooring.x : 0, y = turret ? v->mooring.y : 0;
    double along = 0.5 * v->hull.length + fabs(x), across = 0.5 * v->hull.beam + fabs(y);
    double most = sqrt(along * along + across * across);
    if (v->hull.form == HULL_CONE)
        most = 0.5 * v->hull.length + sqrt(x * x + y * y);
    *reach = vec2_make(most, most);
    if (v->mode != VESSEL_FREE && v->hull.form != HULL_CONE)
        *reach = vec2_make(fabs(c) * along + fabs(s) * across, fabs(s) * along + fabs(c) * across);
    return vec2_make(start.x + c * x - s * y, start.y + s * x + c * y);
}

/* Of a reach [m]: what is missing to it by rounding. */
#define ROOM_ROUNDED 1e-9

/* A side of the domain: how near it is, and how near the vessel reaches, its own edge of the band on the way [m]. */
typedef struct domain_side {
    const char *key;
    double room, reach;
    double bound; /* where it should stand at the nearest */
    bool upper;
} domain_side;

/* Of a side's place: so many that its reach has that many, however far the origin is. */
static int bound_digits(const domain_side *d)
{
    enum { OF_REACH = 4, LEAST = 4 };
    return digits_beside(d->bound, d->reach, OF_REACH, LEAST);
}

/* "domain.y_min -72.2 or less and domain.y_max 72.2 or more": of all sides that are too near. */
static void list_bounds(const domain_side *sides, char *out, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < 4 && used < size; i++) {
        const domain_side *d = &sides[i];
        if (!(d->reach - d->room > ROOM_ROUNDED * d->reach))
            continue;
        double slack = ROOM_ROUNDED * d->reach;
        const int digits = bound_digits(d);
        const bound_text bound =
            d->upper ? least_text_of(d->bound - slack, digits) : most_text_of(d->bound + slack, digits);
        used += (size_t)snprintf(out + used, size - used, "%sdomain.%s %s or %s", used > 0 ? " and " : "", d->key,
                                 bound.text, d->upper ? "more" : "less");
    }
}

/* Edges of a fed domain within the reach of the vessel, turned any way it may be: the band moves floes through the
   hull. */
static void tell_room(const teller *t, const vessel_entry *e, vec3 start)
{
    const scenario_domain *d = &t->s->domain;
    vec2 reach, at = turns_about(t->s, e->keys, start, &reach);
    double band = sanity_least_band(t->s);
    const domain_side sides[] = {
        {"x_min", at.x - d->x_min - band, reach.x, at.x - reach.x - band, false},
        {"x_max", d->x_max - at.x - band, reach.x, at.x + reach.x + band, true},
        {"y_min", at.y - d->y_min - band, reach.y, at.y - reach.y - band, false},
        {"y_max", d->y_max - at.y - band, reach.y, at.y + reach.y + band, true},
    };
    const domain_side *near = sides;
    for (int i = 1; i < 4; i++)
        near = sides[i].reach - sides[i].room > near->reach - near->room ? &sides[i] : near;
    char bounds[4 * (NUMBER_TEXT_SIZE + 24)] = "";
    list_bounds(sides, bounds, sizeof bounds);
    if (d->boundary == DOMAIN_FEEDING && bounds[0])
        sanity_say(t->tell, t->to, "domain: its edge%s is %.4g m %s %s, which reaches %.4g m%s; take %s",
                   band > 0 ? " with the band" : "", fabs(near->room), near->room < 0 ? "short of" : "from", e->path,
                   near->reach, e->keys->mode == VESSEL_FREE ? " as it turns" : " towards it", bounds);
}

static bool is_judged_by_domain(const scenario *s, const scenario_vessel *v)
{
    return s->ice.source != ICE_NONE && v->path.count == 0;
}

/* From the vessel to the nearest edge [m], negative beyond it. */
static double to_edge(const scenario_domain *d, const scenario_vessel *v)
{
    vec2 from = domain_edges_from(d, vec2_make(v->x, v->y));
    return fmin(from.x, from.y);
}

double sanity_hull_reach(const scenario_vessel *v, const vessel_model *made)
{
    double most = 0;
    if (sanity_own_hull(v))
        return 0.5 * sqrt(v->hull.length * v->hull.length + v->hull.beam * v->hull.beam);
    for (int32_t i = 0; made && i < made->plan.count; i++) {
        double x = made->plan.data[i].x + made->centre.x, y = made->plan.data[i].y + made->centre.y;
        most = fmax(most, sqrt(x * x + y * y));
    }
    return most;
}

bool sanity_lies_outside(const scenario *s, int32_t vessel, const model *built)
{
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    const vessel_model *made = built ? &built->vessels.data[vessel] : NULL;
    return is_judged_by_domain(s, v) && to_edge(&s->domain, v) < -sanity_hull_reach(v, made);
}

bool sanity_asks_of_place(const scenario *s, int32_t vessel)
{
    return !sanity_own_hull(scenario_vessel_entry(s, vessel).keys) && sanity_lies_outside(s, vessel, NULL);
}

void sanity_tell_domain(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to)
{
    const vessel_entry entry = scenario_vessel_entry(s, vessel), *e = &entry;
    const teller t = {s, tell, to, e, built.made, built.model, built.read};
    const scenario_domain *d = &s->domain;
    const scenario_vessel *v = e->keys;
    if (!is_judged_by_domain(s, v))
        return;
    if (sanity_lies_outside(s, vessel, built.model))
        sanity_say(tell, to, "%s.x: (%s, %s) m lies outside of the domain, %.4g m from its edge: there is no ice%s",
                   e->path, coordinate_text_of(v->x).text, coordinate_text_of(v->y).text, -to_edge(d, v),
                   sanity_own_hull(v) || built.model ? "" : ", unless the hull of its file reaches in");
    else if (sanity_own_hull(v))
        tell_room(&t, e, sanity_start(s, vessel, built.made));
    double width = fmin(d->x_max - d->x_min, d->y_max - d->y_min);
    if (sanity_own_hull(v) && d->boundary != DOMAIN_FEEDING && width < 2 * v->hull.beam)
        sanity_say(tell, to, "domain: %.4g m is less than two beams of %s, so that its edges carry the load", width,
                   e->path);
}
