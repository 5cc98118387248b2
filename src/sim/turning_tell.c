#include "sim/turning_tell.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/build_propulsion.h"
#include "sim/propulsion_forces.h"
#include "sim/turning.h"
#include "sim/vessel_speed.h"

#include <math.h>
#include <stdio.h>

/* Moments of the run, and places of the track, at which a pattern is held against the domain. */
enum { MOMENTS = 25, PLACES = 64 };

typedef struct pattern_view {
    context *ctx;
    const scenario *s;
    const vessel_entry *entry;
    const propulsion_settings *set;
    pattern_shape shape;
    const model *m;
    int32_t vessel;
} pattern_view;

/* ---- arcs ---- */

/* The tightest arc on which a pattern is at work; infinity: it is straight, or its corners are rounded as can be. */
static double least_radius(const pattern_shape *p)
{
    if (p->kind == PATTERN_CIRCLE)
        return 0.5 * p->width;
    return p->kind == PATTERN_SECTOR ? p->distance : HUGE_VAL;
}

/* Whether the hull turns on by itself on all that were tried. */
static bool turns_on(const pattern_view *v)
{
    return turning_is_sought_no_further(&v->set->turning, &v->m->vessels.data[v->vessel]) &&
           turning_goes_on(v->ctx, v->m, v->vessel, v->set);
}

/* What was found of a ship at full helm. */
typedef struct turn_text {
    char text[256];
} turn_text;

static turn_text turn_text_of(const pattern_view *v)
{
    const turning_ability *t = &v->set->turning;
    const vessel_title title = vessel_title_of(v->entry);
    turn_text out;
    if (turns_on(v))
        snprintf(out.text, sizeof out.text,
                 "no steady turn of %s was found at full helm in open water at %.3g m/s down to a radius of %.4g m",
                 title.text, t->speed, t->radius);
    else
        snprintf(out.text, sizeof out.text, "%s turns on %.4g m at full helm in open water at %.3g m/s", title.text,
                 t->radius, t->speed);
    return out;
}

/* What gives a ship more helm. */
static const char *helm_key(const pattern_view *v)
{
    return v->set->rudder.area > 0 ? "rudder_area" : "steering_angle_deg";
}

/* What to take as wide, before what else would do; nothing where no turn is wide enough. */
typedef struct wide_text {
    char text[40];
} wide_text;

static wide_text wide_text_of(double least)
{
    wide_text out = {""};
    if (isfinite(least))
        snprintf(out.text, sizeof out.text, "%s m or more, or ", least_text_of(least, 4).text);
    return out;
}

/* checked: the tightest turn that its helm stops. */
static void tell_arcs(const pattern_view *v, double checked)
{
    const turning_ability *t = &v->set->turning;
    const pattern_shape *p = &v->shape;
    const char *what = p->kind == PATTERN_SECTOR ? "distance" : "width";
    double radius = least_radius(p), factor = p->kind == PATTERN_SECTOR ? 1 : 2;
    char under[40] = "however wide";
    if (isfinite(checked))
        snprintf(under, sizeof under, "under %.4g m", checked);
    const wide_text wide = wide_text_of(factor * fmax(t->corner, checked));
    if (radius < t->radius)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.%s: %.4g m asks for a radius of %.4g m, and %s: it cannot keep this pattern; "
                  "take %sa lower speed",
                  v->entry->path, what, factor * radius, radius, turn_text_of(v).text, wide.text);
    else if (radius < checked)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.%s: %.4g m asks for a radius of %.4g m; %s the hull of %s turns on by itself, "
                  "which takes most of its helm and leaves none for ice: take %sa larger %s",
                  v->entry->path, what, factor * radius, radius, under, vessel_title_of(v->entry).text, wide.text,
                  helm_key(v));
    else if (radius < t->corner)
        log_write(
            v->ctx, LOG_WARNING,
            "%s.propulsion.pattern.%s: %.4g m asks for a radius of %.4g m; %s, which leaves little helm, or time to "
            "put it over, to correct, and none for ice: take %s m or more",
            v->entry->path, what, factor * radius, radius, turn_text_of(v).text,
            least_text_of(factor * t->corner, 4).text);
    if (p->kind == PATTERN_SQUARE && p->width < 2 * t->corner)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.width: corners of %.4g m radius leave nothing straight of a side of %.4g m: "
                  "the square is a circle",
                  v->entry->path, t->corner, p->width);
}

