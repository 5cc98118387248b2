#include "model/world_check.h"

#include "vessel/allocation.h"

#include <stdio.h>
#include <string.h>

/* A column of whole numbers: from least up to most, or to the last row of another table. */
typedef struct column_rule {
    const char *table, *column;
    int64_t least, most;
    const char *below; /* table whose rows are named; NULL: most holds */
} column_rule;

/* A floe may be left behind by any number of tiles, but not by so many that the next one cannot be counted. */
#define TILES_AWAY 1000000000
/* Counts go on from what is loaded: far beyond every run, and the next ones are numbers too. */
#define COUNT_MOST ((int64_t)1 << 53)
#define FLOES_MOST (1 << 30)

static const column_rule column_rules[] = {
    {"body", "motion", MOTION_NONE, MOTION_ASLEEP, NULL},
    {"body", "material", 0, MATERIAL_COUNT - 1, NULL},
    {"body", "shape", -1, 0, "shape"},
    {"shape", "kind", SHAPE_NONE, SHAPE_SOLID, NULL},
    {"floe", "body", -1, 0, "body"},
    {"vessel", "body", 0, 0, "body"},
    {"vessel", "carriage", -1, 0, "body"},
    {"vessel", "joint", -1, 0, "joint"},
    {"vessel", "mode", VESSEL_PRESCRIBED, VESSEL_FREE, NULL},
    {"joint", "a", -1, 0, "body"},
    {"joint", "b", 0, 0, "body"},
    {"pair", "a", 0, 0, "body"},
    {"pair", "b", 0, 0, "body"},
    {"line", "vessel", 0, 0, "station"}, /* whose row has the loads of the vessel's lines and thrusters */
    {"line", "kind", LINE_CATENARY, LINE_TABLE, NULL},
    {"line", "points", 0, LINE_POINTS, NULL},
    {"thruster", "vessel", 0, 0, "station"},
    {"thruster", "kind", THRUSTER_TUNNEL, THRUSTER_MAIN, NULL},
    {"waypoint", "vessel", 0, 0, "vessel"},
    {"station", "observer", OBSERVER_PASSIVE, OBSERVER_KALMAN, NULL},
    {"station", "feed", FEED_NONE, FEED_OBSERVED, NULL},
    {"station", "heading_rule", HEADING_FIXED, HEADING_VANING, NULL},
    {"event", "kind", 0, EVENT_COUNT - 1, NULL},
    {"propulsion", "vessel", 0, 0, "vessel"},
    {"propulsion", "pattern", PATTERN_NONE, PATTERN_AHEAD, NULL},
    {"propulsion", "forecast", 0, 1, NULL},
    {"propulsion", "phase", PROPULSION_AHEAD, PROPULSION_ASTERN, NULL},
    {"propulsion", "leg", 0, INT32_MAX, NULL},
    {"course", "vessel", 0, 0, "vessel"},
    {"approach", "vessel", 0, 0, "vessel"},
    {"approach", "other", 0, 0, "vessel"},
    {"approach", "close", 0, 1, NULL},
    {"event", "vessel", 0, 0, "vessel"},
    {"pattern", "state", PATTERN_OUTSIDE, PATTERN_HELD_BACK, NULL},
    {"pattern", "body", -1, 0, "body"},
    {"pattern_copy", "row", 0, 0, "pattern"},
    {"pattern_copy", "body", 0, 0, "body"},
    {"pattern_copy", "tiles_x", -TILES_AWAY, TILES_AWAY, NULL},
    {"pattern_copy", "tiles_y", -TILES_AWAY, TILES_AWAY, NULL},
    {"input", "kind", 0, INPUT_KIND_COUNT - 1, NULL},
    {"flooding", "face", FLOODING_NONE, FLOODING_BOTTOM, NULL},
    {"flooding", "drowned", 0, 1, NULL},
    {"hull_retreat", "floe", 0, 0, "floe"},
    {"hull_retreat", "surface", 0, 0, "body"},
    {"clock", "step", 0, COUNT_MOST, NULL},
    {"clock", "splits", 0, COUNT_MOST, NULL},
    {"clock", "bendings", 0, COUNT_MOST, NULL},
    {"clock", "next_floe", 0, FLOES_MOST, NULL},
    {"feeding", "entered_floes", 0, COUNT_MOST, NULL},
    {"feeding", "held_back_floes", 0, COUNT_MOST, NULL},
    {"drift", "column", -COUNT_MOST, COUNT_MOST, NULL},
    {"drift", "row", -COUNT_MOST, COUNT_MOST, NULL},
    {"propulsion", "rounds", 0, COUNT_MOST, NULL},
    {"propulsion", "besets", 0, COUNT_MOST, NULL},
    {"propulsion", "rams", 0, COUNT_MOST, NULL},
};

