#include "base/number_text.h"
#include "ice/feeding.h"
#include "ice/material.h"
#include "sim/build_level.h"
#include "sim/build_model.h"
#include "sim/build_packed.h"
#include "sim/known_flow.h"
#include "sim/sanity_parts.h"

#include <math.h>
#include <stdio.h>

/* ---- the band of an endless field ---- */

/* Part of a population's floes that are larger than what is taken for the largest: one of them is drawn in any field.
 */
#define SURELY_LARGER 0.1

/* The least that the largest floe of a drawn field reaches from its centre, where that is known [m]: the floe of the
   mean cell, or what is almost the largest of the populations. */
static double floe_reach(const scenario_ice *i)
{
    bool cells = i->source == ICE_VORONOI && i->populations.count == 0;
    double most = cells ? 2 * sqrt(i->concentration * i->mean_floe_area / PI) : 0;
    for (int32_t k = 0; k < i->populations.count; k++) {
        const size_law law = population_size_law(&i->populations.data[k]);
        if (law.kind != SIZE_HISTOGRAM && !size_law_fault(&law))
            most = fmax(most, size_law_quantile(&law, 1 - SURELY_LARGER));
    }
    return 0.5 * most;
}

double sanity_least_band(const scenario *s)
{
    if (s->domain.boundary != DOMAIN_FEEDING || s->ice.source == ICE_LEVEL)
        return 0;
    return automatic_or(s->domain.band, scenario_ice_is_field(&s->ice) ? feeding_band(floe_reach(&s->ice)) : 0);
}

/* ---- sizes under which ice is left out ---- */

/* Part of a wedge that breaks off from which on floes that must be larger raise the load by more than chance. */
#define WEDGES_KEPT 0.25
/* Of the thickness squared: pieces smaller than this are no floes any more. */
#define SPECK 1e-3
/* Of the thickness: edges as long belong to the shape of a floe. */
#define LONG_EDGE 1.0

/* Without breaking no wedge is too small, nor where the ice is not known. */
static double wedge_of(const teller *t)
{
    const ice_range ice = ice_range_made(&t->s->ice, t->made);
    return ice_may_break(&t->s->ice) && ice_is_known(&ice) ? build_wedge_area(t->s, &ice.thinnest) : HUGE_VAL;
}

static void tell_left_out(const teller *t, const char *key, double area)
{
    const scenario_ice *i = &t->s->ice;
    bool mean_floe = i->source == ICE_VORONOI && i->populations.count == 0;
    double wedge = wedge_of(t);
    if (mean_floe && area > POPULATION_LEFT_OUT * i->mean_floe_area)
        sanity_say(t->tell, t->to,
                   "ice.%s: %.4g m2 is %.2g of the mean floe, %.4g m2: ice that is asked for is left out; give a "
                   "smaller area, or the run.scale (%g) by which it is found",
                   key, area, area / i->mean_floe_area, i->mean_floe_area, t->s->run.scale);
    else if (area > wedge)
        sanity_say(t->tell, t->to,
                   "ice.%s: %.4g m2 is more than the pieces that break off, wedges of about %.3g m2: they are left out "
                   "or do not break off, and the ship sticks; give a smaller area, or the run.scale (%g) by which it "
                   "is found",
                   key, area, wedge, t->s->run.scale);
}

/* Cells that follow a law of size lose those of its floes that are smaller; packed floes are made as they were drawn,
   and what a histogram has is in its file. */
static void tell_law_cut(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    double across = sqrt(4 / PI * i->smallest_floe_area);
    for (int32_t k = 0; i->source == ICE_VORONOI && k < i->populations.count; k++) {
        const size_law law = population_size_law(&i->populations.data[k]);
        double part = law.kind == SIZE_HISTOGRAM || size_law_fault(&law) ? 0 : size_law_part(&law, across);
        if (part > POPULATION_LEFT_OUT)
            sanity_say(t->tell, t->to, POPULATION_LAW_CUT, i->smallest_floe_area, across, part, (int)k,
                       t->s->run.scale);
    }
}

/* Ice that breaks in pieces which are not made: they stay with their neighbours, and the edge with its teeth. */
static void tell_wedges_kept(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    double wedge = wedge_of(t), area = i->smallest_floe_area;
    if (area > WEDGES_KEPT * wedge && area <= wedge)
        sanity_say(
            t->tell, t->to,
            "ice.smallest_floe_area: %.4g m2 is %.2g of the pieces that break off, wedges of about %.3g m2: "
            "smaller ones stay with their neighbours, and loads grow (level ice of 0.7 m: by a fifth with 0.4 of "
            "them, a third with 0.8): take %.2g m2 or less where loads count",
            area, area / wedge, wedge, 0.1 * wedge);
}