/* ---- legs ---- */

/* How far a loop at a corner reaches beyond it, in radii: 3.5 where the ship goes back, 4.3 at 135 degrees. */
#define LOOP_FAR 4.3

/* A vessel's part of the table of courses, with where it begins before that. */
typedef struct course_part {
    vec2 begins;
    const vec2 *place;
    int32_t count;
    double length; /* of the ship [m] */
} course_part;

static course_part course_part_of(const world *w, int32_t row)
{
    const course_table *c = &w->course;
    int32_t first = 0, vessel = w->propulsion.vessel[row];
    while (first < c->count && c->vessel[first] != vessel)
        first++;
    course_part out = {w->propulsion.from[row], c->place + first, 0, w->vessels.length[vessel]};
    while (first + out.count < c->count && c->vessel[first + out.count] == vessel)
        out.count++;
    return out;
}

/* Which of the way points that are given place i of the course is: some are left out there. */
static int key_of(const pattern_view *v, const course_part *c, int32_t i)
{
    const scenario_propulsion *p = &v->entry->keys->propulsion;
    int32_t key = course_first(p, c->begins, c->length);
    for (int32_t k = 0; k < i; k++)
        key = course_next(p, key, c->length);
    return (int)key;
}

/* The first way point that is too near to the one before to lead anywhere, after those where the ship begins. */
static void tell_near_points(const pattern_view *v, const course_part *c)
{
    const scenario_propulsion *p = &v->entry->keys->propulsion;
    for (int32_t last = course_first(p, c->begins, c->length), next; last < p->waypoints.count; last = next) {
        next = course_next(p, last, c->length);
        if (next == last + 1)
            continue;
        const scenario_course_point *a = &p->waypoints.data[last], *b = a + 1;
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.waypoints[%d]: it is %.4g m from the point before: a leg of less than a twentieth of "
                  "the ship's length leads nowhere, so that it is left out; leave it out, or put it farther off",
                  v->entry->path, (int)last + 1, vec2_length(vec2_make(b->x - a->x, b->y - a->y)));
        return;
    }
}

/* Place i of the course; -1: where it begins. */
static vec2 place_of_course(const course_part *c, int32_t i) { return i < 0 ? c->begins : c->place[i]; }

static double length_of_leg(const course_part *c, int32_t i)
{
    return vec2_length(vec2_sub(c->place[i], place_of_course(c, i - 1)));
}

/* The radius of the corner at a place. */
static double radius_left(const course_part *c, int32_t i, double radius)
{
    vec2 point[5];
    int32_t count = 0, first = i > 0 ? i - 2 : -1;
    for (int32_t k = first; k <= i + 2 && k < c->count; k++)
        point[count++] = place_of_course(c, k);
    return track_corner_left(point, count, i - first, radius);
}

/* The corner that its legs leave the least of its radius. */
static void tell_short_legs(const pattern_view *v, const course_part *c)
{
    double radius = v->set->turning.corner, least = radius;
    int32_t at = 0, count = 0;
    for (int32_t i = 0; i + 1 < c->count; i++) {
        double left = radius_left(c, i, radius);
        count += left < radius;
        at = left < least ? i : at;
        least = fmin(left, least);
    }
    if (count > 0)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.waypoints[%d]: legs of %.4g and %.4g m leave its corner %.4g m of a radius of %.4g m, "
                  "the least of %d that %s less: take longer legs, or a lower speed",
                  v->entry->path, key_of(v, c, at), length_of_leg(c, at), length_of_leg(c, at + 1), least, radius,
                  (int)count, count == 1 ? "has" : "have");
}

