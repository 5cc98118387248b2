/* A capability plot as files: tables for programs, a chart for people. */
#include "sim/capability.h"

#include "base/transcendental.h"
#include "io/atomic_file.h"
#include "io/image.h"
#include "io/polar.h"
#include "model/scenario_vessel.h"
#include "sim/run_folder.h"

#include <stdio.h>

enum { WORD = 24 };
typedef char word[WORD];

static double degrees_of(const capability *c, int32_t row) { return 360.0 * row / c->loads.directions; }

/* "thruster 3", "offset", "none" */
static void limit_word(const capability_limit *l, word out)
{
    if (l->beyond)
        snprintf(out, WORD, "none");
    else if (l->at.number >= 0)
        snprintf(out, WORD, "%s %d", holding_item_name(l->at.item), (int)l->at.number + 1);
    else
        snprintf(out, WORD, "%s", l->at.item == HOLDING_NOTHING ? "no equilibrium" : holding_item_name(l->at.item));
}

/* Where the vessel is held after all of them none is the worst. */
static void failure_word(const capability *c, const capability_limit *l, word out)
{
    if (l->failure < 0 || l->beyond)
        snprintf(out, WORD, "none");
    else
        snprintf(out, WORD, "%s %d", c->failure[l->failure].line ? "line" : "thruster",
                 (int)c->failure[l->failure].number + 1);
}

/* Of a table, with a word where there is none. */
static void add_cell(context *ctx, text_buffer *b, double value, const char *otherwise, const char *end)
{
    if (isfinite(value))
        text_real_or_null(ctx, b, value);
    else
        text_add(ctx, b, otherwise);
    text_add(ctx, b, end);
}

static void add_number(context *ctx, text_buffer *b, double value, const char *end)
{
    text_real_or_null(ctx, b, value);
    text_add(ctx, b, end);
}

/* ---- tables ---- */

static void limits_table(context *ctx, const capability *c, text_buffer *b)
{
    text_add(ctx, b,
             "from_bow_clockwise[deg],speed_intact[m/s],limited_by,speed_after_failure[m/s],failure,"
             "then_limited_by\n");
    for (int32_t i = 0; i < c->loads.directions; i++) {
        word by, failure, then;
        limit_word(&c->intact[i], by);
        failure_word(c, &c->damaged[i], failure);
        limit_word(&c->damaged[i], then);
        add_cell(ctx, b, degrees_of(c, i), "", ",");
        add_cell(ctx, b, c->intact[i].speed, "", ",");
        text_format(ctx, b, "%s,", by);
        if (c->failures > 0)
            add_cell(ctx, b, c->damaged[i].speed, "", ",");
        text_format(ctx, b, c->failures > 0 ? "%s,%s\n" : ",none,none\n", failure, then);
    }
}

static void use_table(context *ctx, const capability *c, text_buffer *b)
{
    text_add(ctx, b,
             "from_bow_clockwise[deg],speed[m/s],use[1],thruster_use[1],line_use[1],offset[m],turn[deg],"
             "ice_surge[N],ice_sway[N],ice_yaw[N m],load_surge[N],load_sway[N],load_yaw[N m]\n");
    for (int32_t i = 0; i < c->loads.directions; i++) {
        for (int32_t k = 0; k < c->loads.speeds; k++) {
            int32_t cell = i * c->loads.speeds + k;
            const holding *h = &c->use[cell];
            double speed = (k + 1) * c->loads.speed_step, from = degrees_of(c, i);
            vec3 ice = c->loads.ice[capability_row(c, i) * c->loads.speeds + k],
                 load = capability_load_at(c, radians(from), speed);
            const double row[] = {from,  speed, h->use, h->thruster_use, h->line_use, h->offset, degrees(h->turn),
                                  ice.x, ice.y, ice.z,  load.x,          load.y,      load.z};
            int count = sizeof row / sizeof *row;
            for (int j = 0; j < count; j++)
                add_cell(ctx, b, row[j], "inf", j + 1 < count ? "," : "\n");
        }
    }
}

