#include "sim/notes.h"

#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "ice/fracture.h"
#include "model/scenario_vessel.h"
#include "sim/build.h"
#include "sim/build_media.h"
#include "sim/build_model.h"
#include "sim/effective.h"
#include "sim/ice_kinds.h"
#include "sim/known_flow.h"
#include "sim/sanity.h"
#include "sim/scene_size.h"
#include "sim/vessel_speed.h"

#include <stdio.h>

/* Where notes go: to a text, facts and warnings, or to the log, warnings only. */
typedef struct note_taker {
    context *ctx;
    text_buffer *out;  /* NULL: the log */
    const world *made; /* NULL: none */
    ice_range ice;
    const model *model;        /* the same */
    const media_history *read; /* what files tell of flows; NULL: they cannot be read */
} note_taker;

enum { NOTE_SIZE = 400 };
static void note_fact(const note_taker *n, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void note_warning(const note_taker *n, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void note_fact(const note_taker *n, const char *format, ...)
{
    char text[NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (n->out)
        text_format(n->ctx, n->out, "%s\n", text);
}

static void note_warning(const note_taker *n, const char *format, ...)
{
    char text[NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (n->out)
        text_format(n->ctx, n->out, "warning: %s\n", text);
    else
        log_write(n->ctx, LOG_WARNING, "%s", text);
}

static void note_kind(const note_taker *n, const scenario *s, const ice_kind *k)
{
    const scenario_environment *e = &s->environment;
    ice_material m = ice_kind_material(&s->ice, k);
    note_fact(n, "ice: %.4g m thick, %.4g m of it under water; characteristic length l = %.4g m", k->thickness,
              k->thickness * s->ice.density / e->water_density,
              ice_characteristic_length(&m, k->thickness, e->water_density, e->gravity));
    double line = ice_crushing_pressure(&m, k->thickness) * k->thickness;
    /* With an exponent a wider face loads less, or more, per metre than a narrow one. */
    note_fact(n, "ice: crushing pressure %.4g Pa on 1 m2; a vertical face%s loads %s%s", ice_crushing_pressure(&m, 1),
              m.crushing_exponent != 0 ? " 1 m wide" : "", load_text_of(line, 4).text,
              m.crushing_exponent != 0 ? "" : " per metre of width");
}

static void note_ice(const note_taker *n, const scenario *s)
{
    const scenario_ice *i = &s->ice;
    if (i->source == ICE_NONE || !ice_is_known(&n->ice))
        return;
    double area = (s->domain.x_max - s->domain.x_min) * (s->domain.y_max - s->domain.y_min);
    note_kind(n, s, &n->ice.thinnest);
    const ice_kind *thin = &n->ice.thinnest, *thick = &n->ice.thickest;
    if (thick->thickness > thin->thickness || thick->crushing_strength > thin->crushing_strength)
        note_kind(n, s, &n->ice.thickest);
    if (i->source == ICE_FILE && !n->made)
        note_fact(n,
                  "ice: thicknesses that its file gives to floes go before that, and are known when the ice is made");
    /* Those of a population are as large as its law says. */
    if (i->source == ICE_VORONOI && i->populations.count == 0)
        note_fact(n, "ice: about %.0f cells of %.4g m2 in a domain of %.4g m2", area / i->mean_floe_area,
                  i->mean_floe_area, area);
    note_fact(n, "thresholds: floe %.4g m2, piece %.4g m2, edge %.4g m (scale %g)", i->smallest_floe_area,
              i->smallest_piece_area, i->edge_threshold, s->run.scale);
    double wedge = ice_may_break(i) ? build_wedge_area(s, &n->ice.thinnest) : 0;
    if (ice_may_break(i))
        note_fact(n, "thresholds: floes have %.2g of a wedge at least, %.3g m2 where ice breaks at rest",
                  i->smallest_floe_area / wedge, wedge);
}

/* Most of the crushing that breaks an edge, and most of the ice thickness, that a vessel may go in one step. */
#define BREAKING_STEP 0.2
#define THICKNESS_STEP 0.1
/* The smaller of the areas of contact that are shown, over the square of the thickness; the other is 1. */
#define SMALL_CONTACT 0.1

/* Of the speed that a ship makes under its own power: about what is left of it in ice that it breaks well; where less
   is wanted the rest of the power goes into the ice. */
#define OWN_POWER_IN_ICE 0.5

/* About how fast vessel and ice meet, the faster of the two counting [m/s].  What files say that
   cannot be read is not known. */
static double speed_in_ice(const note_taker *n, const scenario *s, const scenario_vessel *v)
{
    bool drifts = scenario_drift(s).fed || s->environment.water;
    return fmax(vessel_own_speed(v, OWN_POWER_IN_ICE), drifts ? known_drift(s, n->read).fastest : 0);
}

/* How far a patch as wide as the ice is thick is crushed when it bears a load [m]: from sigma (d h)^(1 + e), which with
   e = -1 bears the same from the first touch on.  NaN then. */
static double crushed_under(const ice_material *m, double thickness, double load)
{
    double sigma = m->crushing_strength, power = 1 + m->crushing_exponent;
    if (m->crushing_exponent == 0)
        return load / (sigma * thickness);
    return power > 0 ? real_pow(load / sigma, 1 / power) / thickness : (double)NAN;
}

/* Which ice it is, between two texts; nothing where all is alike.  Some may be as thick and differ in strength. */
typedef struct kind_text {
    char text[96];
} kind_text;

static kind_text kind_text_of(const note_taker *n, const char *before, const ice_kind *k, const char *after)
{
    kind_text out = {""};
    if (!ice_is_alike(&n->ice))
        snprintf(out.text, sizeof out.text, "%s%.4g m thick (bending %.4g kPa, crushing %.4g kPa)%s", before,
                 k->thickness, 1e-3 * k->flexural_strength, 1e-3 * k->crushing_strength, after);
    return out;
}

/* What breaks ice of a kind at its edge, by the loads that fracture compares (docs/theory.md). */
static void note_edge(const note_taker *n, const scenario *s, const ice_kind *kind)
{
    double h = kind->thickness, areas[2] = {SMALL_CONTACT * h * h, h * h};
    ice_material m = ice_kind_material(&s->ice, kind);
    fracture_settings f = build_fracture_settings(s);
    for (int k = 0; k < 2; k++) {
        edge_stress e = fracture_edge_stress(&f, &m, h, 1, areas[k], EDGE_STRAIGHT);
        double crushing = ice_crushing_pressure(&m, areas[k]) * areas[k];
        note_fact(n,
                  "fracture: %son %.3g m2 the radial crack opens at %s, %d wedges break off at %s, %.4g m "
                  "from the load; crushing there gives %s",
                  kind_text_of(n, "of ice ", kind, ", ").text, areas[k], load_text_of(e.radial_capacity, 4).text,
                  (int)f.wedges, load_text_of(e.wedge_capacity, 4).text, e.breaking_radius,
                  load_text_of(crushing, 4).text);
    }
}

/* Steps in which ice breaks that is soon crushed far enough: the patch of a plate at 45 degrees, as wide as the ice is
   thick, grows until the wedges break off. */
static void note_breaking_steps(const note_taker *n, const scenario *s)
{
    const ice_kind *kind = &n->ice.soonest;
    double h = kind->thickness;
    ice_material m = ice_kind_material(&s->ice, kind);
    fracture_settings f = build_fracture_settings(s);
    edge_stress e = fracture_edge_stress(&f, &m, h, 1, SMALL_CONTACT * h * h, EDGE_STRAIGHT);
    double needed = crushed_under(&m, h, e.wedge_capacity);
    for (int32_t v = 0; v < scenario_vessel_count(s) && !isnan(needed); v++) {
        vessel_entry entry = scenario_vessel_entry(s, v);
        double speed = speed_in_ice(n, s, entry.keys), depth = speed * s->run.time_step;
        note_fact(n, "fracture: %ssteps of %g s are short for %s up to %.3g m/s",
                  kind_text_of(n, "in ice ", kind, " ").text, s->run.time_step, vessel_title_of(&entry).text,
                  BREAKING_STEP * needed / s->run.time_step);
        if (depth > BREAKING_STEP * needed)
            note_warning(n,
                         "%s and the ice move %.3g m past each other in a step at %.4g m/s, and ice%s as wide as it "
                         "is thick breaks after about %.3g m of crushing; take run.time_step under %s s",
                         vessel_title_of(&entry).text, depth, speed, kind_text_of(n, " ", kind, ",").text, needed,
                         most_text_of(BREAKING_STEP * needed / speed, 3).text);
    }
}

static void note_fracture(const note_taker *n, const scenario *s)
{
    const ice_range *r = &n->ice;
    if (s->ice.source == ICE_NONE || !ice_is_known(r))
        return;
    if (!ice_may_break(&s->ice)) {
        note_fact(n, "ice: nothing breaks or splits (ice.%sbreakable: false); contacts are crushed at most",
                  s->ice.breakable ? "populations[]." : "");
        return;
    }
    note_edge(n, s, &r->soonest);
    if (!ice_kinds_alike(&r->soonest, &r->stoutest))
        note_edge(n, s, &r->stoutest);
    note_breaking_steps(n, s);
}

/* A ship under its own power keeps its heading, whatever way it has at the start [deg]. */
static double course_of(const scenario_vessel *v)
{
    return v->mode == VESSEL_FREE ? v->heading_deg : automatic_or(v->course_deg, v->heading_deg);
}

/* A channel that costs more than the ship's surroundings [m]: see docs/performance.md. */
#define LONG_CHANNEL 500.0
/* Of a ship's speed: at which pieces in its channel may fall asleep without a change of its mean load. */
#define CHANNEL_SLEEP 0.1

/* A ship that cuts a long channel through ice none of which sleeps. */
static void note_channel(const note_taker *n, const scenario *s, const vessel_entry *entry)
{
    const scenario_domain *d = &s->domain;
    double speed = vessel_own_speed(entry->keys, OWN_POWER_IN_ICE), x = d->x_max - d->x_min, y = d->y_max - d->y_min;
    double way = fmin(speed * s->run.duration, sqrt(x * x + y * y));
    if (s->ice.source != ICE_LEVEL || !s->ice.breakable || s->ice.sleep_speed > 0 ||
        way < LONG_CHANNEL * scenario_size(s))
        return;
    note_fact(n,
              "channel: %s may go %.4g m, and pieces behind it cost as much as those beside it while they are awake; "
              "ice.sleep_speed: %.2g lets them sleep",
              vessel_title_of(entry).text, way, CHANNEL_SLEEP * speed);
}

static bool is_in_domain(const scenario_domain *d, double x, double y)
{
    return x > d->x_min && x < d->x_max && y > d->y_min && y < d->y_max;
}

static void note_vessel(const note_taker *n, const scenario *s, int32_t vessel)
{
    const vessel_entry own = scenario_vessel_entry(s, vessel), *entry = &own;
    const scenario_vessel *v = entry->keys;
    vessel_title title = vessel_title_of(entry);
    double speed = speed_in_ice(n, s, v), way = speed * s->run.time_step;
    double thickness = n->ice.thinnest.thickness;
    char where[40] = "";
    if (thickness < n->ice.thickest.thickness)
        snprintf(where, sizeof where, ", where it is %.4g m thick", thickness);
    if (s->ice.source != ICE_NONE && way > THICKNESS_STEP * thickness)
        note_warning(n,
                     "%s and the ice move %.2g of its thickness past each other in a step at %.4g m/s%s; crushing "
                     "patches grow in jumps. Take run.time_step under %s s",
                     title.text, way / thickness, speed, where,
                     most_text_of(THICKNESS_STEP * thickness / speed, 3).text);
    double far = vessel_way(v, s->run.duration), course = radians(course_of(v));
    double x = v->x + far * real_cos(course), y = v->y + far * real_sin(course);
    bool leaves = !sanity_lies_outside(s, vessel, n->model) && !is_in_domain(&s->domain, x, y);
    if (vessel_keeps_course(v) && s->domain.boundary != DOMAIN_WALLS && leaves)
        note_warning(n, "%s %s the domain before the end, at (%s, %s) m", title.text,
                     v->mode == VESSEL_FREE ? "can leave" : "leaves", coordinate_text_of(x).text,
                     coordinate_text_of(y).text);
}

static void tell_warning(const void *to, const char *text) { note_warning(to, "%s", text); }

static void tell_fact(const void *to, const char *text) { note_fact(to, "%s", text); }

static void note_size(const note_taker *n, const scenario *s)
{
    scene_size size = n->made ? scene_size_made(s, n->made->floes.count) : scene_size_of(s);
    char floes[64] = "", beside[96] = "";
    if (size.uncounted)
        snprintf(beside, sizeof beside, " beside %s, which are not counted", size.uncounted);
    if (!size.uncounted || size.floes >= 0.5)
        snprintf(floes, sizeof floes, " for about %.0f floe%s", size.floes,
                 size.floes > 0.5 && size.floes < 1.5 ? "" : "s");
    note_fact(n, "memory: about %.2g GB%s%s; run.memory_limit is %g GB", size.bytes * 1e-9, floes, beside,
              s->run.memory_limit);
    note_fact(n, "disk: about %.2g MB for what the run leaves%s%s", size.disk * 1e-6, beside,
              ice_may_break(&s->ice) && s->ice.source != ICE_NONE ? ", more where ice breaks" : "");
}

static void take_notes(const note_taker *n, const scenario *s)
{
    note_fact(n, "run: %.0f steps of %g s", (double)scenario_step_at(s->run.duration, s->run.time_step),
              s->run.time_step);
    note_size(n, s);
    if (n->out)
        effective_tell(n->ctx, s, n->made, tell_fact, n);
    note_ice(n, s);
    note_fracture(n, s);
    for (int32_t v = 0; v < scenario_vessel_count(s); v++) {
        vessel_entry entry = scenario_vessel_entry(s, v);
        note_vessel(n, s, v);
        note_channel(n, s, &entry);
    }
    sanity_tell(s, (sanity_built){n->model, n->made, n->read}, tell_warning, n);
    if (s->run.solver.baumgarte)
        note_warning(n, "run.solver.baumgarte is a comparison switch; it is known to make the ice explode");
}

void notes_take_made(context *ctx, const scenario *s, const model *m, const world *made, text_buffer *out)
{
    media_history files = {0};
    bool is_read = m || build_media(ctx, s, &files, NULL) == FRAM_OK;
    const media_history *read = m ? &m->history : is_read ? &files : NULL;
    take_notes(&(note_taker){ctx, out, made, ice_range_made(&s->ice, made), m, read}, s);
    media_history_free(ctx, &files);
}

void notes_take(context *ctx, const scenario *s, text_buffer *out) { notes_take_made(ctx, s, NULL, NULL, out); }

void notes_log_warnings(context *ctx, const scenario *s, const model *m, const world *made)
{
    notes_take_made(ctx, s, m, made, NULL);
}

bool notes_ask_what_was_made(const scenario *s)
{
    const ice_drift current = scenario_current(s);
    bool tells = s->ice.source == ICE_FILE || !ice_drift_is_of_keys(&current);
    for (int32_t i = 0; i < scenario_vessel_count(s) && !tells; i++) {
        const scenario_vessel *v = scenario_vessel_entry(s, i).keys;
        tells = vessel_begins_at_equilibrium(v) || sanity_asks_of_vaning(v) || sanity_asks_of_place(s, i);
    }
    return tells;
}

fram_status notes_build_check(context *ctx, const scenario *s, hull_store *store, fram_error *error)
{
    bool when_made = notes_ask_what_was_made(s);
    fram_status status = build_check(ctx, s, store, when_made ? notes_log_warnings : NULL, error);
    if (!when_made && status == FRAM_OK)
        notes_log_warnings(ctx, s, NULL, NULL);
    return status;
}