/* Whether it turns anywhere, but for what rounding makes of points on one line. */
static bool course_turns(const course_part *c)
{
    const double rounding = 1e-6;
    for (int32_t i = 0; i + 1 < c->count; i++) {
        vec2 before = vec2_sub(c->place[i], place_of_course(c, i - 1)), after = vec2_sub(c->place[i + 1], c->place[i]);
        double along = vec2_dot(before, after);
        if (fabs(vec2_cross(before, after)) > rounding * along)
            return true;
    }
    return false;
}

/* The first corner that is too sharp to be rounded. */
static void tell_loop(const pattern_view *v, const course_part *c)
{
    for (int32_t i = 0; i + 1 < c->count; i++) {
        if (!track_turns_about(i > 0 ? c->place[i - 1] : c->begins, c->place[i], c->place[i + 1]))
            continue;
        log_write(v->ctx, LOG_INFO,
                  "%s.propulsion.waypoints[%d]: a corner of more than 135 degrees: %s turns about on a loop, which "
                  "reaches up to %.0f m beyond it",
                  v->entry->path, key_of(v, c, i), vessel_title_of(v->entry).text, LOOP_FAR * v->set->turning.corner);
        return;
    }
}

/* ---- the domain ---- */

/* A place of the track over the ground at a time. */
static vec2 place_at(const pattern_view *v, const model *m, const world *w, int32_t row, const track *path, double time,
                     double way)
{
    vec2 place = {v->set->x, v->set->y};
    track_place comes = propulsion_comes(m, w, row, time, way);
    bool drifts = vec2_length(comes.at) > 0;
    double axis = drifts ? real_atan2(comes.at.y, comes.at.x) : w->propulsion.axis[row];
    if (v->shape.kind == PATTERN_AHEAD)
        return vec2_add(place, drifts ? comes.at : vec2_scale(vec2_make(real_cos(axis), real_sin(axis)), way));
    vec2 at = track_at(path, way).at;
    double c = real_cos(axis), e = real_sin(axis);
    return vec2_add(place, vec2_make(c * at.x - e * at.y, e * at.x + c * at.y));
}

/* The speed that a period asks for, and what the ship makes at its power. */
static void tell_period(const pattern_view *v, const model *m)
{
    const scenario_propulsion *p = &v->entry->keys->propulsion;
    const propulsion_settings *set = v->set;
    double length = track_of_pattern(&v->shape, set->turning.corner).length;
    double least = propulsion_least_lack(set->open_water_speed);
    if (is_automatic(p->pattern.period))
        return;
    double lost = vessel_speed_lost_in_ice(v->s, &m->history, set->speed);
    if (set->speed > set->open_water_speed)
        log_write(
            v->ctx, LOG_WARNING,
            "%s.propulsion.pattern.period: a round of %.4g m in %.4g s asks for %.4g m/s, and %s makes %.4g m/s in "
            "open water at that power: take %s s or more",
            v->entry->path, length, p->pattern.period, set->speed, vessel_title_of(v->entry).text,
            set->open_water_speed, least_text_of(length / set->open_water_speed, 4).text);
    else if (lost < least && v->s->ice.source != ICE_NONE)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.period: a round of %.4g m in %.4g s asks for %.4g m/s, at which %s, stopped "
                  "by ice, pushes with %.2g %% of its pull: it never counts as beset and waits; take less than %s s",
                  v->entry->path, length, p->pattern.period, set->speed, vessel_title_of(v->entry).text,
                  100 * propulsion_push(set->open_water_speed, lost), most_text_of(length / least, 4).text);
    else if (set->speed <= set->beset_speed)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.pattern.period: a round of %.4g m in %.4g s asks for %.4g m/s, and %s counts as beset "
                  "under %.3g m/s (propulsion.beset_speed): take less than %s s",
                  v->entry->path, length, p->pattern.period, set->speed, vessel_title_of(v->entry).text,
                  set->beset_speed, most_text_of(length / set->beset_speed, 4).text);
}

/* Without the rounding about an axis. */
static double tidy(double metres) { return fabs(metres) < 1e-6 ? 0 : metres; }

/* Whether a place is in the domain, so far from its edges. */
static bool is_inside(const pattern_view *v, vec2 at, double room)
{
    vec2 edges = domain_edges_from(&v->s->domain, at);
    return fmin(edges.x, edges.y) >= room;
}