static void limit_object(context *ctx, const capability_limit *l, text_buffer *b)
{
    word by;
    limit_word(l, by);
    text_add(ctx, b, "{\"speed\": ");
    add_number(ctx, b, l->speed, ", ");
    text_format(ctx, b, "\"held_at_all_speeds\": %s, \"limited_by\": \"%s\"", l->beyond ? "true" : "false", by);
}

static void add_member(context *ctx, text_buffer *b, const char *name, double value)
{
    text_format(ctx, b, "  \"%s\": ", name);
    add_number(ctx, b, value, ",\n");
}

static const char *ice_load_source(const capability *c)
{
    return c->loads.measured ? "measured" : c->thickness > 0 ? "formula" : "none";
}

/* What of the runs the ice is made after, and as how much of it. */
static void met_object(context *ctx, const capability *c, text_buffer *b)
{
    const capability_met_ice *met = c->options.met;
    const managed_law *law = &met->law;
    text_add(ctx, b, "  \"ice_from\": {\"runs\": [");
    for (int32_t i = 0; i < met->run_count; i++) {
        text_add(ctx, b, i > 0 ? ", " : "");
        text_quoted(ctx, b, met->runs[i]);
    }
    text_add(ctx, b, "], \"windows\": ");
    add_number(ctx, b, met->windows, ", \"concentration\": ");
    add_number(ctx, b, law->concentration, ", \"thickness_m\": ");
    add_number(ctx, b, law->thickness, ", \"mean_size_m\": ");
    add_number(ctx, b, law->mean, ", \"largest_m\": ");
    add_number(ctx, b, law->largest, ", \"unbroken\": ");
    add_number(ctx, b, law->sheet, ", \"unbroken_as_m\": ");
    add_number(ctx, b, met->sheet_as, ", \"window_m\": ");
    add_number(ctx, b, c->side, "},\n");
}

/* A histogram as ice.populations takes it. */
static void sizes_table(context *ctx, const capability *c, text_buffer *b)
{
    const managed_law *law = &c->options.met->law;
    text_add(ctx, b, "diameter_min[m],diameter_max[m],floes[1]\n");
    for (int32_t i = 0; i < law->bins; i++) {
        add_cell(ctx, b, law->edge[i], "", ",");
        add_cell(ctx, b, law->edge[i + 1], "", ",");
        add_cell(ctx, b, law->weight[i], "", "\n");
    }
}

static void compose(context *ctx, const capability *c, text_buffer *b)
{
    const capability_options *o = &c->options;
    text_format(ctx, b, "{\n  \"ice_load\": \"%s\",\n", ice_load_source(c));
    add_member(ctx, b, "measuring_time_s", c->loads.measured ? o->measure : (double)NAN);
    /* Growth from nothing is infinite, and stands as null. */
    text_format(ctx, b, "  \"ice_load_still_building\": %s,\n",
                !c->loads.measured        ? "null"
                : capability_builds_up(c) ? "true"
                                          : "false");
    add_member(ctx, b, "ice_load_growth", c->loads.measured ? c->loads.growth : (double)NAN);
    add_member(ctx, b, "ice_load_growth_speed_m_s", c->loads.measured ? c->loads.growth_speed : (double)NAN);
    add_member(ctx, b, "wind_speed_m_s", c->wind_speed);
    add_member(ctx, b, "ice_thickness_m", c->thickness);
    add_member(ctx, b, "ice_concentration", c->concentration);
    add_member(ctx, b, "allowance", o->allowance);
    add_member(ctx, b, "line_safety_intact", o->line_safety);
    add_member(ctx, b, "line_safety_after_failure", o->line_safety_damaged);
    add_member(ctx, b, "speed_step_m_s", o->speed_step);
    add_member(ctx, b, "speed_most_m_s", c->loads.speeds * c->loads.speed_step);
    if (o->met)
        met_object(ctx, c, b);
    text_add(ctx, b, "  \"directions\": [");
    for (int32_t i = 0; i < c->loads.directions; i++) {
        text_format(ctx, b, "%s\n    {\"from_bow_clockwise_deg\": ", i > 0 ? "," : "");
        add_number(ctx, b, degrees_of(c, i), ", \"intact\": ");
        limit_object(ctx, &c->intact[i], b);
        text_add(ctx, b, "}");
        if (c->failures > 0) {
            word failure;
            failure_word(c, &c->damaged[i], failure);
            text_add(ctx, b, ", \"after_worst_failure\": ");
            limit_object(ctx, &c->damaged[i], b);
            text_format(ctx, b, ", \"failure\": \"%s\"}", failure);
        }
        text_add(ctx, b, ", \"use\": [");
        for (int32_t k = 0; k < c->loads.speeds; k++)
            add_number(ctx, b, c->use[i * c->loads.speeds + k].use, k + 1 < c->loads.speeds ? ", " : "]}");
    }
    text_add(ctx, b, "]\n}\n");
}

