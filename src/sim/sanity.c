#include "base/load_unit.h"
#include "base/number_text.h"
#include "sim/ice_kinds.h"
#include "sim/known_flow.h"
#include "sim/sanity_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void sanity_say(sanity_teller tell, const void *to, const char *format, ...)
{
    char text[SANITY_SENTENCE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    tell(to, text);
}

/* ---- one number at a time ---- */

/* The keys whose value is an angle [deg], by their end. */
static bool is_angle(const char *pattern)
{
    size_t n = strlen(pattern);
    return n > 4 && strcmp(pattern + n - 4, "_deg") == 0;
}

/* Radians where degrees belong are multiples of pi / 12 to the digits that a person types, within a full turn. */
#define TYPED_RADIANS 1e-3
#define FULL_TURN 6.3

static void tell_radians(const teller *t, const char *path, double value)
{
    double part = fabs(value) / (PI / 12), off = fabs(part - floor(part + 0.5)) * (PI / 12);
    bool whole = fabs(value - floor(value + 0.5)) < 1e-9;
    if (fabs(value) < FULL_TURN && part > 0.9 && off < TYPED_RADIANS && !whole)
        sanity_say(t->tell, t->to, "%s: %.6g degrees is %.4g of pi: give degrees, not radians", path, value,
                   value / PI);
}

void sanity_pattern(const char *path, char out[SANITY_PATTERN])
{
    size_t n = 0;
    if (strncmp(path, "vessels[", 8) == 0) {
        path = strchr(path, ']') ? strchr(path, ']') + 1 : path;
        n = (size_t)snprintf(out, SANITY_PATTERN, "vessel");
    }
    for (; *path && n + 1 < SANITY_PATTERN; path++) {
        out[n++] = *path;
        if (*path == '[' && strchr(path, ']'))
            path = strchr(path, ']') - 1;
    }
    out[n] = '\0';
}

/* The area on which a crushing strength is judged, where its pressure goes with the area: the thickness of its ice,
   squared [m2].  0: on any; NaN: not known. */
static double judged_on(const teller *t, const void *member)
{
    const scenario_ice *i = &t->s->ice;
    double h = member == &i->crushing_strength ? sanity_own_thickness(i, t->made) : 0;
    if (i->crushing_exponent == 0)
        return 0;
    for (int32_t k = 0; k < i->populations.count; k++)
        if (member == &i->populations.data[k].crushing_strength)
            h = automatic_or(i->populations.data[k].thickness, i->thickness);
    return h * h;
}

/* 0 is none of what is told here, or told in words of its own, but of Poisson's ratio there is no none. */
static bool is_none(const usual_value *u, double value)
{
    return value == 0 && u->least > 0 && strcmp(u->key, "ice.poisson_ratio") != 0;
}

static fram_status look_at_number(void *user, const scenario_key *key, const void *member, const char *path,
                                  fram_error *error)
{
    (void)error;
    const teller *t = user;
    double value = key->kind == KEY_REAL ? *(const double *)member : (double)NAN;
    if (is_automatic(value))
        return FRAM_OK;
    bool has_unit = *key->unit && strcmp(key->unit, "1") != 0;
    char pattern[SANITY_PATTERN], on[SANITY_ON_AREA] = "";
    sanity_pattern(path, pattern);
    if (is_angle(pattern))
        tell_radians(t, path, value);
    double area = judged_on(t, member), judged = value;
    if (isnan(area) || !sanity_is_taken(&t->s->ice, member) || sanity_is_added(t->s, member))
        return FRAM_OK;
    if (area > 0)
        judged = sanity_pressure_on(&t->s->ice, value, area, on);
    const usual_value *u = usual_value_of(pattern);
    if (!u)
        return FRAM_OK;
    const usual_range r = usual_range_at_scale(t->s, u->least, u->most, u->power);
    if ((judged >= r.least && judged <= r.most) || is_none(u, value))
        return FRAM_OK;
    const range_text usual = range_text_of(r.least, r.most, 3);
    sanity_say(t->tell, t->to, "%s: %.6g%s%s%s is outside of %s to %s, %s: %s", path, value, has_unit ? " " : "",
               has_unit ? key->unit : "", on, usual.least.text, usual.most.text, u->why, u->remedy);
    return FRAM_OK;
}

/* ---- numbers that belong together ---- */

/* A floe heaves at the root of rho_w g / (rho_i h); see the stiffness of hulls in vessel_check.c for the bounds. */
static void tell_heave(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    const scenario_environment *e = &t->s->environment;
    if (i->source == ICE_NONE || !e->water)
        return;
    double h = ice_range_made(i, t->made).thinnest.thickness,
           frequency = sqrt(e->water_density * e->gravity / (i->density * h));
    if (frequency * t->s->run.time_step > 1)
        sanity_say(
            t->tell, t->to,
            "run.time_step: %.4g s is too long for ice of %.3g m, which heaves at %.3g rad/s; take less than %.2g s",
            t->s->run.time_step, h, frequency, 0.5 / frequency);
}

/* A concentration under this one was meant in tenths or per cent, or is hardly worth a run. */
#define LEAST_CONCENTRATION 0.05

static void tell_ice_shape(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    if (i->source == ICE_VORONOI && i->populations.count == 0 && sqrt(i->mean_floe_area) < 2 * i->thickness)
        sanity_say(
            t->tell, t->to,
            "ice.mean_floe_area: floes of %.3g m2 are hardly wider than the ice is thick, %.3g m: is it the area?",
            i->mean_floe_area, i->thickness);
    if (scenario_ice_is_drawn(i) && i->concentration < LEAST_CONCENTRATION)
        sanity_say(t->tell, t->to, "ice.concentration: %.3g is next to open water: it is a part of 1, not of 10 or 100",
                   i->concentration);
}

/* Directions are where wind and ice go to; most drift goes within a right angle of the wind. */
static void tell_directions(const teller *t)
{
    const scenario_environment *e = &t->s->environment;
    const known_flow drift = known_drift(t->s, t->read);
    if (e->air_density == 0 && (e->wind_speed > 0 || e->wind_file[0]))
        sanity_say(t->tell, t->to, "environment.air_density: 0 kg/m3 leaves a wind without any force");
    if (e->wind_file[0] || !known_flow_goes(&drift) || !(e->wind_speed > 0) || t->s->ice.source == ICE_NONE)
        return;
    if (sanity_degrees_apart(drift.towards_deg, e->wind_direction_deg) > 90)
        sanity_say(
            t->tell, t->to,
            "environment.wind_direction_deg: the wind blows towards %g degrees and %s goes towards %g, against it; "
            "directions are where it goes to, not where it comes from",
            e->wind_direction_deg, scenario_drift(t->s).own ? "the ice (domain.drift_direction_deg)" : "the current",
            drift.towards_deg);
}

/* ---- vessels, from their keys ---- */

/* Beam over draught of barges and shallow river ships goes up to 15. */
#define MOST_BEAM 25

static void tell_hull(const teller *t, const vessel_entry *e)
{
    const scenario_hull *h = &e->keys->hull;
    if (!sanity_own_hull(e->keys))
        return;
    if (h->beam > h->length)
        sanity_say(t->tell, t->to, "%s.hull.beam: the hull is wider, %.4g m, than it is long, %.4g m", e->path, h->beam,
                   h->length);
    /* Legs, piles and spars stand deep. */
    if (h->form != HULL_CONE && h->draught > h->beam)
        sanity_say(t->tell, t->to, "%s.hull.draught: %.4g m is more than the beam, %.4g m", e->path, h->draught,
                   h->beam);
    if (h->beam > MOST_BEAM * h->draught)
        sanity_say(t->tell, t->to, "%s.hull.draught: %.4g m is %.3g of the beam, %.4g m: give metres", e->path,
                   h->draught, h->draught / h->beam, h->beam);
    if (automatic_or(e->keys->centre_of_gravity_z, 0) > scenario_freeboard(t->s, h))
        sanity_say(t->tell, t->to,
                   "%s.centre_of_gravity_z: %.4g m is above the deck at %.4g m: give metres above the design "
                   "waterline, not above the keel",
                   e->path, e->keys->centre_of_gravity_z, scenario_freeboard(t->s, h));
    const scenario_ice *i = &t->s->ice;
    double thickest = ice_range_made(i, t->made).thickest.thickness;
    const char *key = thickest == i->thickness           ? "ice.thickness"
                      : t->made && i->source == ICE_FILE ? "ice.file"
                      : i->source == ICE_FLOES           ? "ice.floes[].thickness"
                                                         : "ice.populations[].thickness";
    if (i->source != ICE_NONE && thickest > h->draught)
        sanity_say(t->tell, t->to, "%s: %.4g m is more than the draught of the vessel, %.4g m", key, thickest,
                   h->draught);
    if (e->keys->mooring.lines.count > 0 && e->keys->mooring.depth < h->draught)
        sanity_say(t->tell, t->to, "%s.mooring.depth: the hull of draught %.4g m lies on the bottom at %.4g m", e->path,
                   h->draught, e->keys->mooring.depth);
}

/* Told of the scenario as a whole: a vessel at rest meets what another one pushes. */
static void tell_rest(const teller *t)
{
    const scenario_environment *n = &t->s->environment;
    const known_flow current = known_current(t->s, t->read), drift = known_drift(t->s, t->read);
    int32_t count = scenario_vessel_count(t->s);
    bool known = current.known && drift.known;
    bool moves = !known || current.fastest > 0 || drift.fastest > 0 || n->wind_speed > 0 || n->wind_file[0];
    for (int32_t i = 0; i < count; i++)
        moves = moves || sanity_vessel_moves(scenario_vessel_entry(t->s, i).keys);
    if (!moves && count > 0 && t->s->ice.source != ICE_NONE && t->s->ice.floes.count == 0)
        sanity_say(t->tell, t->to, "%s.speed: neither vessel nor ice, water or wind moves: no load will come",
                   scenario_vessel_entry(t->s, 0).path);
}

/* Strain from which on a line without a breaking load is told: chain breaks at about 1 %, by its stiffness and its
   least breaking load. */
#define TAUT 0.02

/* A spring whose length is given, under the tension of the start. */
static void tell_spring(const teller *t, const vessel_entry *e, int32_t line, double straight)
{
    const scenario_mooring_line *l = &e->keys->mooring.lines.data[line];
    double pull = l->stiffness * fmax(straight - l->length, 0), most = automatic_or(l->breaking_load, HUGE_VAL);
    if (pull > 0.5 * most)
        sanity_say(
            t->tell, t->to,
            "%s.mooring.lines[%d].length: %.5g m over a straight way of %.5g m pulls with %s from the start, %s the "
            "breaking load of %s",
            e->path, (int)line, l->length, straight, load_text_of(pull, 4).text,
            pull >= most ? "over" : "more than half of", load_text_of(most, 4).text);
    else if (isinf(most) && pull > USUAL_PULL_MOST * fmax(1, usual_at_scale(t->s, 3)))
        sanity_say(
            t->tell, t->to,
            "%s.mooring.lines[%d].length: %.5g m over a straight way of %.5g m pulls with %s from the start: it is the "
            "length without tension",
            e->path, (int)line, l->length, straight, load_text_of(pull, 4).text);
}

/* A line whose length is given: too long to pull, or stretched from the start. */
static void tell_length(const teller *t, const vessel_entry *e, int32_t line)
{
    const scenario_mooring *m = &e->keys->mooring;
    const scenario_mooring_line *l = &m->lines.data[line];
    double down = m->depth + m->z, straight = sqrt(l->distance * l->distance + down * down);
    double most = automatic_or(l->breaking_load, HUGE_VAL), strain = straight / l->length - 1;
    if (is_automatic(l->length) || l->kind == LINE_TABLE)
        return;
    /* A hanging line pulls from where it hangs straight down to the bottom and lies straight from there to its anchor;
       a spring from where it is straight. */
    double reach = l->kind == LINE_SPRING ? sqrt(fmax(l->length * l->length - down * down, 0)) : l->length - down;
    if (l->length > l->distance + down)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].length: %.5g m reaches down and along the bottom to its anchor: it does not "
                   "pull until the vessel is %.3g m farther away",
                   e->path, (int)line, l->length, reach - l->distance);
    else if (l->kind == LINE_SPRING)
        tell_spring(t, e, line, straight);
    else if (l->kind == LINE_CATENARY && strain * l->stiffness > 0.5 * most)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].length: %.5g m over a straight way of %.5g m strains it to about %s from the "
                   "start, %s its breaking load",
                   e->path, (int)line, l->length, straight, load_text_of(strain * l->stiffness, 3).text,
                   strain * l->stiffness >= most ? "over" : "more than half of");
    else if (l->kind == LINE_CATENARY && isinf(most) && strain > TAUT)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].length: %.5g m over a straight way of %.5g m is stretched by %.3g %% from the "
                   "start, to about %s: it pulls the vessel down, and no breaking_load lets it part",
                   e->path, (int)line, l->length, straight, 100 * strain, load_text_of(strain * l->stiffness, 3).text);
}