/* Whether a place is in the domain; tells if it is not. */
static bool place_is_inside(const pattern_view *v, double time, vec2 at)
{
    if (is_inside(v, at, 0))
        return true;
    log_write(v->ctx, LOG_WARNING,
              "%s.propulsion.pattern: at %.4g s it leads to (%s, %s) m, outside of the domain, where there is "
              "no ice: enlarge the domain, or take a smaller or nearer pattern (loops have a radius of %.4g m)",
              v->entry->path, time, coordinate_text_of(tidy(at.x)).text, coordinate_text_of(tidy(at.y)).text,
              v->set->turning.corner);
    return false;
}

/* How far the way ahead has led at a time, if the ship is as fast as it is told to be. */
static double way_ahead(const pattern_view *v, const world *w, int32_t row, double time)
{
    vec3 at = w->bodies.position[w->vessels.body[w->propulsion.vessel[row]]];
    double begun = vec2_length(vec2_make(at.x - v->set->x, at.y - v->set->y));
    return begun + fmin(v->set->speed, v->set->open_water_speed) * time;
}

/* The first loop at a way point that leads out of the domain within the run: into a wall, where half the beam is room
   for the hull, or to where there is no ice. */
static void tell_loop_outside(const pattern_view *v, const course_part *c, double beam)
{
    const bool walls = v->s->domain.boundary == DOMAIN_WALLS;
    double fastest = fmin(v->set->speed, v->set->open_water_speed), way = 0;
    if (!walls && v->s->ice.source == ICE_NONE)
        return;
    for (int32_t i = 0; i + 1 < c->count; i++) {
        const vec2 legs[] = {i > 0 ? c->place[i - 1] : c->begins, c->place[i], c->place[i + 1]};
        double leg = vec2_length(vec2_sub(legs[1], legs[0])), end;
        way += leg;
        if (!track_turns_about(legs[0], legs[1], legs[2]))
            continue;
        const track path = track_of_legs(legs, 3, 0, v->set->turning.corner, &end);
        for (int k = 1; k < PLACES; k++) {
            double on = (end - leg) * k / PLACES;
            vec2 at = track_at(&path, leg + on).at;
            if (way + on > fastest * v->s->run.duration)
                return;
            if (is_inside(v, at, walls ? 0.5 * beam : 0))
                continue;
            log_write(v->ctx, LOG_WARNING,
                      "%s.propulsion.waypoints[%d]: the loop on which %s turns about there leads to (%s, %s) m, %s: "
                      "enlarge the domain, put the point farther in, or take a lower speed",
                      v->entry->path, key_of(v, c, i), vessel_title_of(v->entry).text,
                      coordinate_text_of(tidy(at.x)).text, coordinate_text_of(tidy(at.y)).text,
                      walls ? "where the hull meets a wall of the domain"
                            : "outside of the domain, where there is no ice");
            return;
        }
        way += end - leg;
    }
}

static void tell_outside(const pattern_view *v, const model *m, const world *w, int32_t row)
{
    track path = track_of_pattern(&v->shape, v->set->turning.corner);
    int places = v->shape.kind == PATTERN_AHEAD ? 1 : PLACES;
    if (v->s->ice.source == ICE_NONE)
        return;
    for (int i = 0; i <= MOMENTS; i++)
        for (int k = 0; k < places; k++) {
            double time = v->s->run.duration * i / MOMENTS;
            double way = path.closed ? path.length * k / PLACES : way_ahead(v, w, row, time);
            if (!place_is_inside(v, time, place_at(v, m, w, row, &path, time, way)))
                return;
        }
}

