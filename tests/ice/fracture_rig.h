/* Floes under given loads, without the steps before fracture: one hull body, patches and impulses made by hand. */
#ifndef FRACTURE_RIG_H
#define FRACTURE_RIG_H

#include "base/random.h"
#include "base/transcendental.h"
#include "books.h"
#include "ice/fracture.h"
#include "sizes.h"
#include "testing.h"

typedef struct fracture_rig {
    context ctx;
    body_table bodies;
    shape_store shapes;
    floe_table floes;
    contact_array contacts;
    contact_memory_table memory;
    edge_load_table edge_loads;
    edge_support_table supports;
    hull_retreat_table retreats;
    crushing_patch_array patches;
    fracture_event_array events;
    fracture_settings settings;
    fracture_scratch *scratch;
    overlay *plane;
    int32_t next_number, hull;
    double crushed, gained;
} fracture_rig;

static const ice_material FRACTURE_RIG_ICE = {
    .density = 920, .elastic_modulus = 5e9, .poisson_ratio = 0.3, .flexural_strength = 0.5e6, .crushing_strength = 2e6};

/* Thresholds at full scale (lambda 30), everything else at its default. */
static inline fracture_settings fracture_rig_settings(void)
{
    return (fracture_settings){.time_step = 0.01,
                               .water_density = 1025,
                               .gravity = 9.81,
                               .wedges = 3,
                               .splitting_factor = 3,
                               .toughness = 150e3,
                               .narrowness = 4,
                               .smallest_floe_area = 0.18,
                               .smallest_piece_area = 0.009,
                               .edge_threshold = 0.15,
                               .thick_plate_radius = true};
}

static inline bool fracture_rig_start(fracture_rig *r, context ctx)
{
    *r = (fracture_rig){.ctx = ctx, .settings = fracture_rig_settings()};
    r->scratch = fracture_scratch_create(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    if (!r->scratch || !r->plane)
        return false;
    r->hull = body_create(&r->ctx, &r->bodies, MOTION_PRESCRIBED, MATERIAL_HULL);
    return r->hull >= 0;
}

static inline void fracture_rig_make(fracture_rig *r)
{
    context ctx;
    context_init(&ctx);
    ck_assert(fracture_rig_start(r, ctx));
}

static inline void fracture_rig_free(fracture_rig *r)
{
    context *c = &r->ctx;
    table_free(c, &r->bodies, &body_table_info);
    shape_store_free(c, &r->shapes);
    table_free(c, &r->floes, &floe_table_info);
    table_free(c, &r->memory, &contact_memory_table_info);
    table_free(c, &r->supports, &edge_support_table_info);
    table_free(c, &r->retreats, &hull_retreat_table_info);
    table_free(c, &r->edge_loads, &edge_load_table_info);
    array_free(c, &r->contacts);
    array_free(c, &r->patches);
    array_free(c, &r->events);
    fracture_scratch_free(c, r->scratch);
    if (r->plane)
        overlay_free(r->plane);
}

/* A breakable floe; returns its row, -1 when it could not be made. */
static inline int32_t fracture_rig_floe(fracture_rig *r, polygon outline, double thickness, motion kind)
{
    int32_t row = -1;
    floe_definition d = {.outline = outline,
                         .thickness = thickness,
                         .material = FRACTURE_RIG_ICE,
                         .breakable = true,
                         .motion = kind,
                         .parent = -1};
    (void)floe_create(&r->ctx, &d, r->settings.smallest_piece_area, r->plane, &r->bodies, &r->shapes, &r->floes,
                      &r->next_number, &row, NULL);
    return row;
}

/* A rectangular one of 1 m. */
static inline int32_t fracture_rig_plate(fracture_rig *r, double length, double width, motion kind)
{
    double x = length / 2, y = width / 2;
    const vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    int32_t row = fracture_rig_floe(r, (polygon){corner, 4}, 1, kind);
    ck_assert_int_ge(row, 0);
    return row;
}

/* A load P [N] straight down on a floe, at a place in its own frame, on this horizontal area. */
static inline bool fracture_rig_load(fracture_rig *r, int32_t row, vec2 place, double load, double area)
{
    int32_t body = r->floes.body[row];
    vec3 down = mat3_mul_vec(quat_matrix(r->bodies.orientation[body]), (vec3){0, 0, -1});
    vec3 point = body_to_global(&r->bodies, body, (vec3){place.x, place.y, 0});
    contact c = {.a = body,
                 .b = r->hull,
                 .point = point,
                 .normal = down,
                 .impulse = {load * r->settings.time_step, 0, 0},
                 .correct = true,
                 .patch = r->patches.count,
                 .key = 100 + (uint64_t)r->contacts.count};
    crushing_patch p = {.floe = row,
                        .floe_body = body,
                        .surface_body = r->hull,
                        .normal = down,
                        .centre = point,
                        .area = area,
                        .horizontal_area = area,
                        .pressure = 2e6,
                        .contact_first = r->contacts.count,
                        .contact_count = 1};
    return array_push(&r->ctx, &r->contacts, c) && array_push(&r->ctx, &r->patches, p);
}

/* The last load becomes even along a line of this half vector, in the floe's own frame; it must be the last contact. */
static inline bool fracture_rig_widen(fracture_rig *r, vec2 half)
{
    crushing_patch *p = &r->patches.data[r->patches.count - 1];
    contact second = r->contacts.data[p->contact_first];
    mat3 rotation = quat_matrix(r->bodies.orientation[p->floe_body]);
    double to = 1 / sqrt(3.0);
    vec3 aside = mat3_mul_vec(rotation, (vec3){half.x * to, half.y * to, 0});
    second.impulse[0] /= 2;
    second.point = vec3_add(p->centre, aside);
    r->contacts.data[p->contact_first] = second;
    second.point = vec3_sub(p->centre, aside);
    second.key += 50000;
    p->contact_count = 2;
    return array_push(&r->ctx, &r->contacts, second);
}

/* The last load is one of this body on the floe; with `swap` its patch is on the body, and the floe the surface:
   contacts push the body the other way, and plans are in its frame. */
static inline void fracture_rig_push_by(fracture_rig *r, int32_t body, bool swap)
{
    crushing_patch *p = &r->patches.data[r->patches.count - 1];
    int32_t floe = p->floe_body;
    p->surface_body = swap ? floe : body;
    p->floe_body = swap ? body : floe;
    p->floe = r->bodies.owner[p->floe_body];
    p->normal = swap ? vec3_neg(p->normal) : p->normal;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        contact *c = &r->contacts.data[i];
        c->a = p->floe_body;
        c->b = p->surface_body;
        c->normal = p->normal;
    }
    if (!swap)
        return;
    box2 out = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int i = 0; i < 4; i++) {
        vec3 at = r->bodies.position[floe], corner = {at.x + (i & 1 ? p->plan.hi.x : p->plan.lo.x),
                                                      at.y + (i & 2 ? p->plan.hi.y : p->plan.lo.y), at.z};
        vec3 own = body_to_local(&r->bodies, body, corner);
        out.lo = (vec2){fmin(out.lo.x, own.x), fmin(out.lo.y, own.y)};
        out.hi = (vec2){fmax(out.hi.x, own.x), fmax(out.hi.y, own.y)};
    }
    p->plan = out;
}

