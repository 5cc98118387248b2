/* Whole arrays of a world for callers: bodies, outlines, contacts, fractures. */
#include "api/arguments.h"
#include "api/handles.h"

#include "fram/live.h"
#include "sim/mechanisms.h"

#include <string.h>

/* Dense copies leave the world as it is; only fram_world_view hands out its own memory. */
_Static_assert(sizeof(vec2) == 2 * sizeof(double), "vertices of outlines");
_Static_assert(sizeof(vec3) == 3 * sizeof(double) && sizeof(quat) == 4 * sizeof(double), "rows of a view");

static inline bool is_selected(const body_table *b, int32_t slot, unsigned selection)
{
    return body_is_alive(b, slot) && (selection == 0 || (selection >> world_body_kind(b, slot) & 1) != 0);
}

/* Bodies are copied in runs of so many, a column after the other: reading 10,000 in every step costs what memory costs.
 */
enum { RUN = 256 };

static void put3(double *array, int row, const vec3 *v, const int32_t *slot, int count)
{
    for (int i = 0; array && i < count; i++) {
        double *out = &array[3 * (row + i)];
        out[0] = v[slot[i]].x, out[1] = v[slot[i]].y, out[2] = v[slot[i]].z;
    }
}

static void put4(double *array, int row, const quat *q, const int32_t *slot, int count)
{
    for (int i = 0; array && i < count; i++) {
        double *out = &array[4 * (row + i)];
        out[0] = q[slot[i]].w, out[1] = q[slot[i]].x, out[2] = q[slot[i]].y, out[3] = q[slot[i]].z;
    }
}

static double thickness_of(const world *w, int32_t slot)
{
    int32_t shape = w->bodies.shape[slot];
    return shape >= 0 && w->shapes.shapes.kind[shape] == SHAPE_PRISM ? 2 * w->shapes.shapes.half_height[shape] : 0;
}

/* Row of the floe table, -1. */
static inline int32_t floe_of(const world *w, int32_t slot)
{
    return world_body_kind(&w->bodies, slot) == FRAM_BODY_FLOE ? w->bodies.owner[slot] : -1;
}

/* Bodies of these slots as rows from `row`. */
static void put_bodies(const world *w, const int32_t *slot, int count, int row, const fram_body_arrays *a)
{
    const body_table *b = &w->bodies;
    for (int i = 0; a->id && i < count; i++)
        a->id[row + i] = (fram_body_id){slot[i], b->generation[slot[i]]};
    for (int i = 0; a->kind && i < count; i++)
        a->kind[row + i] = (int32_t)world_body_kind(b, slot[i]);
    for (int i = 0; a->number && i < count; i++) {
        int32_t floe = floe_of(w, slot[i]);
        a->number[row + i] = floe >= 0 ? w->floes.number[floe] : -1;
    }
    for (int i = 0; a->parent && i < count; i++) {
        int32_t floe = floe_of(w, slot[i]);
        a->parent[row + i] = floe >= 0 ? w->floes.parent[floe] : -1;
    }
    for (int i = 0; a->mass && i < count; i++)
        a->mass[row + i] = b->mass[slot[i]];
    for (int i = 0; a->thickness && i < count; i++)
        a->thickness[row + i] = thickness_of(w, slot[i]);
    put3(a->position, row, b->position, slot, count);
    put4(a->orientation, row, b->orientation, slot, count);
    put3(a->velocity, row, b->velocity, slot, count);
    put3(a->angular_velocity, row, b->angular_velocity, slot, count);
}

/* Returns how many are selected. */
static int put_selected(const world *w, unsigned selection, const fram_body_arrays *a)
{
    int32_t slot[RUN];
    int count = 0, waiting = 0, put = 0;
    for (int32_t i = 0; i < w->bodies.count; i++) {
        if (!is_selected(&w->bodies, i, selection))
            continue;
        if (count++ < a->room)
            slot[waiting++] = i;
        if (waiting == RUN) {
            put_bodies(w, slot, waiting, put, a);
            put += waiting;
            waiting = 0;
        }
    }
    put_bodies(w, slot, waiting, put, a);
    return count;
}

int(fram_world_bodies)(const fram_world *w, unsigned selection, const fram_body_arrays *arrays, size_t size)
{
    if (RESULT_CHECK(arrays, size, fram_body_arrays, NULL) != FRAM_OK || !world_reads(w))
        return 0;
    fram_body_arrays a = {0};
    if (arrays)
        memcpy(&a, arrays, size);
    int count = put_selected(&w->inner, selection, &a);
    world_end_reading(w);
    return count;
}

int fram_world_outlines(const fram_world *w, unsigned selection, int32_t *offset, int offset_room, double *xy,
                        int point_room, int *bodies)
{
    int row = 0, points = 0;
    bool reads = world_reads(w);
    int32_t slots = reads ? w->inner.bodies.count : 0;
    for (int32_t i = 0; i < slots; i++) {
        const body_table *b = &w->inner.bodies;
        if (!is_selected(b, i, selection))
            continue;
        if (offset && row < offset_room)
            offset[row] = points;
        row++;
        if (b->shape[i] < 0 || w->inner.shapes.shapes.kind[b->shape[i]] != SHAPE_PRISM)
            continue;
        polygon outline = shape_outline(&w->inner.shapes, b->shape[i]);
        mat3 turn = quat_matrix(b->orientation[i]);
        vec3 centre = b->position[i];
        for (int32_t k = 0; xy && k < outline.count && points + k < point_room; k++) {
            vec3 p = vec3_add(centre, mat3_mul_vec(turn, vec3_make(outline.vertex[k].x, outline.vertex[k].y, 0)));
            xy[2 * (points + k)] = p.x, xy[2 * (points + k) + 1] = p.y;
        }
        points += outline.count;
    }
    if (offset && row < offset_room)
        offset[row] = points;
    if (bodies)
        *bodies = row;
    if (reads)
        world_end_reading(w);
    return points;
}