static void tell_thresholds(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    double thickness = ice_range_made(i, t->made).thinnest.thickness, speck = SPECK * thickness * thickness;
    tell_left_out(t, "smallest_floe_area", i->smallest_floe_area);
    tell_left_out(t, "smallest_piece_area", i->smallest_piece_area);
    tell_law_cut(t);
    tell_wedges_kept(t);
    if (ice_may_break(i) && i->smallest_floe_area < speck)
        sanity_say(t->tell, t->to,
                   "ice.smallest_floe_area: %.3g m2 keeps specks of ice that is %.3g m thick, thousands of them where "
                   "it breaks: take %s m2 or more",
                   i->smallest_floe_area, thickness, least_text_of(speck, 2).text);
    if (i->edge_threshold > LONG_EDGE * thickness)
        sanity_say(t->tell, t->to,
                   "ice.edge_threshold: edges under %.4g m are removed from floes of %.3g m thickness, and their shape "
                   "with them: give a length far under the thickness, or the run.scale (%g) by which it is found",
                   i->edge_threshold, thickness, t->s->run.scale);
}

/* ---- the field ---- */

/* Part of the domain's smaller side that may be kept free of ice round a vessel. */
#define WIDEST_MARGIN 0.25

static void tell_field(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    const scenario_domain *d = &t->s->domain;
    double width = fmin(d->x_max - d->x_min, d->y_max - d->y_min);
    if (scenario_vessel_count(t->s) > 0 && i->keep_out_margin > WIDEST_MARGIN * width)
        sanity_say(t->tell, t->to,
                   "ice.keep_out_margin: %.4g m round the vessel are free of ice in a domain of %.4g m: give metres",
                   i->keep_out_margin, width);
    if (d->boundary != DOMAIN_FEEDING || i->source == ICE_LEVEL)
        return;
    double radius = sqrt(i->mean_floe_area / PI), band = automatic_or(d->band, HUGE_VAL);
    if (i->source == ICE_VORONOI && i->populations.count == 0 && band < radius)
        sanity_say(t->tell, t->to,
                   "domain.band: %.4g m is narrower than the mean floe's radius, %.3g m: floes at the edge are not "
                   "driven; leave it out, or give metres",
                   band, radius);
    if (automatic_or(d->tile_x, HUGE_VAL) < d->x_max - d->x_min)
        sanity_say(t->tell, t->to, "domain.tile_x: the field repeats itself after %.4g m, within the domain of %.4g m",
                   d->tile_x, d->x_max - d->x_min);
    if (automatic_or(d->tile_y, HUGE_VAL) < d->y_max - d->y_min)
        sanity_say(t->tell, t->to, "domain.tile_y: the field repeats itself after %.4g m, within the domain of %.4g m",
                   d->tile_y, d->y_max - d->y_min);
}

static void tell_populations(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    const scenario_domain *d = &t->s->domain;
    double width = fmin(d->x_max - d->x_min, d->y_max - d->y_min);
    for (int32_t k = 0; k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        const struct {
            const char *key, *unit;
            double mean, deviation;
        } spread[] = {
            {"thickness", "m", automatic_or(p->thickness, i->thickness), p->thickness_deviation},
            {"flexural", "Pa", automatic_or(p->flexural_strength, i->flexural_strength), p->flexural_deviation},
            {"crushing", "Pa", automatic_or(p->crushing_strength, i->crushing_strength), p->crushing_deviation}};
        for (size_t n = 0; n < sizeof spread / sizeof *spread; n++)
            if (spread[n].deviation > spread[n].mean)
                sanity_say(t->tell, t->to,
                           "ice.populations[%d].%s_deviation: %.4g %s is more than the mean, %.4g %s: give the "
                           "standard deviation, not a percentage",
                           (int)k, spread[n].key, spread[n].deviation, spread[n].unit, spread[n].mean, spread[n].unit);
        if (p->size == SIZE_LOGNORMAL && (p->diameter < p->diameter_min || p->diameter > p->diameter_max))
            sanity_say(t->tell, t->to,
                       "ice.populations[%d].diameter: the mean, %.4g m, is outside of the sizes that are drawn, "
                       "diameter_min to diameter_max, %.4g to %.4g m: floes have another mean",
                       (int)k, p->diameter, p->diameter_min, p->diameter_max);
        bool one = p->size == SIZE_CONSTANT || p->size == SIZE_LOGNORMAL;
        double size = one ? p->diameter : p->diameter_max;
        if (p->size != SIZE_HISTOGRAM && size > width)
            sanity_say(t->tell, t->to,
                       "ice.populations[%d].diameter%s: floes of %.4g m do not fit into a domain of %.4g m: give "
                       "metres",
                       (int)k, one ? "" : "_max", size, width);
    }
}

/* ---- its drift ---- */

