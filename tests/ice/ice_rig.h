/* A small world for the tests of ice: floes, walls and hulls, and the stages of a step without water and vessels. */
#ifndef ICE_RIG_H
#define ICE_RIG_H

#include "base/transcendental.h"
#include "books.h"
#include "dynamics/solver.h"
#include "ice/edge_rows.h"
#include "ice/fracture.h"
#include "testing.h"

typedef struct ice_rig {
    context ctx;
    body_table bodies;
    solid_array solids;
    shape_store shapes;
    floe_table floes;
    joint_table joints;
    contact_memory_table memory;
    edge_support_table supports;
    pair_table pairs; /* kept by hand: see ice_rig_pair */
    index_array patch_pairs;
    pair_policies policies;
    crushing_settings settings;
    crushing_patch_array patches;
    contact_array contacts;
    crushing_scratch *scratch;
    edge_rows_work edge_rows;
    solver *solve;
    solver_settings solver;
    solver_report report;
    overlay *plane;
    int32_t next_number;
} ice_rig;

static const ice_material ICE_RIG_MATERIAL = {
    .density = 920, .elastic_modulus = 5e9, .poisson_ratio = 0.3, .flexural_strength = 0.5e6, .crushing_strength = 2e6};

/* With ctx as given, so that its memory may run out: false then. */
static inline bool ice_rig_start(ice_rig *r, context ctx, double dt)
{
    *r = (ice_rig){.ctx = ctx, .settings = {.time_step = dt}};
    for (int i = 0; i < MATERIAL_COUNT; i++)
        for (int k = 0; k < MATERIAL_COUNT; k++)
            r->policies.of[i][k] = (pair_policy){.patch = true};
    r->solver = (solver_settings){.kind = SOLVER_FAST,
                                  .iterations = 60,
                                  .position_iterations = 20,
                                  .correction_rate = 0.8,
                                  .warm_start = true,
                                  .tolerance = 1e-12,
                                  .most_iterations = 20000};
    r->scratch = crushing_scratch_create(&r->ctx);
    r->solve = solver_create(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    return r->scratch && r->solve && r->plane;
}

static inline void ice_rig_make(ice_rig *r, double dt)
{
    context ctx;
    context_init(&ctx);
    ck_assert(ice_rig_start(r, ctx, dt));
}

static inline void ice_rig_free(ice_rig *r)
{
    context *c = &r->ctx;
    table_free(c, &r->bodies, &body_table_info);
    shape_store_free(c, &r->shapes);
    solid_array_free(c, &r->solids);
    table_free(c, &r->floes, &floe_table_info);
    table_free(c, &r->joints, &joint_table_info);
    table_free(c, &r->supports, &edge_support_table_info);
    table_free(c, &r->memory, &contact_memory_table_info);
    table_free(c, &r->pairs, &pair_table_info);
    array_free(c, &r->patch_pairs);
    array_free(c, &r->patches);
    array_free(c, &r->contacts);
    crushing_scratch_free(c, r->scratch);
    edge_rows_free(c, &r->edge_rows);
    if (r->solve)
        solver_free(c, r->solve);
    if (r->plane)
        overlay_free(r->plane);
}

/* A floe of the outline about the global origin, centre at z = 0; returns its row. */
static inline int32_t ice_rig_floe(ice_rig *r, polygon outline, double thickness, motion kind)
{
    fram_error e = {0};
    int32_t row = -1;
    floe_definition d = {.outline = outline,
                         .thickness = thickness,
                         .material = ICE_RIG_MATERIAL,
                         .breakable = true,
                         .motion = kind,
                         .parent = -1};
    assert_ok(floe_create(&r->ctx, &d, 0, r->plane, &r->bodies, &r->shapes, &r->floes, &r->next_number, &row, &e), e);
    return row;
}

/* A rectangular floe about the origin; returns its row. */
static inline int32_t ice_rig_plate(ice_rig *r, double length, double width, double thickness, motion kind)
{
    double x = length / 2, y = width / 2;
    vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    return ice_rig_floe(r, (polygon){corner, 4}, thickness, kind);
}

/* The same; returns its body. */
static inline int32_t ice_rig_plate_body(ice_rig *r, double length, double width, double thickness, motion kind)
{
    int32_t row = ice_rig_plate(r, length, width, thickness, kind);
    return r->floes.body[row];
}

/* Takes the mesh over. */
static inline int32_t ice_rig_hull(ice_rig *r, mesh *surface, motion kind, material m)
{
    fram_error e = {0};
    int32_t index, row, slot = body_create(&r->ctx, &r->bodies, kind, m);
    ck_assert_int_ge(slot, 0);
    polyhedron_array pieces = {0};
    ck_assert(array_push(&r->ctx, &pieces, (polyhedron){.radius = 0}));
    assert_ok(polyhedron_hull(&r->ctx, surface->vertex.data, surface->vertex.count, 1e-9, &pieces.data[0], &e), e);
    r->shapes.solids = &r->solids;
    assert_ok(solid_add(&r->ctx, &r->solids, surface, &pieces, 0, &index, &e), e);
    assert_ok(shape_add_solid(&r->ctx, &r->shapes, index, &row, &e), e);
    r->bodies.shape[slot] = row;
    r->bodies.mass[slot] = 1e6;
    r->bodies.inertia[slot] = (sym3){1e6, 1e6, 1e6, 0, 0, 0};
    return slot;
}

static inline int32_t ice_rig_box(ice_rig *r, vec3 lo, vec3 hi, motion kind, material m)
{
    mesh box = {0};
    ck_assert(mesh_make_box(&r->ctx, lo, hi, &box));
    return ice_rig_hull(r, &box, kind, m);
}

/* A hull behind a plane face that leans by `slope` (x over z) and has x = 0 at its middle, this wide and high. */
static inline int32_t ice_rig_slanted(ice_rig *r, double slope, double half_width, double half_height)
{
    mesh plate = {0};
    ck_assert(
        mesh_make_box(&r->ctx, (vec3){-10, -half_width, -half_height}, (vec3){0, half_width, half_height}, &plate));
    for (int32_t i = 0; i < plate.vertex.count; i++)
        plate.vertex.data[i].x += slope * plate.vertex.data[i].z;
    return ice_rig_hull(r, &plate, MOTION_PRESCRIBED, MATERIAL_HULL);
}

/* A wedge bow of half angle 30 degrees and stem 40 degrees: two flares in one patch. */
static inline void ice_rig_bow(context *ctx, mesh *m)
{
    double height = 8, reach = height / real_tan(radians(40)), length = 30, half = length * real_tan(radians(30));
    vec3 v[6] = {{0, 0, 0},
                 {-reach, 0, -height},
                 {-length, half, 0},
                 {-length, -half, 0},
                 {-length - reach, half, -height},
                 {-length - reach, -half, -height}};
    static const int32_t face[8][3] = {{0, 2, 3}, {1, 5, 4}, {0, 4, 2}, {0, 1, 4},
                                       {0, 3, 5}, {0, 5, 1}, {2, 4, 5}, {2, 5, 3}};
    for (int i = 0; i < 6; i++)
        ck_assert(mesh_add_vertex(ctx, m, v[i]));
    for (int i = 0; i < 8; i++)
        ck_assert(mesh_add_triangle(ctx, m, face[i][0], face[i][1], face[i][2]));
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
}

/* Every triangle becomes four, `times` times: the same surface. */
static inline void ice_rig_refine(context *ctx, mesh *m, int times)
{
    for (int turn = 0; turn < times; turn++) {
        mesh fine = {0};
        for (int32_t f = 0; f < m->face.count; f++) {
            vec3 v[6];
            for (int k = 0; k < 3; k++)
                v[k] = m->vertex.data[m->face.data[f].v[k]];
            for (int k = 0; k < 3; k++)
                v[3 + k] = vec3_scale(vec3_add(v[k], v[(k + 1) % 3]), 0.5);
            for (int k = 0; k < 6; k++)
                ck_assert(mesh_add_vertex(ctx, &fine, v[k]));
            static const int32_t corner[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
            for (int k = 0; k < 4; k++)
                ck_assert(
                    mesh_add_triangle(ctx, &fine, 6 * f + corner[k][0], 6 * f + corner[k][1], 6 * f + corner[k][2]));
        }
        int32_t joined;
        ck_assert_int_eq(mesh_weld(ctx, &fine, 1e-9, &joined), FRAM_OK);
        mesh_free(ctx, m);
        *m = fine;
    }
}

/* Cuts the rectangular prism of a shape into n x n convex pieces. */
static inline void ice_rig_cut(ice_rig *r, int32_t shape, int n)
{
    box2 b = polygon_bounds(shape_outline(&r->shapes, shape));
    shape_vertex_table *v = &r->shapes.vertices;
    piece_table *p = &r->shapes.pieces;
    int32_t first = p->count;
    ck_assert(table_reserve(&r->ctx, v, &shape_vertex_table_info, v->count + 4 * n * n));
    ck_assert(table_reserve(&r->ctx, p, &piece_table_info, p->count + n * n));
    vec2 step = {(b.hi.x - b.lo.x) / n, (b.hi.y - b.lo.y) / n};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            p->first[p->count] = v->count;
            p->size[p->count] = 4;
            p->inner_edges[p->count++] = 0;
            for (int c = 0; c < 4; c++) {
                static const vec2 side[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
                v->side[v->count] = side[c];
                v->corner[v->count] = -1;
                v->point[v->count++] =
                    (vec2){b.lo.x + (i + (c == 1 || c == 2)) * step.x, b.lo.y + (k + c / 2) * step.y};
            }
        }
    r->shapes.shapes.piece_first[shape] = first;
    r->shapes.shapes.piece_count[shape] = n * n;
}

/* Keeps a pair of body slots. */
static inline void ice_rig_pair(ice_rig *r, int32_t a, int32_t b)
{
    int32_t row = r->pairs.count;
    ck_assert(table_resize(&r->ctx, &r->pairs, &pair_table_info, row + 1));
    r->pairs.a[row] = a < b ? a : b;
    r->pairs.b[row] = a < b ? b : a;
    ck_assert(array_push(&r->ctx, &r->patch_pairs, row));
}

/* Moves a body; the rotation is about the z axis, then y, then x. */
static inline void ice_rig_place(ice_rig *r, int32_t slot, vec3 position, double roll, double pitch, double yaw)
{
    r->bodies.position[slot] = position;
    r->bodies.orientation[slot] = quat_from_roll_pitch_yaw(roll, pitch, yaw);
}

static inline fram_status ice_rig_try(ice_rig *r, fram_error *e)
{
    array_clear(&r->patches);
    array_clear(&r->contacts);
    return crushing_contacts(&r->ctx, r->scratch, &r->settings, &r->bodies, &r->shapes, &r->floes, &r->supports,
                             &r->pairs, &r->patch_pairs, &r->policies, &r->patches, &r->contacts, e);
}

/* Patches and contacts of all pairs. */
static inline void ice_rig_crush(ice_rig *r)
{
    fram_error e = {0};
    assert_ok(ice_rig_try(r, &e), e);
}

/* What edges give in the rows of all contacts. */
static inline void ice_rig_edges(ice_rig *r)
{
    edge_job j = {&r->settings.edges, r->settings.time_step, &r->bodies, &r->floes, &r->supports, &r->memory};
    ck_assert(edge_rows_set(&r->ctx, &j, &r->edge_rows, &r->patches, &r->contacts));
}

/* New velocities from the contacts, without loads. */
static inline void ice_rig_solve(ice_rig *r)
{
    fram_error e = {0};
    wrench *loads = memory_array(&r->ctx, (size_t)r->bodies.count, sizeof *loads);
    ck_assert(loads);
    assert_ok(solver_solve(&r->ctx, r->solve, &r->solver, r->settings.time_step, &r->bodies, loads, &r->joints,
                           &r->contacts, &r->memory, &r->report, &e),
              e);
    memory_free(&r->ctx, loads);
}

/* One step without loads. */
static inline void ice_rig_step(ice_rig *r)
{
    fram_error e = {0};
    double dt = r->settings.time_step;
    ice_rig_crush(r);
    ice_rig_edges(r);
    ice_rig_solve(r);
    integrate_poses(&r->ctx, &r->bodies, dt);
    assert_ok(solver_correct_positions(&r->ctx, r->solve, &r->solver, dt, &r->bodies, &r->joints, &r->contacts, &e), e);
}

/* Force on the floe of all contacts [N]. */
static inline vec3 ice_rig_force(const ice_rig *r)
{
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < r->contacts.count; i++)
        sum = vec3_mad(sum, contact_impulse(&r->contacts.data[i]), 1 / r->settings.time_step);
    return sum;
}

/* What fracture changes of it; what a test keeps itself is to be added. */
static inline fracture_state ice_rig_fracture_state(ice_rig *r)
{
    return (fracture_state){.bodies = &r->bodies,
                            .shapes = &r->shapes,
                            .floes = &r->floes,
                            .contacts = &r->contacts,
                            .memory = &r->memory,
                            .next_number = &r->next_number};
}

typedef struct ice_rig_broken {
    double time; /* before the step in which it broke [s] */
    fracture_event event;
    vec3 force; /* on the floe when it broke, of all contacts [N] */
} ice_rig_broken;

/* Steps without loads, before `end` [s], until a floe breaks, which one does. */
static inline ice_rig_broken ice_rig_until_broken(ice_rig *r, const fracture_settings *settings, double end)
{
    double dt = r->settings.time_step;
    fracture_scratch *scratch = fracture_scratch_create(&r->ctx);
    fracture_event_array events = {0};
    ice_rig_broken b = {0};
    for (int step = 0; step * dt < end && events.count == 0; step++) {
        fram_error e = {0};
        ice_rig_crush(r);
        ice_rig_solve(r);
        b.force = ice_rig_force(r);
        b.time = step * dt;
        fracture_state state = ice_rig_fracture_state(r);
        state.supports = &r->supports;
        assert_ok(fracture_run(&r->ctx, scratch, settings, r->plane, &r->patches, &state, &events, &e), e);
        integrate_poses(&r->ctx, &r->bodies, dt);
    }
    ck_assert_int_eq(events.count, 1);
    b.event = events.data[0];
    array_free(&r->ctx, &events);
    fracture_scratch_free(&r->ctx, scratch);
    return b;
}

#endif