/* Rows of a table: from least to most, or to as many as another has. */
static const column_rule count_rules[] = {
    {"clock", NULL, 1, 1, NULL},       {"feeding", NULL, 0, 1, NULL},     {"broad", NULL, 0, 0, "body"},
    {"recorded", NULL, 0, 0, "body"},  {"station", NULL, 0, 0, "vessel"}, {"drift", NULL, 0, 1, NULL},
    {"held_drag", NULL, 0, 0, "body"}, {"flooding", NULL, 0, 0, "body"},  {"rest", NULL, 0, 0, "body"},
};

static fram_status refuse(const char *table, int64_t row, const char *column, int64_t found, fram_error *error)
{
    char key[80];
    snprintf(key, sizeof key, column ? "%s[%lld].%s" : "%s", table, (long long)row, column ? column : "");
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "the state cannot be: found %lld%s", (long long)found,
                     column ? "" : " rows");
}

/* NULL never comes: the rules name tables that are there, which a test sees to. */
static const world_table *find_table(const world_table *tables, const char *name)
{
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        if (strcmp(tables[t].info->name, name) == 0)
            return &tables[t];
    }
    return NULL;
}

static const field_info *find_field(const table_info *info, const char *name)
{
    for (int f = 0; f < info->field_count; f++) {
        if (strcmp(info->fields[f].name, name) == 0)
            return &info->fields[f];
    }
    return NULL;
}

static int32_t rows_of(const world_table *t) { return ((const table_head *)t->table)->count; }

static int64_t number_at(const world_table *t, const field_info *field, int32_t row)
{
    const char *at = (const char *)table_field(t->table, field) + (size_t)row * field->size;
    int32_t i32;
    int64_t i64;
    switch (field->kind) {
    case FIELD_U8:
        return *(const uint8_t *)at;
    case FIELD_I32:
        memcpy(&i32, at, sizeof i32);
        return i32;
    default:
        memcpy(&i64, at, sizeof i64);
        return i64;
    }
}

static int64_t most_of(const world_table *tables, const column_rule *rule, int64_t beyond)
{
    const world_table *below = rule->below ? find_table(tables, rule->below) : NULL;
    return below ? (int64_t)rows_of(below) - beyond : rule->most;
}

static fram_status check_column(const world_table *tables, const column_rule *rule, fram_error *error)
{
    const world_table *t = find_table(tables, rule->table);
    const field_info *field = t ? find_field(t->info, rule->column) : NULL;
    if (!field)
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, rule->column, "there is no such column");
    int64_t most = most_of(tables, rule, 1);
    for (int32_t row = 0; row < rows_of(t); row++) {
        int64_t value = number_at(t, field, row);
        if (value < rule->least || value > most)
            return refuse(rule->table, row, rule->column, value, error);
    }
    return FRAM_OK;
}

/* `size` rows from `first` on are some of `count`. */
static bool is_span(int32_t first, int32_t size, int32_t least, int32_t count)
{
    return first >= 0 && size >= least && size <= count && first <= count - size;
}

static bool piece_is_sound(const shape_store *s, int32_t piece, int32_t outline_count)
{
    int32_t first = s->pieces.first[piece], size = s->pieces.size[piece];
    if (size > PIECE_MOST_VERTICES || !is_span(first, size, 3, s->vertices.count))
        return false;
    for (int32_t v = first; v < first + size; v++) {
        if (s->vertices.corner[v] < -1 || s->vertices.corner[v] >= outline_count)
            return false;
    }
    return true;
}

