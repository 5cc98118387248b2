/* From cut outlines to new floes (SPEC 8.5, 8.8): cleaning, poses and velocities of the children, books. */
#include "ice/fracture_parts.h"

/* What the children inherit, copied before the parent goes. */
typedef struct parent {
    floe_definition definition; /* outline and motion to be set */
    uint8_t motion;
    vec3 position, velocity, angular_velocity;
    quat orientation;
    mat3 rotation;
} parent;

/* What one birth works on. */
typedef struct birth {
    context *ctx;
    fracture_scratch *scratch;
    const fracture_settings *settings;
    overlay *plane;
    const fracture_state *state;
    parent from;
    fracture_event *event;
    fram_error *error;
} birth;

static parent parent_of(const fracture_state *state, int32_t floe)
{
    const body_table *b = state->bodies;
    int32_t body = state->floes->body[floe];
    parent p = {.definition = {.thickness = state->floes->thickness[floe],
                               .material = state->floes->material[floe],
                               .breakable = state->floes->breakable[floe] != 0,
                               .parent = state->floes->number[floe]},
                .motion = b->motion[body],
                .position = b->position[body],
                .velocity = b->velocity[body],
                .angular_velocity = b->angular_velocity[body],
                .orientation = b->orientation[body],
                .rotation = quat_matrix(b->orientation[body])};
    return p;
}

/* The floe was made at its centroid with no turn, in the parent's frame; it goes to where its ice is, and moves as that
   ice moved: v_new = v_old + Omega x (r_new - r_old). */
static void place_child(const birth *b, int32_t body)
{
    body_table *bodies = b->state->bodies;
    vec3 arm = mat3_mul_vec(b->from.rotation, bodies->position[body]);
    bodies->position[body] = vec3_add(b->from.position, arm);
    bodies->orientation[body] = b->from.orientation;
    if (bodies->motion[body] == MOTION_STATIC)
        return;
    bodies->velocity[body] = vec3_add(b->from.velocity, vec3_cross(b->from.angular_velocity, arm));
    bodies->angular_velocity[body] = b->from.angular_velocity;
}

static fram_status make_floe(const birth *b, polygon outline, motion kind)
{
    floe_definition d = b->from.definition;
    int32_t row;
    d.outline = outline;
    d.motion = kind;
    fram_status status = floe_create(b->ctx, &d, b->settings->smallest_piece_area, b->plane, b->state->bodies,
                                     b->state->shapes, b->state->floes, b->state->next_number, &row, b->error);
    if (status != FRAM_OK)
        return status;
    place_child(b, b->state->floes->body[row]);
    b->event->pieces++;
    b->event->piece_area += b->state->floes->area[row];
    return FRAM_OK;
}

static void book(const birth *b, double before, double after)
{
    if (before >= after)
        b->event->area_lost += before - after;
    else
        b->event->area_gained += after - before;
}

/* Booked area may be at most this part of the parent (SPEC 8.8). */
static const double MOST_BOOKED = 1e-3;
/* Cleaning that would book more is repeated with half the edge, so often. */
enum { FINER_CLEANINGS = 4 };

/* The outline cleaned as far as the budget of booked area [m2] allows, ring itself where nothing does, in *out; without
   vertices when none is sound.  false: no memory. */
static bool clean_within(const birth *b, polygon ring, double budget, polygon *out)
{
    vec2_array *clean = &b->scratch->clean;
    double area = polygon_area(ring), edge = b->settings->edge_threshold;
    for (int turn = 0; turn <= FINER_CLEANINGS; turn++, edge /= 2) {
        if (!polygon_clean(b->ctx, ring, edge, clean))
            return false;
        *out = (polygon){clean->data, clean->count};
        double after = polygon_area(*out);
        if (fabs(after - area) <= budget && after >= b->settings->smallest_floe_area &&
            fracture_outline_is_sound(b->ctx, *out))
            return true;
    }
    *out = fracture_outline_is_sound(b->ctx, ring) ? ring : (polygon){0};
    return true;
}

/* Area of the pieces that no sibling took: they will be lost [m2]. */
static double dust_of(const birth *b)
{
    double sum = 0;
    for (int32_t i = 0; i < b->scratch->cut.count; i++)
        if (b->scratch->cut.data[i].area < b->settings->smallest_floe_area)
            sum += b->scratch->cut.data[i].area;
    return sum;
}

/* All pieces cleaned, within the budget together; *sound is false when one cannot be.  Dust is left for the books. */
static bool clean_pieces(const birth *b, double budget, bool *sound)
{
    fracture_scratch *s = b->scratch;
    *sound = true;
    for (int32_t i = 0; i < s->cut.count; i++) {
        cut_piece *c = &s->cut.data[i];
        if (c->area < b->settings->smallest_floe_area)
            continue;
        polygon outline;
        if (!clean_within(b, polygon_list_get(&s->outlines, c->ring), fmax(budget, 0) / (s->cut.count - i), &outline))
            return false;
        *sound = outline.count > 0;
        if (!*sound)
            return true;
        budget -= fabs(polygon_area(outline) - c->area);
        c->ring = polygon_list_count(&s->outlines);
        if (!polygon_list_push(b->ctx, &s->outlines, outline))
            return false;
    }
    return true;
}

static bool gather(const birth *b, const polygon_list *rings, motion kind)
{
    fracture_scratch *s = b->scratch;
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        polygon ring = polygon_list_get(rings, i);
        cut_piece piece = {polygon_list_count(&s->outlines), (uint8_t)kind, polygon_area(ring)};
        if (!polygon_list_push(b->ctx, &s->outlines, ring) || !array_push(b->ctx, &s->cut, piece))
            return false;
    }
    return true;
}

fram_status fracture_birth(context *ctx, fracture_scratch *s, const fracture_settings *settings, overlay *plane,
                           const fracture_state *state, int32_t floe, const polygon_list *remnants,
                           const polygon_list *wedges, fracture_event *event, bool *broke, fram_error *error)
{
    birth b = {ctx, s, settings, plane, state, parent_of(state, floe), event, error};
    polygon_list_clear(&s->outlines);
    array_clear(&s->cut);
    *broke = false;
    if (!gather(&b, remnants, (motion)b.from.motion) || !gather(&b, wedges, MOTION_DYNAMIC))
        return error_memory(error);
    fram_status status = fracture_join_dust(ctx, s, settings, plane, error);
    double smallest = settings->smallest_floe_area, parent_area = state->floes->area[floe];
    double budget = MOST_BOOKED * parent_area - dust_of(&b);
    if (status != FRAM_OK || s->cut.count < 2 || budget < 0)
        return status;
    if (!clean_pieces(&b, budget, broke))
        return error_memory(error);
    if (!*broke)
        return FRAM_OK;
    event->floe = b.from.definition.parent;
    event->first_piece = *state->next_number;
    event->parent_area = parent_area;
    floe_remove(state->bodies, state->shapes, state->floes, floe);
    for (int32_t i = 0; i < s->cut.count && status == FRAM_OK; i++) {
        const cut_piece *c = &s->cut.data[i];
        polygon outline = polygon_list_get(&s->outlines, c->ring);
        bool dust = c->area < smallest;
        book(&b, c->area, dust ? 0 : polygon_area(outline));
        if (!dust)
            status = make_floe(&b, outline, (motion)c->motion);
    }
    double line = b.from.definition.material.density * b.from.definition.thickness;
    event->mass_lost = line * event->area_lost;
    event->mass_gained = line * event->area_gained;
    return status;
}
