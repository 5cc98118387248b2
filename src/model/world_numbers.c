#include "model/world_check.h"

#include "model/world_invariants.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Every number of every table is looked at: a column that is added is checked without a word here, and one that may
   hold what no other may is named below. */

/* No place, velocity, angle or time is beyond [m, m/s, rad, rad/s, s]: a hundred thousand times the widest domain,
   where a step's products are still numbers, and cells of the broad phase have their own. */
#define FAR 1e12
/* Of any other number, a mass or a force say: products of some are still numbers. */
#define MOST 1e60

/* Units of what FAR holds for. */
static const char *const far_units[] = {"m", "m/s", "s", "1", "rad", "rad/s", "m, m, rad", "m, 1"};

/* Where a rule of `nothing beyond` is not meant. */
typedef enum real_kind {
    REAL_ENDLESS, /* not under 0; infinity means that there is no such limit, or that it never comes */
    REAL_SETTING, /* any number, infinity too */
    REAL_POSITIVE /* finite, and not under 0, in every row */
} real_kind;

static const struct real_rule {
    const char *table, *column;
    real_kind kind;
} real_rules[] = {
    /* "none" */
    {"station", "offset_limit", REAL_ENDLESS},
    {"station", "heading_limit", REAL_ENDLESS},
    {"line", "breaking_load", REAL_ENDLESS},
    {"propulsion", "settings", REAL_SETTING}, /* a speed: as fast as it goes; a track error: no limit */
    /* "never" */
    {"line", "release_time", REAL_ENDLESS},
    {"thruster", "failure_time", REAL_ENDLESS},
    /* springs that push where they should pull feed a world with energy, and sizes are some */
    {"joint", "stiffness", REAL_POSITIVE},
    {"joint", "damping", REAL_POSITIVE},
    {"line", "stiffness", REAL_POSITIVE},
    {"line", "length", REAL_POSITIVE},
    {"line", "weight", REAL_POSITIVE},
    {"thruster", "time_constant", REAL_POSITIVE},
    {"thruster", "speed_rate", REAL_POSITIVE},
    {"thruster", "turn_rate", REAL_POSITIVE},
    {"shape", "half_height", REAL_POSITIVE},
    {"shape", "radius", REAL_POSITIVE},
    {"shape", "plan_radius", REAL_POSITIVE},
    {"shape", "area", REAL_POSITIVE},
    {"pattern", "radius", REAL_POSITIVE},
    {"vessel", "length", REAL_POSITIVE},
    {"vessel", "beam", REAL_POSITIVE},
    {"vessel", "draught", REAL_POSITIVE},
    {"vessel", "tow_ramp", REAL_POSITIVE},
    {"broad", "travel", REAL_POSITIVE},
    {"held_drag", "half", REAL_POSITIVE},
    {"held_drag", "reach", REAL_POSITIVE},
    /* masses, and what pushes or costs by its size alone */
    {"body", "mass", REAL_POSITIVE},
    {"body", "added_mass", REAL_POSITIVE},
    {"drift", "mass", REAL_POSITIVE},
    {"thruster", "ahead", REAL_POSITIVE},
    {"thruster", "astern", REAL_POSITIVE},
    {"thruster", "forbidden_half", REAL_POSITIVE},
    {"thruster", "cost", REAL_POSITIVE},
    {"thruster", "full_power", REAL_POSITIVE},
    {"station", "lever", REAL_POSITIVE},
    {"station", "feed_time", REAL_POSITIVE},
    {"station", "noise", REAL_POSITIVE},
};
enum { REAL_RULES = sizeof real_rules / sizeof *real_rules };

static fram_status refuse_real(const char *table, int32_t row, const char *column, double found, fram_error *error)
{
    char key[80];
    snprintf(key, sizeof key, "%s[%d].%s", table, (int)row, column);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "the state cannot be: found %g", found);
}

/* What the numbers of a column lie between. */
typedef struct real_range {
    double least, most;
} real_range;

static real_range range_of(const table_info *table, const field_info *field)
{
    double most = MOST;
    for (size_t i = 0; i < sizeof far_units / sizeof *far_units; i++)
        most = strcmp(field->unit, far_units[i]) == 0 ? FAR : most;
    real_range range = {-most, most};
    for (int i = 0; i < REAL_RULES; i++) {
        const struct real_rule *rule = &real_rules[i];
        if (strcmp(rule->table, table->name) != 0 || strcmp(rule->column, field->name) != 0)
            continue;
        range = (real_range){rule->kind == REAL_SETTING ? -HUGE_VAL : 0, rule->kind == REAL_POSITIVE ? most : HUGE_VAL};
    }
    return range;
}

