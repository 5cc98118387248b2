/* The life of a world: its tables are made, copied, compared and hashed by walking world_tables(). */
#include "model/world.h"
#include "base/number_text.h"
#include <stdio.h>
#include <string.h>

#define TABLE_SELF clock_table
TABLE_DEFINE(clock, CLOCK_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF load_window_table
TABLE_DEFINE(load_window, LOAD_WINDOW_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF recorded_table
TABLE_DEFINE(recorded, RECORDED_FIELDS)
#undef TABLE_SELF

#define TABLE_SELF hull_contact_table
TABLE_DEFINE(hull_contact, HULL_CONTACT_FIELDS)
#undef TABLE_SELF

/* A list of tables says nothing about who may change them: the const of the world is the caller's to keep. */
#define STATE(noun, member)                    \
    {                                          \
        &noun##_table_info, (void *)&w->member \
    }

void world_tables(const world *w, world_table out[WORLD_TABLE_COUNT])
{
    const world_table list[WORLD_TABLE_COUNT] = {
        STATE(clock, clock),
        STATE(body, bodies),
        STATE(shape, shapes.shapes),
        STATE(piece, shapes.pieces),
        STATE(shape_vertex, shapes.vertices),
        STATE(floe, floes),
        STATE(vessel, vessels),
        STATE(joint, joints),
        STATE(pair, pairs),
        STATE(broad, boxes),
        STATE(contact_memory, memory),
        STATE(load_window, load_window),
        STATE(recorded, recorded),
        STATE(line, lines),
        STATE(thruster, thrusters),
        STATE(waypoint, waypoints),
        STATE(station, stations),
        STATE(event, events),
        STATE(feeding, feeding),
        STATE(pattern, pattern),
        STATE(pattern_vertex, pattern_vertices),
        STATE(input, inputs),
        STATE(hull_contact, hull_contacts),
        STATE(drift, drift),
        STATE(drift_cell, drift_cells),
        STATE(drift_vertex, drift_vertices),
        STATE(propulsion, propulsion),
        STATE(course, course),
        STATE(approach, approaches),
        STATE(edge_load, edge_loads),
        STATE(held_drag, held_drag),
        STATE(edge_support, edge_supports),
        STATE(hull_retreat, hull_retreats),
        STATE(pattern_copy, pattern_copies),
        STATE(flooding, flooding),
        STATE(rest, rest),
    };
    memcpy(out, list, sizeof list);
}

static fram_status init(context *ctx, const solid_array *solids, world *w, fram_error *error)
{
    memset(w, 0, sizeof *w);
    w->shapes.solids = solids;
    w->scratch.collision = collision_scratch_create(ctx);
    w->scratch.crushing = crushing_scratch_create(ctx);
    w->scratch.fracture = fracture_scratch_create(ctx);
    w->scratch.solve = solver_create(ctx);
    w->scratch.plane = overlay_create(ctx);
    bool made =
        w->scratch.collision && w->scratch.crushing && w->scratch.fracture && w->scratch.solve && w->scratch.plane;
    if (made && table_resize(ctx, &w->clock, &clock_table_info, 1))
        return FRAM_OK;
    world_free(ctx, w);
    return error_memory(error);
}

fram_status world_init(context *ctx, const model *m, world *w, fram_error *error)
{
    return init(ctx, &m->solids, w, error);
}

static void scratch_free(context *ctx, world *w)
{
    array_free(ctx, &w->scratch.loads);
    array_free(ctx, &w->scratch.submerged);
    array_free(ctx, &w->scratch.fluid);
    array_free(ctx, &w->scratch.contacts);
    array_free(ctx, &w->scratch.contact_generations);
    array_free(ctx, &w->scratch.patch_pairs);
    edge_rows_free(ctx, &w->scratch.edge_rows);
    array_free(ctx, &w->scratch.patches);
    array_free(ctx, &w->scratch.load_contacts);
    array_free(ctx, &w->scratch.contact_work);
    array_free(ctx, &w->scratch.ice_loads);
    array_free(ctx, &w->scratch.shares);
    array_free(ctx, &w->scratch.web_first);
    array_free(ctx, &w->scratch.web_next);
    array_free(ctx, &w->scratch.responses);
    array_free(ctx, &w->scratch.wash);
    array_free(ctx, &w->scratch.wash_force);
    array_free(ctx, &w->scratch.fractures);
    array_free(ctx, &w->scratch.feeding_near.row);
    if (w->scratch.collision)
        collision_scratch_free(ctx, w->scratch.collision);
    if (w->scratch.crushing)
        crushing_scratch_free(ctx, w->scratch.crushing);
    if (w->scratch.fracture)
        fracture_scratch_free(ctx, w->scratch.fracture);
    if (w->scratch.solve)
        solver_free(ctx, w->scratch.solve);
    if (w->scratch.plane)
        overlay_free(w->scratch.plane);
}

static void poison(void *data, int32_t capacity, size_t size)
{
    if (data)
        memset(data, 0xff, (size_t)capacity * size);
}

void world_poison_scratch(world *w)
{
#define POISON(a) poison(w->scratch.a.data, w->scratch.a.capacity, sizeof *w->scratch.a.data)
    POISON(loads);
    POISON(submerged);
    POISON(fluid);
    POISON(contacts);
    POISON(contact_generations);
    POISON(patch_pairs);
    POISON(patches);
    POISON(load_contacts);
    POISON(contact_work);
    POISON(ice_loads);
    POISON(shares);
    POISON(web_first);
    POISON(web_next);
    POISON(responses);
    POISON(wash);
    POISON(wash_force);
    POISON(fractures);
#undef POISON
    memset(&w->scratch.solver, 0xff, sizeof w->scratch.solver);
}

void world_free(context *ctx, world *w)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(w, tables);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++)
        table_free(ctx, tables[t].table, tables[t].info);
    shape_store_free(ctx, &w->shapes);
    scratch_free(ctx, w);
    memset(w, 0, sizeof *w);
}

