#include "sim/effective.h"

#include "base/transcendental.h"
#include "io/velocity_file.h"
#include "model/scenario_vessel.h"
#include "model/scenario_words.h"
#include "sim/vessel_speed.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct effective_list {
    context *ctx;
    const scenario *s;
    const world *made;
    sanity_teller tell;
    const void *to;
} effective_list;

enum { PART_SIZE = 96 };
static const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* ---- directions ---- */

/* Which eighth of the circle an angle lies in, counter-clockwise from that about 0. */
static int eighth_of(double degrees)
{
    double turned = degrees / 45 - 8 * floor(degrees / 360);
    return (int)floor(turned + 0.5) & 7;
}

/* As on a plan with x to the right and y up. */
static const char *arrow_of(double towards)
{
    static const char *const arrows[] = {"→", "↗", "↑", "↖", "←", "↙", "↓", "↘"};
    return arrows[eighth_of(towards)];
}

/* From where a flow meets a vessel of that heading, both in degrees, towards. */
static const char *meets_from(double towards, double heading)
{
    static const char *const sides[] = {"ahead",  "the port bow",          "the port beam",      "the port quarter",
                                        "astern", "the starboard quarter", "the starboard beam", "the starboard bow"};
    return sides[eighth_of(towards + 180 - heading)];
}

/* A single vessel that is where its keys say, or where it was found to begin. */
static bool meets_are_known(const effective_list *t)
{
    return scenario_vessel_count(t->s) == 1 &&
           (t->made || !vessel_begins_at_equilibrium(scenario_vessel_entry(t->s, 0).keys));
}

/* "0.4 m/s towards 180 deg ←", with where a single vessel is met. */
static void motion_words(const effective_list *t, double speed, double towards, char out[PART_SIZE])
{
    int n = snprintf(out, PART_SIZE, "%.4g m/s towards %.4g deg %s", speed, towards, arrow_of(towards));
    if (speed > 0 && meets_are_known(t))
        snprintf(out + n, PART_SIZE - (size_t)n, ", from %s", meets_from(towards, sanity_start(t->s, 0, t->made).z));
    else if (!(speed > 0))
        snprintf(out, PART_SIZE, "0");
}

static double speed_of(vec3 v) { return sqrt(v.x * v.x + v.y * v.y); }
static double bearing_of(vec3 v) { return degrees(real_atan2(v.y, v.x)); }

/* ---- wind, current, drift ---- */

/* A flow: how it is called, its file of a history, or what it is all the time. */
typedef struct flow {
    const char *name, *file;
    double speed, towards;
} flow;

static void tell_history(const effective_list *t, const flow *f, const velocity_series *h)
{
    char first[PART_SIZE], range[PART_SIZE];
    double end = t->s->run.duration, least = HUGE_VAL, most = 0, rows_end = h->time[h->count - 1];
    for (int32_t i = 0; i < h->count; i++) {
        least = fmin(least, speed_of(h->velocity[i]));
        most = fmax(most, speed_of(h->velocity[i]));
    }
    vec3 begins = velocity_series_at(h, 0), ends = velocity_series_at(h, end);
    motion_words(t, speed_of(begins), bearing_of(begins), first);
    snprintf(range, sizeof range, "%.4g to %.4g m/s", least, most);
    if (most - least < 1e-3 * most)
        snprintf(range, sizeof range, "%.4g m/s", most);
    sanity_say(
        t->tell, t->to,
        "%s: by %s, %s in %d row%s to %.6g s: %s at the start, %.4g m/s towards %.4g deg %s at the end of the run",
        f->name, file_name(f->file), range, (int)h->count, h->count == 1 ? "" : "s", rows_end, first, speed_of(ends),
        bearing_of(ends), arrow_of(bearing_of(ends)));
    if (rows_end < end)
        sanity_say(t->tell, t->to, "%s: its last row, of %.6g s, holds until the end of the run at %.6g s", f->name,
                   rows_end, end);
}