static void tell_radius(const pattern_view *v)
{
    const turning_ability *t = &v->set->turning;
    const vessel_model *hull = &v->m->vessels.data[v->vessel];
    bool differ = v->m->forces == FORCES_FLUID && turning_sides_differ(hull),
         least = turning_is_sought_no_further(t, hull);
    const char *wider =
        differ ? " to the side on which it turns wider, since those of its current_coefficients differ" : "";
    if (turning_is_found(t) && turns_on(v))
        log_write(v->ctx, LOG_INFO,
                  "no steady turn of %s was found at full helm in open water at %.3g m/s down to a radius of %.4g m%s: "
                  "this hull turns on by itself; corners and loops of its track have %.4g m",
                  vessel_title_of(v->entry).text, t->speed, t->radius, wider, t->corner);
    else if (turning_is_found(t))
        log_write(v->ctx, LOG_INFO,
                  "%s turns on a radius of %.4g m%s at full helm in open water at %.3g m/s%s%s; corners and loops of "
                  "its track have %.4g m",
                  vessel_title_of(v->entry).text, t->radius, least ? " or less" : "", t->speed, wider,
                  v->s->ice.source == ICE_NONE ? "" : ", in ice on a larger one", t->corner);
    else
        log_write(v->ctx, LOG_INFO,
                  "%s does not turn by its helm%s at %.3g m/s; corners and loops of its track are taken as %.4g m",
                  vessel_title_of(v->entry).text, differ ? " to both sides" : "", t->speed, t->corner);
}

/* A helm that rudders can be given and that turns the ship no more. */
static void tell_helm_of_use(const pattern_view *v)
{
    double given = v->entry->keys->propulsion.steering_angle_deg, most = degrees(v->set->steering_most);
    if (radians(given) > v->set->steering_most)
        log_write(v->ctx, LOG_WARNING,
                  "%s.propulsion.steering_angle_deg: past %.3g degrees of helm the rudders of %s turn it no more, at "
                  "%.3g m/s: the rest of %.3g is without effect",
                  v->entry->path, most, vessel_title_of(v->entry).text, v->set->turning.speed, given);
}

/* Whether a pattern has corners or loops: a circle has its own radius, and the way ahead is straight. */
static bool has_corners(const pattern_shape *p) { return p->kind != PATTERN_CIRCLE && p->kind != PATTERN_AHEAD; }

/* A ship whose helm stops no turn as tight as its corners are. */
static void tell_unchecked(const pattern_view *v, double checked)
{
    const turning_ability *t = &v->set->turning;
    if (t->corner >= checked)
        return;
    char from[60] = ", however wide";
    if (isfinite(checked))
        snprintf(from, sizeof from, " with a radius under %.4g m", checked);
    log_write(v->ctx, LOG_WARNING,
              "%s.propulsion.%s: the helm of %s does not stop a turn at %.3g m/s%s, since its hull turns on by itself: "
              "on corners and loops of %.4g m it may turn right round; give a larger %s or a turning_radius",
              v->entry->path, helm_key(v), vessel_title_of(v->entry).text, t->speed, from, t->corner, helm_key(v));
}

void turning_tell(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                  int32_t row)
{
    const propulsion_table *p = &w->propulsion;
    if (p->count == 0 || p->vessel[p->count - 1] != row)
        return;
    const propulsion_settings *set = &p->settings[p->count - 1];
    const turning_ability *t = &set->turning;
    pattern_view v = {
        ctx, s, entry, set, {(pattern_kind)p->pattern[p->count - 1], set->distance, set->width, set->aside}, m, row};
    tell_radius(&v);
    tell_helm_of_use(&v);
    double checked = turning_is_found(t) ? turning_checked_radius(ctx, m, row, set) : 0;
    if (v.shape.kind == PATTERN_NONE) {
        course_part legs = course_part_of(w, p->count - 1);
        if (course_turns(&legs))
            tell_unchecked(&v, checked);
        tell_near_points(&v, &legs);
        tell_short_legs(&v, &legs);
        tell_loop(&v, &legs);
        tell_loop_outside(&v, &legs, m->vessels.data[row].particulars.beam);
        return;
    }
    if (s->domain.boundary != DOMAIN_FEEDING)
        log_write(ctx, LOG_INFO,
                  "%s: its pattern points as its bow does at the start, whatever the current, since no ice drifts "
                  "through (domain.boundary: feeding)",
                  vessel_title_of(entry).text);
    if (has_corners(&v.shape))
        tell_unchecked(&v, checked);
    if (turning_is_found(t))
        tell_arcs(&v, checked);
    tell_period(&v, m);
    tell_outside(&v, m, w, p->count - 1);
}
