#include "sim/rest_tell.h"

#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "vessel/mooring.h"

#include <math.h>
#include <stdio.h>

/* Angles and masses from which on a start is no rest [deg, 1]. */
#define TOLD_ANGLE 5.0
#define TOLD_MASS 0.1
/* Angle from which on it is named beside what is told [deg], 0.1 to TOLD_ANGLE. */
#define NAMED_ANGLE 1.0
/* Part of what a hull displaces under which no mass is advised, well over the least that a vessel may have
   (sim/vessel_check.c). */
#define ADVISED_MASS 0.1

/* How far a start is from rest: by the vessel's mass or centre of gravity, by what its lines pull down with, by both
   together, which may hold each other. */
typedef struct unrest {
    double own, lines, both;
} unrest;

static bool is_of_own(unrest u, double most) { return fabs(u.own) > most && fabs(u.both) > most && u.own * u.both > 0; }

static bool is_of_lines(unrest u, double most)
{
    return fabs(u.both) > most && u.lines * u.both > 0 && (fabs(u.lines) > most || !is_of_own(u, most));
}

/* What lines pull a vessel down with, and that force times the place where it acts, ship coordinates. */
typedef struct line_burden {
    double force; /* [N] */
    vec3 moment;  /* [N m] */
} line_burden;

static line_burden burden_of(const world *w, int32_t row, vec3 centre)
{
    int32_t body = w->vessels.body[row];
    line_burden sum = {0};
    for (int32_t i = 0; i < w->lines.count; i++) {
        if (w->lines.vessel[i] != row || w->lines.release_time[i] <= 0)
            continue;
        line_pull pull = mooring_line_pull(&w->lines, i, w->bodies.position[body], w->bodies.orientation[body]);
        /* It parts in the first step, which lets those go that are due. */
        if (pull.tension > w->lines.breaking_load[i])
            continue;
        sum.force -= pull.force.z;
        sum.moment = vec3_mad(sum.moment, vec3_add(body_to_local(&w->bodies, body, pull.point), centre), -pull.force.z);
    }
    return sum;
}

typedef struct rest_view {
    context *ctx;
    const scenario *s;
    const vessel_entry *entry;
    const vessel_model *hull;
    const hull_hydrostatics *upright;
    line_burden lines;
    double mass;  /* own [kg] */
    double slice; /* height of the middle of what lines make the hull displace, ship coordinates [m] */
} rest_view;

/* By small angles about the start [deg]. */
static double lean_angle(double arm, double gm) { return degrees(real_atan2(arm, gm)); }

/* A metacentric height with lines: what pulls down at a height takes from the righting moment as a weight there does,
   and what it makes the hull displace bears in its middle. */
static double moored_height(const rest_view *v, double gm)
{
    return gm - (v->lines.moment.z - v->lines.force * v->slice) / (v->mass * v->s->environment.gravity);
}

/* arm: of the centre of gravity [m]; moment: of the lines about the centre of flotation [N m].  Both metacentric
   heights, without lines and with them, are over 0. */
static unrest lean_of(const rest_view *v, double arm, double moment, double gm)
{
    double lever = moment / (v->mass * v->s->environment.gravity), moored = moored_height(v, gm);
    return (unrest){lean_angle(arm, gm), lean_angle(lever, moored), lean_angle(arm + lever, moored)};
}

static void warn_of_lean(const rest_view *v, unrest lean, const char *key, const char *what, double arm)
{
    if (is_of_own(lean, TOLD_ANGLE))
        log_write(v->ctx, LOG_WARNING,
                  "%s.%s: the vessel %s by about %.0f degrees, since its centre of gravity is %.4g m off",
                  v->entry->path, key, what, fabs(lean.own), fabs(arm));
}

/* Their stiffness, which may hold a vessel upright, is not looked at. */
static void warn_of_height(const rest_view *v, const char *which, double gm, double moored)
{
    double over = -moored * v->mass * v->s->environment.gravity / v->lines.force;
    log_write(v->ctx, LOG_WARNING,
              "%s.mooring.lines: the vessel capsizes unless their stiffness holds it: they pull it down with %s, "
              "which takes its %s metacentric height from %.4g m to %.4g m; lower %s.mooring.z, %.4g m, by more than "
              "%s m, or let the lines pull less",
              v->entry->path, load_text_of(v->lines.force, 4).text, which, gm, moored, v->entry->path,
              v->lines.moment.z / v->lines.force, least_text_of(over, 3).text);
}

/* false: the vessel capsizes, and has no list or trim. */
static bool tell_stability(const rest_view *v, unrest *heel, unrest *trim)
{
    const hull_hydrostatics *f = v->upright;
    const vec3 centre = v->hull->centre, moment = v->lines.moment;
    double lift = f->centre_of_buoyancy.z - centre.z, down = v->lines.force;
    double gm = f->waterplane_xx / f->volume + lift, gm_long = f->waterplane_yy / f->volume + lift;
    if (!(gm > 0) || !(gm_long > 0)) {
        log_write(v->ctx, LOG_WARNING,
                  "the vessel capsizes: its %s metacentric height is %s m where it floats; lower "
                  "%s.centre_of_gravity_z, %.4g m, by more than that",
                  gm > 0 ? "longitudinal" : "transverse", most_text_of(gm > 0 ? gm_long : gm, 4).text, v->entry->path,
                  centre.z);
        return false;
    }
    double across = moored_height(v, gm), along = moored_height(v, gm_long);
    if (!(across > 0) || !(along > 0)) {
        warn_of_height(v, across > 0 ? "longitudinal" : "transverse", across > 0 ? gm_long : gm,
                       across > 0 ? along : across);
        return false;
    }
    double x = centre.x - f->centre_of_buoyancy.x, y = centre.y - f->centre_of_buoyancy.y;
    *trim = lean_of(v, x, moment.x - down * f->centre_of_flotation.x, gm_long);
    *heel = lean_of(v, y, moment.y - down * f->centre_of_flotation.y, gm);
    warn_of_lean(v, *heel, "centre_of_gravity_y", "heels", y);
    warn_of_lean(v, *trim, "centre_of_gravity_x", "trims", x);
    return true;
}