typedef void (*writer)(context *ctx, const capability *c, text_buffer *b);

static fram_status write_one(context *ctx, const capability *c, writer write, const char *name, fram_error *error)
{
    char path[PATH_ROOM];
    text_buffer b = {0};
    write(ctx, c, &b);
    fram_status status = path_own(c->options.folder, name, path, error);
    if (status == FRAM_OK)
        status = text_file_write(ctx, path, &b, error);
    text_free(ctx, &b);
    return status;
}

/* ---- chart ---- */

static const capability_limit *least_of(const capability_limit *limits, int32_t count)
{
    const capability_limit *least = limits;
    for (int32_t i = 1; i < count; i++)
        if (limits[i].speed < least->speed)
            least = &limits[i];
    return least;
}

static void describe_least(context *ctx, const capability *c, const char *name, const capability_limit *limits,
                           text_buffer *b)
{
    const capability_limit *l = least_of(limits, c->loads.directions);
    word by, failure;
    limit_word(l, by);
    failure_word(c, l, failure);
    text_format(ctx, b, "%s: at least %.3g m/s, from %.0f deg", name, l->speed, degrees_of(c, (int32_t)(l - limits)));
    if (l->failure >= 0 && !l->beyond)
        text_format(ctx, b, ",\n  without %s", failure);
    text_format(ctx, b, l->beyond ? ": no limit met\n" : ",\n  limit: %s\n", by);
}

static void describe(context *ctx, const scenario *s, const capability *c, text_buffer *b)
{
    const capability_options *o = &c->options;
    describe_least(ctx, c, "Intact", c->intact, b);
    if (c->failures > 0)
        describe_least(ctx, c, "One lost", c->damaged, b);
    text_add(ctx, b, "\nDrift, current and wind come from the same side.\n");
    if (c->thickness > 0)
        text_format(ctx, b, "Ice: %.3g m, %.3g %%; load %s\n", c->thickness, 100 * c->concentration,
                    c->loads.measured ? "measured in runs of" : "by Zuev's formula");
    if (c->thickness > 0 && !c->loads.measured)
        text_add(ctx, b, "  for some 20 deg about the bow; abeam it is\n  many times too large\n");
    if (o->met)
        text_format(ctx, b, "Managed ice as in %g windows of %d %s\n  before the vessel; floes of %.3g m by area\n",
                    o->met->windows, (int)o->met->run_count, o->met->run_count > 1 ? "runs" : "run", o->met->law.mean);
    if (c->loads.measured)
        text_format(ctx, b, "  %g s, highest third of the peaks\n", o->measure);
    if (capability_builds_up(c))
        text_add(ctx, b, "  that were still building up\n");
    text_format(ctx, b, "Wind: %.3g m/s\n", c->wind_speed);
    text_format(ctx, b, "Allowance on mean loads: %.3g\n", o->allowance);
    int32_t row = o->vessel ? scenario_find_vessel(s, o->vessel) : 0;
    const scenario_vessel *keys = scenario_vessel_entry(s, row).keys;
    if (keys->name[0])
        text_format(ctx, b, "Vessel %s alone\n", keys->name);
    if (keys->mooring.lines.count > 0)
        text_format(ctx, b, "Lines: breaking load over %.3g intact, %.3g after\n  a failure\n", o->line_safety,
                    o->line_safety_damaged);
    if (keys->mooring.lines.count > 0 && keys->mooring.turret)
        text_add(ctx, b, "The ship is kept at its angle to the drift.\n");
    text_add(ctx, b, "Static balance: no motion, no waves, no losses\nof thrust.\n");
}