static bool shape_is_sound(const shape_store *s, int32_t row)
{
    const shape_table *t = &s->shapes;
    if (t->kind[row] == SHAPE_SOLID)
        return t->solid[row] >= 0 && t->solid[row] < (s->solids ? s->solids->count : 0);
    if (t->kind[row] != SHAPE_PRISM)
        return true;
    bool good = is_span(t->outline_first[row], t->outline_count[row], 3, s->vertices.count) &&
                is_span(t->piece_first[row], t->piece_count[row], 1, s->pieces.count);
    for (int32_t k = 0; k < t->piece_count[row] && good; k++)
        good = piece_is_sound(s, t->piece_first[row] + k, t->outline_count[row]);
    return good;
}

static fram_status check_shapes(const shape_store *s, fram_error *error)
{
    for (int32_t i = 0; i < s->shapes.count; i++) {
        if (!shape_is_sound(s, i))
            return refuse("shape", i, "outline_first", s->shapes.outline_first[i], error);
    }
    return FRAM_OK;
}

/* A body that lives is owned by a row of the table of its material, and has a shape that is there. */
static fram_status check_bodies(const world *w, fram_error *error)
{
    const body_table *b = &w->bodies;
    for (int32_t i = 0; i < b->count; i++) {
        if (b->motion[i] == MOTION_NONE)
            continue;
        int32_t rows = b->material[i] == MATERIAL_ICE ? w->floes.count : w->vessels.count;
        if (b->owner[i] < -1 || (b->owner[i] >= rows && b->material[i] != MATERIAL_WALL))
            return refuse("body", i, "owner", b->owner[i], error);
        if (b->shape[i] >= 0 && w->shapes.shapes.kind[b->shape[i]] == SHAPE_NONE)
            return refuse("body", i, "shape", b->shape[i], error);
        if (b->owner[i] < 0 && b->shape[i] >= 0 && b->material[i] != MATERIAL_WALL)
            return refuse("body", i, "owner", b->owner[i], error);
        if (b->motion[i] == MOTION_ASLEEP && (i >= w->rest.count || w->rest.generation[i] != b->generation[i]))
            return refuse("body", i, "motion", b->motion[i], error);
    }
    return FRAM_OK;
}

/* A vessel has a hull of its own, and one that is towed a carriage. */
static fram_status check_vessels(const world *w, fram_error *error)
{
    const body_table *b = &w->bodies;
    for (int32_t v = 0; v < w->vessels.count; v++) {
        int32_t body = w->vessels.body[v], carriage = w->vessels.carriage[v];
        bool own = body_is_alive(b, body) && b->material[body] == MATERIAL_HULL && b->owner[body] == v;
        if (!own || b->shape[body] < 0 || w->shapes.shapes.kind[b->shape[body]] != SHAPE_SOLID)
            return refuse("vessel", v, "body", body, error);
        if (w->vessels.mode[v] == VESSEL_TOWED && (carriage < 0 || !body_is_alive(b, carriage)))
            return refuse("vessel", v, "carriage", carriage, error);
    }
    return FRAM_OK;
}

/* The body was boxed when pairs were looked for, so that it had a shape; it may have broken since, which the next step
   sees by its box. */
static bool has_box(const world *w, int32_t body) { return body < w->boxes.count && w->boxes.generation[body] != 0; }

/* Of two bodies, the lower slot first. */
static fram_status check_pairs(const world *w, fram_error *error)
{
    for (int32_t i = 0; i < w->pairs.count; i++) {
        int32_t a = w->pairs.a[i], b = w->pairs.b[i];
        if (!has_box(w, a) || !has_box(w, b))
            return refuse("pair", i, has_box(w, a) ? "b" : "a", has_box(w, a) ? b : a, error);
        if (a >= b)
            return refuse("pair", i, "b", b, error);
    }
    return FRAM_OK;
}

static fram_status check_floes(const world *w, int32_t tiles, fram_error *error)
{
    const floe_table *f = &w->floes;
    for (int32_t i = 0; i < f->count; i++) {
        if (f->body[i] < 0)
            continue;
        int32_t shape = w->bodies.shape[f->body[i]];
        if (shape < 0 || w->shapes.shapes.kind[shape] != SHAPE_PRISM || w->bodies.owner[f->body[i]] != i)
            return refuse("floe", i, "body", f->body[i], error);
        if (f->tile[i] < 0 || f->tile[i] > tiles)
            return refuse("floe", i, "tile", f->tile[i], error);
        if (f->number[i] < 0 || f->number[i] >= w->clock.next_floe[0])
            return refuse("floe", i, "number", f->number[i], error);
    }
    for (int32_t i = 0; i < w->pattern.count; i++) {
        if (!is_span(w->pattern.first[i], w->pattern.size[i], 3, w->pattern_vertices.count))
            return refuse("pattern", i, "first", w->pattern.first[i], error);
    }
    for (int32_t i = 0; i < w->drift_cells.count; i++) {
        if (!is_span(w->drift_cells.first[i], w->drift_cells.size[i], 0, w->drift_vertices.count))
            return refuse("drift_cell", i, "first", w->drift_cells.first[i], error);
    }
    return FRAM_OK;
}