/* A limit on a vessel that current, wind or ice carry off, since nothing answers them. */
static void tell_unheld(const teller *t, const vessel_entry *e)
{
    const scenario_vessel *v = e->keys;
    const scenario_environment *n = &t->s->environment;
    const known_flow current = known_current(t->s, t->read), drift = known_drift(t->s, t->read);
    bool wind = n->air_density > 0 && (n->wind_speed > 0 || n->wind_file[0]);
    bool flows = n->water && (!current.known || current.fastest > 0);
    bool carried = flows || wind || (drift.known && drift.fastest > 0 && t->s->ice.source != ICE_NONE);
    bool held =
        v->mooring.lines.count > 0 || v->positioning.active || sanity_has_settings(v) || vessel_drives_itself(v);
    const char *limit = !is_automatic(v->station.offset_limit)        ? "offset_limit"
                        : !is_automatic(v->station.heading_limit_deg) ? "heading_limit_deg"
                                                                      : NULL;
    if (v->mode == VESSEL_FREE && limit && carried && !held)
        sanity_say(t->tell, t->to, "%s.station.%s: nothing holds the vessel against current, wind or ice: %s", e->path,
                   limit,
                   v->thrusters.count > 0
                       ? "positioning.active is false, so that its thrusters push only if a program gives them orders"
                       : "it has neither mooring.lines nor thrusters with positioning");
}