static fram_status draw_capability(context *ctx, const scenario *s, const capability *c, const char *name,
                                   fram_error *error)
{
    size_t directions = (size_t)c->loads.directions, cells = directions * (size_t)c->loads.speeds;
    double *intact = memory_array(ctx, directions, sizeof *intact), *value = memory_array(ctx, cells, sizeof *value);
    double *damaged = memory_array(ctx, directions, sizeof *damaged);
    word *words = memory_array(ctx, directions, sizeof *words);
    const char **outer = memory_array(ctx, directions, sizeof *outer);
    text_buffer text = {0};
    bool good = intact && damaged && value && words && outer;
    for (size_t i = 0; good && i < directions; i++) {
        intact[i] = c->intact[i].speed;
        damaged[i] = c->damaged[i].speed;
        limit_word(&c->intact[i], words[i]);
        outer[i] = c->intact[i].beyond ? "" : words[i];
    }
    for (size_t i = 0; good && i < cells; i++)
        value[i] = c->use[i].use;
    const polar_curve curves[2] = {{"limit, intact", intact, false},
                                   {"limit after the worst single failure", damaged, true}};
    describe(ctx, s, c, &text);
    polar_chart p = {.title = s->title[0] ? s->title : "Fram",
                     .subtitle = "Capability: drift speed [m/s] up to which the vessel is held, by the direction the "
                                 "drift comes from, and what limits it",
                     .radius_label = "drift speed [m/s]",
                     .value_label = "largest part of a limit in use, intact",
                     .directions = c->loads.directions,
                     .rings = c->loads.speeds,
                     .ring_step = c->loads.speed_step,
                     .value = value,
                     .curves = curves,
                     .curve_count = c->failures > 0 ? 2 : 1,
                     .outer = outer,
                     .text = text.data};
    char path[PATH_ROOM];
    fram_status status = path_own(c->options.folder, name, path, error);
    if (status == FRAM_OK)
        status = good && !text.failed ? polar_write(ctx, &p, path, error) : error_memory(error);
    text_free(ctx, &text);
    memory_free(ctx, intact);
    memory_free(ctx, damaged);
    memory_free(ctx, value);
    memory_free(ctx, words);
    memory_free(ctx, outer);
    return status;
}

fram_status capability_write(context *ctx, const scenario *s, const capability_options *o, char path[PATH_ROOM],
                             fram_error *error)
{
    capability c;
    fram_status status = run_folder_check(o->folder, o->force, error);
    if (status == FRAM_OK)
        status = capability_find(ctx, s, o, &c, error);
    if (status != FRAM_OK)
        return status;
    status = run_folder_make(o->folder, error);
    if (status == FRAM_OK)
        status = write_one(ctx, &c, limits_table, "capability.csv", error);
    if (status == FRAM_OK)
        status = write_one(ctx, &c, use_table, "capability_use.csv", error);
    if (status == FRAM_OK && o->met)
        status = write_one(ctx, &c, sizes_table, CAPABILITY_FLOES, error);
    if (status == FRAM_OK)
        status = write_one(ctx, &c, compose, "capability.json", error);
    if (status == FRAM_OK && image_available())
        status = draw_capability(ctx, s, &c, "capability.png", error);
    if (status == FRAM_OK && image_available())
        status = draw_capability(ctx, s, &c, "capability.svg", error);
    if (status == FRAM_OK)
        status = path_join(o->folder, image_available() ? "capability.png" : "capability.json", path, error);
    capability_free(ctx, &c);
    return status;
}