static fram_status check_reals(const world_table *t, const field_info *field, fram_error *error)
{
    const real_range range = range_of(t->info, field);
    const double *value = table_field(t->table, field);
    const int64_t count = (int64_t)((const table_head *)t->table)->count * field->components;
    bool good = true;
    for (int64_t i = 0; i < count; i++)
        good = good && value[i] >= range.least && value[i] <= range.most;
    for (int64_t i = 0; i < count && !good; i++) {
        if (!(value[i] >= range.least && value[i] <= range.most))
            return refuse_real(t->info->name, (int32_t)(i / field->components), field->name, value[i], error);
    }
    return FRAM_OK;
}

/* The rules name columns that are there, which a test sees to. */
static fram_status check_columns(const world *w, fram_error *error)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(w, tables);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        for (int f = 0; f < tables[t].info->field_count; f++) {
            const field_info *field = &tables[t].info->fields[f];
            fram_status status = field->kind == FIELD_F64 ? check_reals(&tables[t], field, error) : FRAM_OK;
            if (status != FRAM_OK)
                return status;
        }
    }
    return FRAM_OK;
}

/* Axes of joints turn vectors, and stretch them where they are no unit quaternions. */
#define FRAME_ROUNDING 1e-9

static bool is_frame(quat q) { return fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) <= FRAME_ROUNDING; }

static fram_status check_frames(const joint_table *j, fram_error *error)
{
    for (int32_t i = 0; i < j->count; i++) {
        if (!is_frame(j->frame_a[i]))
            return refuse_real("joint", i, "frame_a", j->frame_a[i].w, error);
        if (!is_frame(j->frame_b[i]))
            return refuse_real("joint", i, "frame_b", j->frame_b[i].w, error);
    }
    return FRAM_OK;
}

/* What no step leaves: quaternions of another length, bodies that move without mass, static ones that move, rows out of
   order. */
static fram_status check_invariants(const model *m, const world *w, fram_error *error)
{
    char text[INVARIANT_TEXT];
    if (!world_invariant_broken(m, w, text))
        return FRAM_OK;
    char *what = strstr(text, ": ");
    if (what)
        *what = '\0';
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, text, "the state cannot be: %s", what ? what + 2 : "");
}

/* Both sizes of a row are positive. */
static fram_status check_sizes(const char *table, int32_t row, double area, const char *column, double height,
                               fram_error *error)
{
    if (!(area > 0 && isfinite(area)))
        return refuse_real(table, row, "area", area, error);
    return height > 0 && isfinite(height) ? FRAM_OK : refuse_real(table, row, column, height, error);
}

static fram_status check_material(const char *table, int32_t row, const ice_material *m, fram_error *error)
{
    const double positive[] = {m->density, m->elastic_modulus, m->flexural_strength, m->crushing_strength};
    for (size_t i = 0; i < sizeof positive / sizeof *positive; i++) {
        if (!(positive[i] > 0 && isfinite(positive[i])))
            return refuse_real(table, row, "material", positive[i], error);
    }
    if (!(m->poisson_ratio >= 0 && m->poisson_ratio < 0.5))
        return refuse_real(table, row, "material", m->poisson_ratio, error);
    return fabs(m->crushing_exponent) <= 1 ? FRAM_OK : refuse_real(table, row, "material", m->crushing_exponent, error);
}

static fram_status check_ice_rows(const world *w, fram_error *error)
{
    const floe_table *f = &w->floes;
    const shape_table *s = &w->shapes.shapes;
    const pattern_table *p = &w->pattern;
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < f->count && status == FRAM_OK; i++) {
        if (f->body[i] >= 0)
            status = check_sizes("floe", i, f->area[i], "thickness", f->thickness[i], error);
        if (f->body[i] >= 0 && status == FRAM_OK)
            status = check_material("floe", i, &f->material[i], error);
    }
    for (int32_t i = 0; i < s->count && status == FRAM_OK; i++) {
        if (s->kind[i] == SHAPE_PRISM)
            status = check_sizes("shape", i, s->area[i], "half_height", s->half_height[i], error);
    }
    for (int32_t i = 0; i < p->count && status == FRAM_OK; i++) {
        status = check_sizes("pattern", i, p->area[i], "thickness", p->thickness[i], error);
        if (status == FRAM_OK)
            status = check_material("pattern", i, &p->material[i], error);
    }
    return status;
}

fram_status world_check_numbers(const model *m, const world *w, fram_error *error)
{
    fram_status status = check_columns(w, error);
    if (status == FRAM_OK)
        status = check_frames(&w->joints, error);
    if (status == FRAM_OK)
        status = check_ice_rows(w, error);
    return status == FRAM_OK ? check_invariants(m, w, error) : status;
}