/* The number of tables as it was when hashes of runs were first published; those that came later count only when they
   have rows, so that worlds that never needed them have the hashes they had before. */
enum { HASH_SEED = 21 };

uint64_t world_hash(const world *w)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(w, tables);
    static const recorded_table nothing_recorded = {0};
    uint64_t hash = HASH_SEED;
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        if (tables[t].info == &recorded_table_info)
            hash = table_hash(&nothing_recorded, tables[t].info, hash);
        else if (t < HASH_SEED || ((const table_head *)tables[t].table)->count > 0)
            hash = table_hash(tables[t].table, tables[t].info, hash);
    }
    return hash;
}

void world_forget(world *w)
{
    collision_scratch_forget(w->scratch.collision);
    fracture_scratch_forget(w->scratch.fracture);
    w->scratch.step = 0;
    w->scratch.rest_seen = (rest_seen){0};
    w->scratch.feeding_near.is_known = false;
    w->shapes.is_counted = false;
}

bool world_came_since_contacts(const world *w, int32_t slot)
{
    return slot >= w->scratch.contact_generations.count ||
           w->scratch.contact_generations.data[slot] != w->bodies.generation[slot];
}

double world_reach(const world *w, int32_t body)
{
    return w->bodies.shape[body] >= 0 ? w->shapes.shapes.radius[w->bodies.shape[body]] : 0;
}

/* Of a prism whose axis is `a` in its own frame. */
static double reach_of_prism(const shape_store *s, int32_t shape, vec3 a)
{
    polygon outline = shape_outline(s, shape);
    double h = s->shapes.half_height[shape], most = 0;
    for (int32_t i = 0; i < outline.count; i++) {
        vec3 p = {outline.vertex[i].x, outline.vertex[i].y, h};
        most = fmax(most, vec3_length(vec3_cross(a, p)));
        p.z = -h;
        most = fmax(most, vec3_length(vec3_cross(a, p)));
    }
    return most;
}

double world_reach_about(const world *w, int32_t body, vec3 axis)
{
    int32_t shape = w->bodies.shape[body];
    if (shape < 0 || !(vec3_length(axis) > 0))
        return 0;
    vec3 a = mat3_tmul_vec(quat_matrix(w->bodies.orientation[body]), vec3_scale(axis, 1 / vec3_length(axis)));
    if (w->shapes.shapes.kind[shape] == SHAPE_PRISM)
        return reach_of_prism(&w->shapes, shape, a);
    const mesh *surface = &shape_solid(&w->shapes, shape)->surface;
    double most = 0;
    for (int32_t i = 0; i < surface->vertex.count; i++)
        most = fmax(most, vec3_length(vec3_cross(a, surface->vertex.data[i])));
    return most;
}

fram_status world_copy_state(context *ctx, world *dst, const world *src, fram_error *error)
{
    world_table to[WORLD_TABLE_COUNT], from[WORLD_TABLE_COUNT];
    world_forget(dst);
    world_tables(dst, to);
    world_tables(src, from);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++)
        if (!table_copy(ctx, to[t].table, from[t].table, to[t].info))
            return error_memory(error);
    return FRAM_OK;
}

#define COPY_ARRAY(member)                                                                     \
    (array_resize(ctx, &dst->scratch.member, src->scratch.member.count) &&                     \
     copy_bytes(dst->scratch.member.data, src->scratch.member.data, src->scratch.member.count, \
                sizeof *dst->scratch.member.data))