/* Stations that are kept have their intervals, and no vessel has more thrusters than can be allocated. */
static fram_status check_stations(const world *w, fram_error *error)
{
    for (int32_t v = 0; v < w->vessels.count; v++) {
        bool kept = station_is_kept(&w->stations, &w->vessels, v);
        if (kept && w->stations.control_every[v] < 1)
            return refuse("station", v, "control_every", w->stations.control_every[v], error);
        if (kept && w->stations.sample_every[v] < 1)
            return refuse("station", v, "sample_every", w->stations.sample_every[v], error);
        int32_t thrusters = 0;
        for (int32_t i = 0; i < w->thrusters.count; i++)
            thrusters += w->thrusters.vessel[i] == v;
        if (thrusters > ALLOCATION_MOST / 2)
            return refuse("thruster", 0, NULL, thrusters, error);
    }
    return FRAM_OK;
}

/* Lines by a table have no stiffness; those of states from when offsets were along the line, whose length is another
   one, have. */
static fram_status check_lines(const line_table *l, fram_error *error)
{
    for (int32_t i = 0; i < l->count; i++) {
        char key[48];
        snprintf(key, sizeof key, "line[%d].stiffness", (int)i);
        if (l->kind[i] == LINE_TABLE && l->stiffness[i] != 0)
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key,
                             "expected a line by its table without stiffness, found one of before offsets were "
                             "horizontal: start the run again");
    }
    return FRAM_OK;
}

static fram_status check_inputs(const world *w, fram_error *error)
{
    for (int32_t i = 0; i < w->inputs.count; i++) {
        int32_t kind = w->inputs.kind[i], which = w->inputs.which[i];
        int32_t rows = kind == INPUT_FORCE ? w->vessels.count : kind == INPUT_WRENCH ? w->bodies.count : 1;
        if (which < 0 || which >= rows)
            return refuse("input", i, "which", which, error);
    }
    return FRAM_OK;
}

fram_status world_check(const model *m, const world *w, fram_error *error)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(w, tables);
    fram_status status = FRAM_OK;
    for (size_t i = 0; i < sizeof count_rules / sizeof *count_rules; i++) {
        const world_table *t = find_table(tables, count_rules[i].table);
        int64_t rows = t ? rows_of(t) : -1;
        if (rows < count_rules[i].least || rows > most_of(tables, &count_rules[i], 0))
            return refuse(count_rules[i].table, 0, NULL, rows, error);
    }
    for (size_t i = 0; i < sizeof column_rules / sizeof *column_rules && status == FRAM_OK; i++)
        status = check_column(tables, &column_rules[i], error);
    if (status == FRAM_OK)
        status = check_shapes(&w->shapes, error);
    if (status == FRAM_OK)
        status = check_bodies(w, error);
    if (status == FRAM_OK)
        status = check_vessels(w, error);
    if (status == FRAM_OK)
        status = check_pairs(w, error);
    if (status == FRAM_OK)
        status = check_inputs(w, error);
    if (status == FRAM_OK && w->hull_contacts.count != 0 && w->hull_contacts.count != w->vessels.count)
        status = refuse("hull_contact", 0, NULL, w->hull_contacts.count, error);
    if (status == FRAM_OK && w->vessels.count != m->vessels.count)
        status = refuse("vessel", 0, NULL, w->vessels.count, error);
    if (status == FRAM_OK)
        status = check_stations(w, error);
    if (status == FRAM_OK)
        status = check_lines(&w->lines, error);
    if (status == FRAM_OK && w->drift.count != (m->sheet.drifts ? 1 : 0))
        status = refuse("drift", 0, NULL, w->drift.count, error);
    const tile_grid *tiles = &m->fracture.tiles;
    return status == FRAM_OK ? check_floes(w, tiles->columns * tiles->rows, error) : status;
}