static void tell_flow(const effective_list *t, const flow *f)
{
    char words[PART_SIZE];
    if (!f->file[0]) {
        motion_words(t, f->speed, f->towards, words);
        sanity_say(t->tell, t->to, "%s: %s", f->name, f->speed > 0 ? words : "none");
        return;
    }
    velocity_series h = {0};
    fram_error error = {0};
    if (velocity_file_read(t->ctx, t->s, f->file, &h, &error) == FRAM_OK && h.count > 0)
        tell_history(t, f, &h);
    else
        sanity_say(t->tell, t->to, "%s: by %s, which cannot be read here: %s", f->name, file_name(f->file),
                   error.message);
    velocity_series_free(t->ctx, &h);
}

/* What a current has on top of it at depths. */
static void tell_profile(const effective_list *t)
{
    const char *file = t->s->environment.current_profile_file;
    current_profile p = {.count = 0};
    fram_error error = {0};
    if (!file[0])
        return;
    fram_status status = velocity_profile_read(t->ctx, t->s, file, &p, &error);
    double most = 0;
    for (int32_t i = 0; i < p.count; i++)
        most = fmax(most, vec3_length(p.velocity[i]));
    if (status == FRAM_OK)
        sanity_say(t->tell, t->to, "current: on top of that up to %.4g m/s at depths of %.4g to %.4g m, by %s", most,
                   p.depth[0], p.depth[p.count - 1], file_name(file));
    else
        sanity_say(t->tell, t->to, "current: at depths by %s, which cannot be read here: %s", file_name(file),
                   error.message);
}

/* Of two steady flows. */
static void tell_angle_between(const effective_list *t, const flow *drift, const flow *wind)
{
    if (!drift->file[0] && !wind->file[0] && drift->speed > 0 && wind->speed > 0)
        sanity_say(t->tell, t->to, "%s %s and wind %s are %.4g deg apart", drift->name, arrow_of(drift->towards),
                   arrow_of(wind->towards), sanity_degrees_apart(drift->towards, wind->towards));
}

static void list_flows(const effective_list *t)
{
    const scenario_environment *e = &t->s->environment;
    const ice_drift ice = scenario_drift(t->s);
    const flow current = {"current", e->current_file, e->current_speed, e->current_direction_deg};
    const flow wind = {"wind", e->wind_file, e->wind_speed, e->wind_direction_deg};
    const flow drift = {"drift of the ice", ice.file, ice.speed, ice.towards_deg};
    if (ice.own)
        tell_flow(t, &drift);
    else if (ice.fed)
        sanity_say(t->tell, t->to, "drift of the ice: with the current");
    tell_flow(t, &current);
    tell_profile(t);
    tell_flow(t, &wind);
    /* With a profile its row at the surface has a part in it. */
    if (!ice.profile[0])
        tell_angle_between(t, ice.own ? &drift : &current, &wind);
}

/* ---- ice ---- */

/* The law of a population's sizes, "diameters 5 to 20 m by the power 1.7". */
static void size_words(const scenario_population *p, char out[PART_SIZE])
{
    switch (p->size) {
    case SIZE_CONSTANT:
        snprintf(out, PART_SIZE, "diameter %.4g m", p->diameter);
        return;
    case SIZE_UNIFORM:
        snprintf(out, PART_SIZE, "diameters %.4g to %.4g m, uniform", p->diameter_min, p->diameter_max);
        return;
    case SIZE_LOGNORMAL:
        snprintf(out, PART_SIZE, "diameters %.4g to %.4g m, lognormal about %.4g m", p->diameter_min, p->diameter_max,
                 p->diameter);
        return;
    case SIZE_POWER:
        snprintf(out, PART_SIZE, "diameters %.4g to %.4g m, N(>D) as D^-%.3g", p->diameter_min, p->diameter_max,
                 p->exponent);
        return;
    case SIZE_HISTOGRAM:
        snprintf(out, PART_SIZE, "diameters by %.60s", file_name(p->histogram));
        return;
    }
    out[0] = '\0';
}