static bool goes_against(double a_deg, double b_deg) { return sanity_degrees_apart(a_deg, b_deg) > 90; }

/* Ice that is told to drift against the water under it, and no wind that would drive it. */
static void tell_drift(const teller *t)
{
    const scenario_environment *e = &t->s->environment;
    const known_flow drift = known_drift(t->s, t->read), current = known_current(t->s, t->read);
    double to = drift.towards_deg;
    bool blows = e->wind_file[0] || (e->wind_speed > 0 && !goes_against(to, e->wind_direction_deg));
    if (!scenario_drift(t->s).own || !e->water || !known_flow_goes(&drift) || !known_flow_goes(&current))
        return;
    if (!blows && goes_against(to, current.towards_deg))
        sanity_say(
            t->tell, t->to,
            "domain.drift_direction_deg: the ice goes towards %g degrees at %.4g m/s and the current under it "
            "towards %g at %.4g m/s, against it: directions are where they go to; without domain.drift_speed the "
            "ice goes with the current",
            to, drift.fastest, current.towards_deg, current.fastest);
}

/* ---- level ice ---- */

/* When what lies from lo to hi and goes at a speed is over what lies from at to end: from when on, until when. */
static void narrow_time(double lo, double hi, double speed, double at, double end, double time[2])
{
    bool there = lo < end && hi > at;
    double first = there ? 0 : HUGE_VAL, last = there ? HUGE_VAL : 0;
    if (speed != 0) {
        first = (speed > 0 ? at - hi : end - lo) / speed;
        last = (speed > 0 ? end - lo : at - hi) / speed;
    }
    time[0] = fmax(time[0], first);
    time[1] = fmin(time[1], last);
}

/* A sheet that begins outside of the domain, and that its drift takes past it, away from it or not as far as to it. */
static void tell_sheet_outside(const teller *t)
{
    const scenario_domain *d = &t->s->domain;
    const known_flow drift = known_drift(t->s, t->read);
    if (!scenario_drift(t->s).fed || !drift.steady)
        return;
    box2 sheet = build_sheet_extent(t->s);
    vec3 goes = scenario_velocity(drift.fastest, drift.towards_deg);
    double time[2] = {0, t->s->run.duration};
    narrow_time(sheet.lo.x, sheet.hi.x, goes.x, d->x_min, d->x_max, time);
    narrow_time(sheet.lo.y, sheet.hi.y, goes.y, d->y_min, d->y_max, time);
    double gap =
        fmax(fmax(sheet.lo.x - d->x_max, d->x_min - sheet.hi.x), fmax(sheet.lo.y - d->y_max, d->y_min - sheet.hi.y));
    if (time[0] >= time[1])
        sanity_say(t->tell, t->to,
                   "ice.level: the sheet begins %.4g m outside of the domain, and drifts %.4g m towards %g degrees in "
                   "the run: there will be no ice",
                   gap, drift.fastest * t->s->run.duration, drift.towards_deg);
}

static void tell_level(const teller *t)
{
    const scenario_level *l = &t->s->ice.level;
    const scenario_domain *d = &t->s->domain;
    const scenario_ice *i = &t->s->ice;
    if (i->source != ICE_LEVEL)
        return;
    bool moves = false;
    for (int32_t v = 0; v < scenario_vessel_count(t->s); v++)
        moves = moves || sanity_vessel_moves(scenario_vessel_entry(t->s, v).keys);
    if (!i->breakable && (moves || d->boundary == DOMAIN_FEEDING))
        sanity_say(t->tell, t->to, "ice.breakable: false makes a wall of level ice: set it to true to let it break");
    tell_sheet_outside(t);
    double mass = scenario_drift(t->s).fed ? build_ice_in_domain(t->s) : 0;
    if (automatic_or(l->mass, HUGE_VAL) < mass)
        sanity_say(t->tell, t->to,
                   "ice.level.mass: %.4g kg is less than that of the ice in the domain, %.4g kg: give all that slows "
                   "down together, in kg",
                   l->mass, mass);
}

/* ---- the material ---- */

double sanity_pressure_on(const scenario_ice *i, double strength, double area, char words[SANITY_ON_AREA])
{
    const ice_material m = {.crushing_strength = strength, .crushing_exponent = i->crushing_exponent};
    double pressure = ice_crushing_pressure(&m, area);
    snprintf(words, SANITY_ON_AREA, " on 1 m2, %.4g Pa on the thickness squared, %.4g m2,", pressure, area);
    return pressure;
}

