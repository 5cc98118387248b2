#include "sim/turning_tell.h"

#include "base/transcendental.h"
#include "sim/feed.h"

#include <math.h>

/* Moments of the run, and places of the track, at which a pattern is held against the domain. */
enum { MOMENTS = 25, PLACES = 64 };

typedef struct pattern_view {
    context *ctx;
    const scenario *s;
    const vessel_entry *entry;
    const propulsion_settings *set;
    pattern_shape shape;
} pattern_view;

/* ---- arcs ---- */

/* The tightest arc on which a pattern is at work; infinity: it is straight, or its corners are rounded as can be. */
static double least_radius(const pattern_shape *p)
{
    if (p->kind == PATTERN_CIRCLE)
        return 0.5 * p->width;
    return p->kind == PATTERN_SECTOR ? p->distance : HUGE_VAL;
}

static void tell_arcs(const pattern_view *v)
{
    const turning_ability *t = &v->set->turning;
    const pattern_shape *p = &v->shape;
    const char *what = p->kind == PATTERN_SECTOR ? "distance" : "width";
    double radius = least_radius(p), factor = p->kind == PATTERN_SECTOR ? 1 : 2;
    if (radius < t->radius)
        log_write(
            v->ctx, LOG_WARNING,
            "%s.propulsion.pattern.%s: %.4g m asks for a radius of %.4g m, and %s turns on %.4g m at full helm in "
            "open water at %.3g m/s: it cannot keep this pattern; take %.4g m or more, or a lower speed",
            v->entry->path, what, factor * radius, radius, vessel_title_of(v->entry).text, t->radius, t->speed,
            factor * t->corner);
    else if (radius < t->corner)
        log_write(
            v->ctx, LOG_WARNING,
            "%s.propulsion.pattern.%s: %.4g m asks for a radius of %.4g m; %s turns on %.4g m at full helm in open "
            "water, which leaves little helm to correct and none for ice: %.4g m or more leaves a third",
            v->entry->path, what, factor * radius, radius, vessel_title_of(v->entry).text, t->radius,
            factor * t->corner);
    if (p->kind == PATTERN_SQUARE && p->width < 2 * t->corner)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.width: corners of %.4g m radius leave nothing straight of a side of %.4g m: "
                  "the square is a circle",
                  v->entry->path, t->corner, p->width);
}

/* ---- the domain ---- */

/* Where the frame of the pattern points when the drift is this. */
static double axis_at(const model *m, const world *w, int32_t row, double time)
{
    vec2 drift = m->boundary == DOMAIN_FEEDING ? feed_drift(m, &w->inputs, time) : vec2_make(0, 0);
    return vec2_length(drift) > 0 ? real_atan2(-drift.y, -drift.x) : w->propulsion.axis[row];
}

static void tell_domain(const pattern_view *v, const model *m, const world *w, int32_t row)
{
    const scenario_domain *d = &v->s->domain;
    track path = track_of_pattern(&v->shape, v->set->turning.corner);
    if (v->s->ice.source == ICE_NONE)
        return;
    for (int i = 0; i <= MOMENTS; i++) {
        double time = v->s->run.duration * i / MOMENTS, axis = axis_at(m, w, row, time);
        double c = real_cos(axis), e = real_sin(axis);
        for (int k = 0; k < PLACES; k++) {
            vec2 at = track_at(&path, path.length * k / PLACES).at;
            double x = v->set->x + c * at.x - e * at.y, y = v->set->y + e * at.x + c * at.y;
            if (x >= d->x_min && x <= d->x_max && y >= d->y_min && y <= d->y_max)
                continue;
            log_write(
                v->ctx, LOG_WARNING,
                "%s.propulsion.pattern: at %.4g s it leads to (%.4g, %.4g) m, outside of the domain, where there is "
                "no ice: enlarge the domain, or take a smaller or nearer pattern (loops have a radius of %.4g m)",
                v->entry->path, time, x, y, v->set->turning.corner);
            return;
        }
    }
}

void turning_tell(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                  int32_t row)
{
    const propulsion_table *p = &w->propulsion;
    if (p->count == 0 || p->vessel[p->count - 1] != row)
        return;
    const propulsion_settings *set = &p->settings[p->count - 1];
    const turning_ability *t = &set->turning;
    pattern_view v = {ctx, s, entry, set, {(pattern_kind)p->pattern[p->count - 1], set->distance, set->width}};
    log_write(ctx, LOG_INFO,
              "%s turns on a radius of %.4g m at full helm in open water at %.3g m/s%s; corners and loops of its track "
              "have %.4g m",
              vessel_title_of(entry).text, t->radius, t->speed,
              s->ice.source == ICE_NONE ? "" : ", in ice on a larger one", t->corner);
    if (v.shape.kind == PATTERN_NONE)
        return;
    tell_arcs(&v);
    tell_domain(&v, m, w, p->count - 1);
}