static bool copy_bytes(void *to, const void *from, int32_t count, size_t size)
{
    if (count > 0)
        memcpy(to, from, (size_t)count * size);
    return true;
}

/* What the last step left for readers. */
static bool copy_reports(context *ctx, const world *src, world *dst)
{
    dst->scratch.solver = src->scratch.solver;
    dst->scratch.step = src->scratch.step;
    return COPY_ARRAY(fluid) && COPY_ARRAY(contacts) && COPY_ARRAY(contact_generations) && COPY_ARRAY(patches) &&
           COPY_ARRAY(ice_loads) && COPY_ARRAY(responses) && COPY_ARRAY(wash_force) && COPY_ARRAY(fractures);
}

fram_status world_copy(context *ctx, const world *src, world *dst, fram_error *error)
{
    fram_status status = init(ctx, src->shapes.solids, dst, error);
    if (status != FRAM_OK)
        return status;
    status = world_copy_state(ctx, dst, src, error);
    if (status == FRAM_OK && !copy_reports(ctx, src, dst))
        status = error_memory(error);
    if (status != FRAM_OK)
        world_free(ctx, dst);
    return status;
}

int64_t load_window_length(const world *w)
{
    return w->vessels.count > 0 ? w->load_window.count / w->vessels.count : 0;
}

int64_t load_window_row(const world *w, int64_t step, int32_t vessel)
{
    int64_t length = load_window_length(w), turn = length > 0 ? step % length : 0;
    return turn * w->vessels.count + vessel;
}

/* One number of a column as text. */
static void number_print(const void *data, field_kind kind, size_t index, char out[NUMBER_TEXT_SIZE])
{
    switch (kind) {
    case FIELD_F64:
        real_to_text(((const double *)data)[index], out);
        break;
    case FIELD_I32:
        snprintf(out, NUMBER_TEXT_SIZE, "%lld", (long long)((const int32_t *)data)[index]);
        break;
    case FIELD_U32:
        snprintf(out, NUMBER_TEXT_SIZE, "%llu", (unsigned long long)((const uint32_t *)data)[index]);
        break;
    case FIELD_I64:
        snprintf(out, NUMBER_TEXT_SIZE, "%lld", (long long)((const int64_t *)data)[index]);
        break;
    case FIELD_U64:
        snprintf(out, NUMBER_TEXT_SIZE, "%llu", (unsigned long long)((const uint64_t *)data)[index]);
        break;
    case FIELD_U8:
        snprintf(out, NUMBER_TEXT_SIZE, "%u", (unsigned)((const uint8_t *)data)[index]);
        break;
    }
}

/* The first number of two columns that differs in its bits, as text. */
static bool column_difference(const char *table, const field_info *field, const void *a, const void *b, int32_t rows,
                              char text[WORLD_DIFFERENCE_SIZE])
{
    size_t number = field_kind_size(field->kind), count = (size_t)rows * (size_t)field->components;
    for (size_t i = 0; i < count; i++) {
        if (memcmp((const char *)a + i * number, (const char *)b + i * number, number) == 0)
            continue;
        char first[NUMBER_TEXT_SIZE], second[NUMBER_TEXT_SIZE];
        number_print(a, field->kind, i, first);
        number_print(b, field->kind, i, second);
        size_t components = (size_t)field->components;
        snprintf(text, WORLD_DIFFERENCE_SIZE, "%s[%zu].%s[%zu]: %s and %s", table, i / components, field->name,
                 i % components, first, second);
        return true;
    }
    return false;
}

static bool table_difference(const world_table *a, const world_table *b, char text[WORLD_DIFFERENCE_SIZE])
{
    const table_head *head_a = a->table, *head_b = b->table;
    if (head_a->count != head_b->count) {
        snprintf(text, WORLD_DIFFERENCE_SIZE, "%s: %d and %d rows", a->info->name, (int)head_a->count,
                 (int)head_b->count);
        return true;
    }
    for (int f = 0; f < a->info->field_count; f++) {
        const field_info *field = &a->info->fields[f];
        if (column_difference(a->info->name, field, table_field(a->table, field), table_field(b->table, field),
                              head_a->count, text))
            return true;
    }
    return false;
}

bool world_difference(const world *a, const world *b, char text[WORLD_DIFFERENCE_SIZE])
{
    world_table of_a[WORLD_TABLE_COUNT], of_b[WORLD_TABLE_COUNT];
    world_tables(a, of_a);
    world_tables(b, of_b);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++)
        if (table_difference(&of_a[t], &of_b[t], text))
            return true;
    text[0] = '\0';
    return false;
}

int32_t world_floe_count(const world *w)
{
    int32_t count = 0;
    for (int32_t i = 0; i < w->floes.count; i++)
        count += w->floes.body[i] >= 0;
    return count;
}