/* Towed hulls are free to heave. */
static void warn_of_mass(const rest_view *v, unrest sink)
{
    if (is_of_own(sink, TOLD_MASS))
        log_write(v->ctx, LOG_WARNING,
                  "%s.mass is %.3g of what the hull displaces at its draught: it begins by moving up or down to its "
                  "own waterline",
                  v->entry->path, v->mass / v->hull->displaced_mass);
}

/* ---- lines ---- */

static bool leans_by_lines(unrest lean) { return is_of_lines(lean, NAMED_ANGLE); }

/* Where the centre of gravity of a mass balances lines at the design draught, along one axis [m]. */
static double balanced_centre(const rest_view *v, double mass, double moment, double buoyancy)
{
    return buoyancy - (moment - v->lines.force * buoyancy) / (mass * v->s->environment.gravity);
}

/* Upright at the design draught, to which lines bring a vessel of that mass. */
static bool stands_at_rest(const rest_view *v, double mass)
{
    const hull_hydrostatics *f = &v->hull->floats;
    double metacentre = fmin(f->waterplane_xx, f->waterplane_yy) / f->volume + f->centre_of_buoyancy.z;
    double righting = v->hull->displaced_mass * metacentre - mass * v->hull->centre.z;
    return righting * v->s->environment.gravity > v->lines.moment.z;
}

static void advise_rest(const rest_view *v, bool trims, bool heels, char *out, size_t size)
{
    double mass = v->hull->displaced_mass - v->lines.force / v->s->environment.gravity;
    vec3 buoyancy = v->hull->floats.centre_of_buoyancy;
    double x = balanced_centre(v, mass, v->lines.moment.x, buoyancy.x);
    double y = balanced_centre(v, mass, v->lines.moment.y, buoyancy.y);
    box2 line = v->hull->floats.waterline;
    bool inside = (!trims || (x > line.lo.x && x < line.hi.x)) && (!heels || (y > line.lo.y && y < line.hi.y));
    char forward[64] = "", aside[64] = "";
    if (!(mass > ADVISED_MASS * v->hull->displaced_mass) || !inside || !stands_at_rest(v, mass)) {
        snprintf(out, size, "it needs lines that pull less");
        return;
    }
    if (trims)
        snprintf(forward, sizeof forward, ", centre_of_gravity_x %.4g m", x);
    if (heels)
        snprintf(aside, sizeof aside, ", centre_of_gravity_y %.4g m", y);
    snprintf(out, size, "with %s.mass %.6g kg%s%s it begins at rest", v->entry->path, mass, forward, aside);
}

/* Upper bounds, since lines that give way pull less: their stiffness is not looked at. */
static void warn_of_pull(const rest_view *v, unrest sink, unrest trim, unrest heel)
{
    bool sinks = is_of_lines(sink, TOLD_MASS);
    char sinking[64] = "", trimming[64] = "", heeling[64] = "", advice[256];
    if (!sinks && !is_of_lines(trim, TOLD_ANGLE) && !is_of_lines(heel, TOLD_ANGLE))
        return;
    if (sinks)
        snprintf(sinking, sizeof sinking, " sinking by up to about %.2g m",
                 sink.both * v->hull->floats.volume / v->upright->waterplane_area);
    if (leans_by_lines(trim))
        snprintf(trimming, sizeof trimming, "%s trimming by up to about %.2g degrees", sinks ? "," : "",
                 fabs(trim.both));
    if (leans_by_lines(heel))
        snprintf(heeling, sizeof heeling, "%s heeling by up to about %.2g degrees", sinks || trimming[0] ? "," : "",
                 fabs(heel.both));
    advise_rest(v, leans_by_lines(trim), leans_by_lines(heel), advice, sizeof advice);
    log_write(v->ctx, LOG_WARNING,
              "%s.mooring.lines: they pull the vessel down with %s, %.3g of what it displaces: it begins by%s%s%s; "
              "%s",
              v->entry->path, load_text_of(v->lines.force, 4).text, sink.lines, sinking, trimming, heeling, advice);
}

void rest_tell(context *ctx, const scenario *s, const vessel_entry *entry, const vessel_model *hull,
               const hull_hydrostatics *upright, const world *w, int32_t row)
{
    if (entry->keys->mode == VESSEL_PRESCRIBED || !s->environment.water || !(hull->floats.volume > 0))
        return;
    rest_view v = {.ctx = ctx,
                   .s = s,
                   .entry = entry,
                   .hull = hull,
                   .upright = upright,
                   .lines = burden_of(w, row, hull->centre),
                   .mass = automatic_or(entry->keys->mass, hull->displaced_mass)};
    double own = v.mass / hull->displaced_mass - 1;
    double lines = v.lines.force / (hull->displaced_mass * s->environment.gravity);
    const unrest sink = {own, lines, own + lines};
    if (upright->waterplane_area > 0)
        v.slice = (own + 0.5 * lines) * hull->floats.volume / upright->waterplane_area;
    unrest heel = {0}, trim = {0};
    bool floats = entry->keys->mode == VESSEL_FREE && upright->volume > 0;
    bool stands = floats && tell_stability(&v, &heel, &trim);
    warn_of_mass(&v, sink);
    if (stands)
        warn_of_pull(&v, sink, trim, heel);
}