/* The strengths of ice of a kind.  key: that of the one in crushing; whose: who has the other one. */
static void tell_pair(const teller *t, const ice_kind *k, const char *key, const char *whose)
{
    const scenario_ice *i = &t->s->ice;
    char on[SANITY_ON_AREA] = "";
    double pressure = k->crushing_strength;
    if (i->crushing_exponent != 0)
        pressure = sanity_pressure_on(i, pressure, k->thickness * k->thickness, on);
    if (pressure < k->flexural_strength)
        sanity_say(t->tell, t->to,
                   "%s: %.4g Pa%s is less than the flexural strength%s, %.4g Pa: ice is stronger in compression than "
                   "in bending; are they swapped?",
                   key, k->crushing_strength, on, whose, k->flexural_strength);
}

bool sanity_is_taken(const scenario_ice *i, const void *member)
{
    bool crushes = member == &i->crushing_strength, bends = member == &i->flexural_strength;
    bool taken = !(crushes || bends) || i->source == ICE_FILE || i->populations.count == 0;
    for (int32_t k = 0; k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        taken = taken || is_automatic(crushes ? p->crushing_strength : p->flexural_strength);
    }
    return taken;
}

double sanity_own_thickness(const scenario_ice *i, const world *made)
{
    const ice_range ice = ice_range_made(i, made);
    if (i->populations.count == 0 || !ice_is_known(&ice))
        return ice.thinnest.thickness;
    double h = i->source == ICE_FILE ? i->thickness : HUGE_VAL;
    for (int32_t k = 0; k < i->populations.count; k++)
        if (is_automatic(i->populations.data[k].crushing_strength))
            h = fmin(h, automatic_or(i->populations.data[k].thickness, i->thickness));
    return h;
}

/* Populations that have a strength of their own, and the pair of ice.* where some floe takes both.  What cannot break
   is not bent, and its flexural strength says nothing. */
static void tell_strength(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    bool taken = i->populations.count == 0 || i->source == ICE_FILE;
    for (int32_t k = 0; i->breakable && k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        if (!p->breakable)
            continue;
        bool crushes = !is_automatic(p->crushing_strength), bends = !is_automatic(p->flexural_strength);
        const ice_kind kind = ice_kind_of_population(i, p);
        char key[64] = "ice.crushing_strength", whose[48] = "";
        if (crushes)
            snprintf(key, sizeof key, "ice.populations[%d].crushing_strength", (int)k);
        else if (bends)
            snprintf(whose, sizeof whose, " of ice.populations[%d]", (int)k);
        if (crushes || bends)
            tell_pair(t, &kind, key, whose);
        taken = taken || !(crushes || bends);
    }
    const ice_kind own = {sanity_own_thickness(i, t->made), i->flexural_strength, i->crushing_strength};
    /* What crushing bears on an area goes by the thickness of ice that is known. */
    bool judged = i->crushing_exponent == 0 || !isnan(own.thickness);
    if (i->breakable && taken && judged)
        tell_pair(t, &own, "ice.crushing_strength", "");
    double thinnest = ice_range_made(i, t->made).thinnest.thickness;
    bool varies = i->strength.flexural_variation > 0 || i->strength.crushing_variation > 0;
    if (varies && i->strength.correlation_length < thinnest)
        sanity_say(t->tell, t->to,
                   "ice.strength.correlation_length: %.4g m is less than the ice is thick, %.4g m: give metres",
                   i->strength.correlation_length, thinnest);
}

/* Heights from which a floe falls, in thicknesses or metres. */
#define HIGHEST 5

/* Floes that are listed: where and how fast they begin. */
static void tell_floes(const teller *t)
{
    const scenario_ice *i = &t->s->ice;
    for (int32_t k = 0; i->source == ICE_FLOES && k < i->floes.count && t->s->environment.water; k++) {
        const scenario_floe *f = &i->floes.data[k];
        double h = automatic_or(f->thickness, i->thickness);
        double size = f->shape == FLOE_REGULAR ? f->radius : fmin(f->length, f->width);
        if (size < h)
            sanity_say(t->tell, t->to, "ice.floes[%d]: %.4g m is less than it is thick, %.4g m: give metres", (int)k,
                       size, h);
        if (!is_automatic(f->elevation) && fabs(f->elevation) > HIGHEST * fmax(1, h))
            sanity_say(
                t->tell, t->to,
                "ice.floes[%d].elevation: its centre is %.4g m %s still water: give metres, or leave it out for a "
                "floe that floats",
                (int)k, fabs(f->elevation), f->elevation > 0 ? "above" : "below");
    }
}

void sanity_tell_ice(const scenario *s, sanity_built built, sanity_teller tell, const void *to)
{
    const teller t = {s, tell, to, NULL, built.made, built.model, built.read};
    if (s->ice.source == ICE_NONE)
        return;
    tell_thresholds(&t);
    tell_field(&t);
    tell_populations(&t);
    tell_drift(&t);
    tell_level(&t);
    tell_strength(&t);
    tell_floes(&t);
}
