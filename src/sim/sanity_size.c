/* A hull of one size, and numbers or a scale of another: what is left at its default of full size beside a model, or
   the scale of a tank beside a ship.  See sim/sanity.h. */
#include "base/load_unit.h"
#include "sim/sanity_parts.h"

#include <math.h>

/* Decks over the waterline, in beams: those of cruise ships and car carriers, 1. */
#define HIGHEST_DECK 1.0
/* Of a hull's weight: tugs pull a fifth of theirs, lines of small buoys begin with a quarter. */
#define MOST_OF_WEIGHT 0.5
/* Froude number of the length; hulls that displace water make 0.5, and from 1 on they plane. */
#define FASTEST_HULL 1.0

/* The step from a ship to its model in the tank. */
static void tell_scale(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    /* Over the default scale the longest ship is the longest model that a tank takes, 17 m. */
    double scale = t->s->run.scale, longest = USUAL_LENGTH_MOST / scenario_default_scale();
    if (scale < scenario_default_scale() && v->hull.length <= USUAL_LENGTH_MOST && v->hull.length > longest * scale)
        sanity_say(t->tell, t->to,
                   "run.scale: %g is that of a tank, where hulls measure up to %.3g m, and %s is %.4g m long: "
                   "thresholds of the ice, thrusters and controllers have the defaults of a model; leave it out, or "
                   "give %g, for full size",
                   scale, longest * scale, vessel_title_of(t->e).text, v->hull.length, scenario_default_scale());
}

bool sanity_is_added(const scenario *s, const void *member)
{
    bool added = false;
    for (int32_t i = 0; i < scenario_vessel_count(s); i++) {
        const scenario_vessel *v = scenario_vessel_entry(s, i).keys;
        added = added || (member == &v->hull.freeboard && !sanity_own_hull(v));
    }
    return added;
}

static void tell_deck(const teller *t)
{
    const scenario_hull *h = &t->e->keys->hull;
    if (h->form != HULL_CONE && scenario_freeboard(t->s, h) > HIGHEST_DECK * h->beam)
        sanity_say(t->tell, t->to,
                   "%s.hull.freeboard: the deck is %.4g m above the water, more than the beam of %.4g m: give metres, "
                   "of a model too",
                   t->e->path, scenario_freeboard(t->s, h), h->beam);
}

/* One force or several together. */
static void tell_force(const teller *t, const char *key, double force)
{
    double weight = sanity_about_mass(t->s, t->e->keys) * t->s->environment.gravity;
    if (force > MOST_OF_WEIGHT * weight)
        sanity_say(t->tell, t->to,
                   "%s.%s: %s is %.3g of the vessel's weight, about %s, %g at most is usual: give newtons, of "
                   "a model too",
                   t->e->path, key, load_text_of(force, 4).text, force / weight, load_text_of(weight, 3).text,
                   MOST_OF_WEIGHT);
}

static void tell_forces(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    double thrust = 0, pretension = 0;
    for (int32_t i = 0; i < v->thrusters.count; i++)
        thrust += v->thrusters.data[i].thrust;
    for (int32_t i = 0; i < v->mooring.lines.count; i++) {
        const scenario_mooring_line *l = &v->mooring.lines.data[i];
        if (l->kind != LINE_TABLE && is_automatic(l->length))
            pretension = fmax(pretension, l->pretension);
    }
    tell_force(t, "thrusters", thrust);
    tell_force(t, "mooring.lines", pretension);
    tell_force(t, "propulsion.bollard_pull", automatic_or(v->propulsion.bollard_pull, 0));
}

static void tell_speed(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    double root = sqrt(t->s->environment.gravity * v->hull.length);
    bool own = v->mode == VESSEL_FREE && vessel_drives_itself(v);
    double speed = own ? v->propulsion.open_water_speed : v->speed;
    if (v->hull.form != HULL_CONE && speed > FASTEST_HULL * root)
        sanity_say(t->tell, t->to,
                   "%s.%s: %.4g m/s is %.3g times the root of gravity and length of a hull of %.4g m, and hulls that "
                   "displace water make 0.5 of it at most: give m/s, of a model too",
                   t->e->path, own ? "propulsion.open_water_speed" : "speed", speed, speed / root, v->hull.length);
}

void sanity_tell_size(const scenario *s, const vessel_entry *e, sanity_teller tell, const void *to)
{
    const teller t = {s, tell, to, e, NULL, NULL, NULL};
    if (!sanity_own_hull(e->keys))
        return;
    tell_scale(&t);
    tell_deck(&t);
    tell_forces(&t);
    tell_speed(&t);
}