static inline fracture_state fracture_rig_state(fracture_rig *r)
{
    return (fracture_state){.bodies = &r->bodies,
                            .shapes = &r->shapes,
                            .floes = &r->floes,
                            .contacts = &r->contacts,
                            .memory = &r->memory,
                            .next_number = &r->next_number,
                            .crushed = &r->crushed,
                            .gained = &r->gained,
                            .edge_loads = &r->edge_loads,
                            .supports = &r->supports,
                            .retreats = &r->retreats};
}

static inline fram_status fracture_rig_try(fracture_rig *r, fram_error *e)
{
    fracture_state state = fracture_rig_state(r);
    array_clear(&r->events);
    return fracture_run(&r->ctx, r->scratch, &r->settings, r->plane, &r->patches, &state, &r->events, e);
}

/* Break what breaks; loads are used up. */
static inline int fracture_rig_break(fracture_rig *r)
{
    fram_error e = {0};
    assert_ok(fracture_rig_try(r, &e), e);
    array_clear(&r->patches);
    array_clear(&r->contacts);
    return r->events.count;
}

static inline polygon fracture_rig_outline(const fracture_rig *r, int32_t row)
{
    return shape_outline(&r->shapes, r->bodies.shape[r->floes.body[row]]);
}

/* Area of all floes [m2]. */
static inline double fracture_rig_area(const fracture_rig *r)
{
    double sum = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0)
            sum += polygon_area(fracture_rig_outline(r, i));
    return sum;
}

static inline int fracture_rig_count(const fracture_rig *r)
{
    int sum = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        sum += r->floes.body[i] >= 0;
    return sum;
}

static inline void fracture_rig_remove_all(fracture_rig *r)
{
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0)
            floe_remove(&r->bodies, &r->shapes, &r->floes, i);
    fracture_scratch_forget(r->scratch);
    ck_assert_int_eq(shape_compact(&r->ctx, &r->shapes), FRAM_OK);
}

/* The outline of a floe, in the global plane (level floes) or in the frame of another body. */
static inline int32_t fracture_rig_global(const fracture_rig *r, int32_t row, vec2 *out, int32_t room)
{
    polygon p = fracture_rig_outline(r, row);
    for (int32_t i = 0; i < p.count && i < room; i++) {
        vec3 v = body_to_global(&r->bodies, r->floes.body[row], (vec3){p.vertex[i].x, p.vertex[i].y, 0});
        out[i] = (vec2){v.x, v.y};
    }
    return p.count;
}

#endif