int fram_world_shapes(const fram_world *w, int32_t *offset, int offset_room, double *xy, int point_room)
{
    int points = 0;
    bool reads = world_reads(w);
    int32_t slots = reads ? w->inner.bodies.count : 0;
    for (int32_t i = 0; i < slots; i++) {
        if (offset && i < offset_room)
            offset[i] = points;
        int32_t shape = w->inner.bodies.shape[i];
        if (!body_is_alive(&w->inner.bodies, i) || shape < 0 || w->inner.shapes.shapes.kind[shape] != SHAPE_PRISM)
            continue;
        polygon outline = shape_outline(&w->inner.shapes, shape);
        int32_t room = point_room > points ? point_room - points : 0,
                copied = outline.count < room ? outline.count : room;
        if (xy && copied > 0)
            memcpy(&xy[2 * (size_t)points], outline.vertex, (size_t)copied * sizeof *outline.vertex);
        points += outline.count;
    }
    if (offset && slots < offset_room)
        offset[slots] = points;
    if (reads)
        world_end_reading(w);
    return points;
}

uint64_t fram_world_shape_changes(const fram_world *w) { return w ? w->inner.shapes.changes : 0; }

fram_status(fram_world_view)(const fram_world *w, fram_body_view *view, fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"view", view});
    if (status == FRAM_OK)
        status = RESULT_CHECK(view, size, fram_body_view, error);
    if (status == FRAM_OK)
        status = world_refuse_taken(w, error);
    if (status != FRAM_OK)
        return status;
    w->aside->kept.shown = true;
    const body_table *b = &w->inner.bodies;
    const fram_body_view full = {.slots = b->count,
                                 .position = (const double *)b->position,
                                 .orientation = (const double *)b->orientation,
                                 .velocity = (const double *)b->velocity,
                                 .angular_velocity = (const double *)b->angular_velocity,
                                 .mass = b->mass,
                                 .generation = b->generation,
                                 .lives = b->motion,
                                 .changes = &w->inner.shapes.changes};
    _Static_assert(MOTION_NONE == 0, "a row of motion says whether somebody lives");
    result_give(view, size, &full);
    return FRAM_OK;
}

/* The body that a contact of the last step was with: pieces that have come since may stand in its slot. */
static fram_body_id id_of(const world *w, int32_t slot)
{
    if (slot < 0 || slot >= w->scratch.contact_generations.count)
        return (fram_body_id){-1, 0};
    return (fram_body_id){slot, w->scratch.contact_generations.data[slot]};
}

int(fram_world_contacts)(const fram_world *w, fram_contact *contacts, int room, size_t size)
{
    if (RESULT_CHECK(contacts, size, fram_contact, NULL) != FRAM_OK || !world_reads(w))
        return 0;
    int32_t count = w->inner.scratch.contacts.count;
    for (int32_t i = 0; contacts && i < count && i < room; i++) {
        const contact *c = &w->inner.scratch.contacts.data[i];
        fram_contact full, *out = &full;
        full = (fram_contact){.a = id_of(&w->inner, c->a), .b = id_of(&w->inner, c->b)};
        copy3(out->point, c->point);
        copy3(out->normal, c->normal);
        copy3(out->impulse, contact_impulse(c));
        out->normal_impulse = c->impulse[0];
        out->limit = c->impulse_limit;
        out->depth = c->depth;
        out->capped = c->impulse[0] > 0 && contact_is_capped(c) ? FRAM_CONTACT_CRUSHING : FRAM_CONTACT_BELOW;
        result_give(result_row(contacts, size, i), size, out);
    }
    world_end_reading(w);
    return count;
}

int(fram_world_fractures)(const fram_world *w, fram_fracture *fractures, int room, size_t size)
{
    if (RESULT_CHECK(fractures, size, fram_fracture, NULL) != FRAM_OK || !world_reads(w))
        return 0;
    int32_t count = w->inner.scratch.fractures.count;
    for (int32_t i = 0; fractures && i < count && i < room; i++) {
        const fracture_event *e = &w->inner.scratch.fractures.data[i];
        fram_fracture full, *out = &full;
        full = (fram_fracture){.floe = e->floe, .first_piece = e->first_piece, .pieces = e->pieces};
        switch ((fracture_kind)e->kind) {
        case FRACTURE_SPLIT:
            out->kind = FRAM_FRACTURE_SPLIT;
            break;
        case FRACTURE_BENDING:
            out->kind = FRAM_FRACTURE_BENDING;
            break;
        default:
            out->kind = FRAM_FRACTURE_RELEASE;
        }
        copy3(out->place, e->place);
        out->load = e->load;
        out->crack_length = e->crack_length;
        out->stress_ratio = e->stress_ratio;
        out->floe_area = e->parent_area;
        out->pieces_area = e->piece_area;
        out->area_lost = e->area_lost;
        out->area_gained = e->area_gained;
        result_give(result_row(fractures, size, i), size, out);
    }
    world_end_reading(w);
    return count;
}
