/* A world of floes, one hull and the load between them, for the benches of fracture: what a break costs without the
   steps around it. */
#ifndef BENCH_FRACTURE_RIG_H
#define BENCH_FRACTURE_RIG_H

#include "ice/fracture.h"

#include <stdio.h>
#include <stdlib.h>

enum { WEDGES = 3 };

typedef struct rig {
    context ctx;
    body_table bodies;
    shape_store shapes;
    floe_table floes;
    contact_array contacts;
    contact_memory_table memory;
    crushing_patch_array patches;
    fracture_event_array events;
    fracture_settings settings;
    fracture_scratch *scratch;
    overlay *plane;
    int32_t next_number, hull;
} rig;

static const ice_material ICE = {
    .density = 920, .elastic_modulus = 5e9, .poisson_ratio = 0.3, .flexural_strength = 0.5e6, .crushing_strength = 2e6};

static inline void stop(const char *what)
{
    fprintf(stderr, "%s\n", what);
    exit(EXIT_FAILURE);
}

static inline void rig_make(rig *r)
{
    *r = (rig){.settings = {.time_step = 0.01,
                            .water_density = 1025,
                            .gravity = 9.81,
                            .wedges = WEDGES,
                            .splitting = SPLITTING_NONE,
                            .splitting_factor = 3,
                            .narrowness = 4,
                            .smallest_floe_area = 0.18,
                            .smallest_piece_area = 0.009,
                            .edge_threshold = 0.15,
                            .thick_plate_radius = true}};
    context_init(&r->ctx);
    r->scratch = fracture_scratch_create(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    r->hull = body_create(&r->ctx, &r->bodies, MOTION_PRESCRIBED, MATERIAL_HULL);
    if (!r->scratch || !r->plane || r->hull < 0)
        stop("no memory");
}

static inline int32_t add_floe(rig *r, polygon outline, motion kind, int32_t tile)
{
    int32_t row = -1;
    fram_error e = {0};
    floe_definition d = {.outline = outline,
                         .thickness = 1,
                         .material = ICE,
                         .breakable = true,
                         .motion = kind,
                         .parent = -1,
                         .tile = tile};
    if (floe_create(&r->ctx, &d, r->settings.smallest_piece_area, r->plane, &r->bodies, &r->shapes, &r->floes,
                    &r->next_number, &row, &e) != FRAM_OK)
        stop(e.message);
    return row;
}

static inline void add_load(rig *r, int32_t row, vec2 place, double load, double area)
{
    int32_t body = r->floes.body[row];
    vec3 at = r->bodies.position[body], point = {place.x, place.y, at.z};
    contact c = {.a = body,
                 .b = r->hull,
                 .point = point,
                 .normal = {0, 0, -1},
                 .impulse = {load * r->settings.time_step, 0, 0},
                 .key = 1};
    crushing_patch p = {.floe = row,
                        .floe_body = body,
                        .surface_body = r->hull,
                        .normal = {0, 0, -1},
                        .centre = point,
                        .area = area,
                        .horizontal_area = area,
                        .plan = {{place.x - at.x, place.y - at.y}, {place.x - at.x, place.y - at.y}},
                        .contact_count = 1};
    array_clear(&r->contacts);
    array_clear(&r->patches);
    if (!array_push(&r->ctx, &r->contacts, c) || !array_push(&r->ctx, &r->patches, p))
        stop("no memory");
}

/* Breaks what the load breaks; the events of it are the rig's. */
static inline void break_loaded(rig *r)
{
    fram_error e = {0};
    fracture_state state = {.bodies = &r->bodies,
                            .shapes = &r->shapes,
                            .floes = &r->floes,
                            .contacts = &r->contacts,
                            .memory = &r->memory,
                            .next_number = &r->next_number};
    array_clear(&r->events);
    if (fracture_run(&r->ctx, r->scratch, &r->settings, r->plane, &r->patches, &state, &r->events, &e) != FRAM_OK)
        stop(e.message);
}

/* Floes that move are removed. */
static inline void remove_moving(rig *r)
{
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && r->bodies.motion[r->floes.body[i]] == MOTION_DYNAMIC)
            floe_remove(&r->bodies, &r->shapes, &r->floes, i);
    if (shape_compact(&r->ctx, &r->shapes) != FRAM_OK)
        stop("no memory");
}

/* All that the rig holds. */
static inline void rig_free(rig *r)
{
    table_free(&r->ctx, &r->bodies, &body_table_info);
    table_free(&r->ctx, &r->floes, &floe_table_info);
    table_free(&r->ctx, &r->memory, &contact_memory_table_info);
    shape_store_free(&r->ctx, &r->shapes);
    array_free(&r->ctx, &r->contacts);
    array_free(&r->ctx, &r->patches);
    array_free(&r->ctx, &r->events);
    fracture_scratch_free(&r->ctx, r->scratch);
    overlay_free(r->plane);
}

#endif