static void tell_vessel_station(const teller *t, const vessel_entry *e)
{
    const scenario_vessel *v = e->keys;
    tell_unheld(t, e);
    for (int32_t i = 0; i < v->mooring.lines.count; i++) {
        const scenario_mooring_line *l = &v->mooring.lines.data[i];
        double most = automatic_or(l->breaking_load, HUGE_VAL);
        if (is_automatic(l->length) && l->kind != LINE_TABLE && l->pretension > 0.5 * most)
            sanity_say(t->tell, t->to, "%s.mooring.lines[%d].pretension: %s is %s the breaking load of %s", e->path,
                       (int)i, load_text_of(l->pretension, 4).text,
                       l->pretension >= most ? "over" : "more than half of", load_text_of(most, 4).text);
        tell_length(t, e, i);
    }
    if (v->positioning.active && v->thrusters.count == 0)
        sanity_say(t->tell, t->to, "%s.positioning: there are no thrusters to position with", e->path);
    if (v->positioning.active && v->positioning.control == CONTROL_HEADING && v->mooring.lines.count == 0)
        sanity_say(t->tell, t->to,
                   "%s.positioning.control: heading alone leaves the position to a mooring, and there is none",
                   e->path);
}

void sanity_tell(const scenario *s, sanity_built built, sanity_teller tell, const void *to)
{
    const world *made = built.made;
    teller t = {s, tell, to, NULL, made, built.model, built.read};
    (void)scenario_walk(s, look_at_number, &t, NULL);
    tell_heave(&t);
    tell_ice_shape(&t);
    sanity_tell_ice(s, built, tell, to);
    sanity_tell_idle(s, tell, to);
    tell_directions(&t);
    sanity_tell_times(s, tell, to);
    tell_rest(&t);
    sanity_tell_drift(s, built, tell, to);
    for (int32_t i = 0; i < scenario_vessel_count(s); i++) {
        vessel_entry e = scenario_vessel_entry(s, i);
        tell_hull(&t, &e);
        sanity_tell_domain(s, i, built, tell, to);
        tell_vessel_station(&t, &e);
        sanity_tell_size(s, &e, tell, to);
        sanity_tell_vessel(s, i, built, tell, to);
        sanity_tell_control(s, &e, built, tell, to);
        sanity_tell_vaning(s, i, built, tell, to);
    }
}