static void list_populations(const effective_list *t)
{
    const scenario_ice *i = &t->s->ice;
    double shares = 0;
    const char *of = i->source == ICE_FILE ? "ice between the floes of the file" : "ice area";
    if (!scenario_ice_is_drawn(i))
        return;
    for (int32_t k = 0; k < i->populations.count; k++)
        shares += i->populations.data[k].share;
    for (int32_t k = 0; k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        char sizes[PART_SIZE];
        size_words(p, sizes);
        sanity_say(t->tell, t->to, "ice: population %d of %d: %.3g %% of the %s, %s; %s", (int)k + 1,
                   (int)i->populations.count, 100 * p->share / shares, of, sizes, ice_population_text(i, k).text);
    }
}

/* ---- vessels ---- */

/* "12 mooring lines on a turret in 100 m of water, 2 thrusters, dynamic positioning". */
static void keeping_words(const scenario_vessel *v, char out[SANITY_SENTENCE / 2])
{
    size_t room = SANITY_SENTENCE / 2, n = 0;
    const setting_text lines = mooring_lines_text(v);
    out[0] = '\0';
    if (lines.text[0])
        n = (size_t)snprintf(out, room, ", %s", lines.text);
    bool pushes = v->positioning.active;
    for (int32_t i = 0; i < v->thrusters.count; i++)
        pushes = pushes || v->thrusters.data[i].setting != 0;
    if (v->thrusters.count > 0)
        n += (size_t)snprintf(out + n, room - n, ", %d thruster%s%s", (int)v->thrusters.count,
                              v->thrusters.count > 1 ? "s" : "", pushes ? "" : " at setting 0");
    if (v->positioning.active)
        n += (size_t)snprintf(out + n, room - n, ", dynamic positioning%s",
                              v->positioning.control == CONTROL_HEADING ? " of the heading alone" : "");
    if (vessel_drives_itself(v))
        snprintf(out + n, room - n, ", own propulsion");
    else if (n == 0)
        snprintf(out, room, ", held by nothing");
}

/* What goes with the heading of a free vessel. */
static const char *equilibrium_words(const effective_list *t, const scenario_vessel *v)
{
    return t->made && vessel_begins_at_equilibrium(v) ? " at the equilibrium of its mooring"
                                                      : vessel_equilibrium_text(v);
}

static void tell_vessel(const effective_list *t, int32_t vessel)
{
    const scenario_vessel *v = scenario_vessel_entry(t->s, vessel).keys;
    char kept[SANITY_SENTENCE / 2], name[64];
    snprintf(name, sizeof name, "vessel%s%.*s", v->name[0] ? " " : "", (int)VESSEL_NAME_MOST, v->name);
    if (v->path.count > 0) {
        sanity_say(t->tell, t->to, "%s: goes along a path of %d points, the last at %.6g s", name, (int)v->path.count,
                   v->path.data[v->path.count - 1].time);
    } else if (v->mode == VESSEL_FREE) {
        keeping_words(v, kept);
        double heading = sanity_start(t->s, vessel, t->made).z;
        sanity_say(t->tell, t->to, "%s: free, bow towards %.4g deg %s%s, %.4g m/s at the start%s", name, heading,
                   arrow_of(heading), equilibrium_words(t, v), v->speed, kept);
    } else {
        double course = automatic_or(v->course_deg, v->heading_deg);
        sanity_say(t->tell, t->to,
                   "%s: moves %.4g m in a step, %.4g m in the run, towards %.4g deg %s, bow towards %.4g deg %s", name,
                   v->speed * t->s->run.time_step, vessel_way(v, t->s->run.duration), course, arrow_of(course),
                   v->heading_deg, arrow_of(v->heading_deg));
    }
}

void effective_tell(context *ctx, const scenario *s, const world *made, sanity_teller tell, const void *to)
{
    const effective_list t = {ctx, s, made, tell, to};
    for (int32_t i = 0; i < scenario_vessel_count(s); i++)
        tell_vessel(&t, i);
    list_populations(&t);
    list_flows(&t);
}
