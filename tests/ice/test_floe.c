/* Floes as bodies: mass, inertia, frame, rows, errors. */
#include "base/random.h"
#include "base/transcendental.h"
#include "ice/floe.h"
#include "testing.h"

typedef struct ice {
    context ctx;
    body_table bodies;
    shape_store shapes;
    floe_table floes;
    overlay *plane;
    int32_t next_number;
} ice;

/* In place: the overlay keeps the address of the context. */
static void ice_start(ice *r)
{
    *r = (ice){.next_number = 0};
    context_init(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    ck_assert(r->plane);
}

static void ice_free(ice *r)
{
    table_free(&r->ctx, &r->bodies, &body_table_info);
    shape_store_free(&r->ctx, &r->shapes);
    table_free(&r->ctx, &r->floes, &floe_table_info);
    if (r->plane)
        overlay_free(r->plane);
}

static fram_status create(ice *r, const floe_definition *d, int32_t *row, fram_error *e)
{
    return floe_create(&r->ctx, d, 0, r->plane, &r->bodies, &r->shapes, &r->floes, &r->next_number, row, e);
}

static const vec2 RECTANGLE[4] = {{-5, -2}, {5, -2}, {5, 2}, {-5, 2}};
static const vec2 HOOK[6] = {{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}};

static floe_definition definition(const vec2 *outline, int32_t count)
{
    return (floe_definition){.outline = {outline, count},
                             .thickness = 1,
                             .material = {.density = 920, .elastic_modulus = 5e9, .crushing_strength = 2e6},
                             .breakable = true,
                             .motion = MOTION_DYNAMIC,
                             .parent = -1};
}

START_TEST(elevation_floats)
{
    /* A floe of 1 m draws 0.89756 m. */
    double z = floe_floating_elevation(1, 920, 1025);
    assert_absolute(0.5 - z, 0.8975609756, 1e-10);
}
END_TEST

/* Oracles, section 6: the prism 10 x 4 x 1. */
START_TEST(mass_and_inertia)
{
    ice r;
    ice_start(&r);
    fram_error e = {0};
    int32_t row;
    floe_definition d = definition(RECTANGLE, 4);
    d.elevation = -0.25;
    assert_ok(create(&r, &d, &row, &e), e);
    int32_t slot = r.floes.body[row];
    assert_relative(r.bodies.mass[slot], 36800, 1e-15);
    sym3 inertia = r.bodies.inertia[slot];
    assert_relative(inertia.xx, 52133.0 + 1.0 / 3, 1e-14);
    assert_relative(inertia.yy, 309733.0 + 1.0 / 3, 1e-14);
    assert_relative(inertia.zz, 355733.0 + 1.0 / 3, 1e-14);
    assert_absolute(inertia.xy, 0, 1e-9);
    assert_bits(inertia.xz, 0);
    assert_bits(inertia.yz, 0);
    assert_vec3_close(r.bodies.position[slot], vec3_make(0, 0, -0.25), 1e-15);
    ck_assert_int_eq(r.bodies.material[slot], MATERIAL_ICE);
    ck_assert_int_eq(r.bodies.motion[slot], MOTION_DYNAMIC);
    ck_assert_int_eq(r.bodies.owner[slot], row);
    assert_relative(r.floes.area[row], 40, 1e-15);
    ck_assert_int_eq(r.floes.breakable[row], 1);
    ck_assert_int_eq(r.floes.number[row], 0);
    ck_assert_int_eq(r.next_number, 1);
    ice_free(&r);
}
END_TEST

/* A concave floe anywhere, at any yaw: corners where they were, the tensor equal to that of its mesh, the global tensor
   independent of yaw. */
START_TEST(frame_and_products)
{
    vec2 outline[6];
    for (int i = 0; i < 6; i++)
        outline[i] = vec2_add(HOOK[i], (vec2){1000, -300});
    sym3 global[2];
    for (int turn = 0; turn < 2; turn++) {
        ice r;
        ice_start(&r);
        fram_error e = {0};
        int32_t row;
        floe_definition d = definition(outline, 6);
        d.yaw = turn == 0 ? 0 : radians(35);
        assert_ok(create(&r, &d, &row, &e), e);
        int32_t slot = r.floes.body[row], shape = r.bodies.shape[slot];
        polygon p = shape_outline(&r.shapes, shape);
        ck_assert_int_eq(p.count, 6);
        ck_assert_int_gt(r.shapes.shapes.piece_count[shape], 1);
        for (int i = 0; i < 6; i++) {
            vec3 corner = body_to_global(&r.bodies, slot, (vec3){p.vertex[i].x, p.vertex[i].y, 0});
            assert_vec2_close(vec2_make(corner.x, corner.y), outline[i], 1e-12);
        }
        mesh prism = {0};
        assert_ok(mesh_make_prism(&r.ctx, p, -0.5, 0.5, &prism, &e), e);
        solid_properties exact = mesh_solid_properties(&prism);
        mesh_free(&r.ctx, &prism);
        sym3 inertia = r.bodies.inertia[slot];
        assert_relative(r.bodies.mass[slot], 920 * exact.volume, 1e-13);
        assert_vec3_close(exact.centre, vec3_make(0, 0, 0), 1e-12);
        assert_relative(inertia.xx, 920 * exact.inertia.xx, 1e-12);
        assert_relative(inertia.yy, 920 * exact.inertia.yy, 1e-12);
        assert_relative(inertia.zz, 920 * exact.inertia.zz, 1e-12);
        assert_absolute(inertia.xy, 920 * exact.inertia.xy, 1e-12 * inertia.zz);
        global[turn] = sym3_rotate(inertia, quat_matrix(r.bodies.orientation[slot]));
        ice_free(&r);
    }
    ck_assert(fabs(global[0].xy) > 1e3);
    assert_array_relative(&global[1].xx, &global[0].xx, 4, 1e-12);
}
END_TEST

START_TEST(rows_are_used_again)
{
    ice r;
    ice_start(&r);
    fram_error e = {0};
    int32_t row;
    floe_definition d = definition(RECTANGLE, 4);
    for (int i = 0; i < 200; i++) {
        assert_ok(create(&r, &d, &row, &e), e);
        ck_assert_int_eq(row, i);
    }
    int32_t slot = r.floes.body[130], shape = r.bodies.shape[slot];
    floe_remove(&r.bodies, &r.shapes, &r.floes, 170);
    floe_remove(&r.bodies, &r.shapes, &r.floes, 130);
    ck_assert_int_eq(r.floes.body[130], -1);
    ck_assert(!body_is_alive(&r.bodies, slot));
    ck_assert_int_eq(r.shapes.shapes.kind[shape], SHAPE_NONE);
    d.parent = 130;
    assert_ok(create(&r, &d, &row, &e), e);
    ck_assert_int_eq(row, 130);
    ck_assert_int_eq(r.floes.number[row], 200);
    ck_assert_int_eq(r.floes.parent[row], 130);
    assert_ok(create(&r, &d, &row, &e), e);
    ck_assert_int_eq(row, 170);
    assert_ok(create(&r, &d, &row, &e), e);
    ck_assert_int_eq(row, 200);
    ck_assert_int_eq(r.floes.number[row], 202);
    ice_free(&r);
}
END_TEST

/* ---- rows against a search of all ---- */

static int32_t floe_searched(const floe_table *t)
{
    for (int32_t i = 0; i < t->count; i++)
        if (t->body[i] < 0)
            return i;
    return t->count;
}

static int32_t body_searched(const body_table *t)
{
    for (int32_t i = 0; i < t->count; i++)
        if (t->motion[i] == MOTION_NONE)
            return i;
    return t->count;
}

static int32_t shape_searched(const shape_table *t)
{
    for (int32_t i = 0; i < t->count; i++)
        if (t->kind[i] == SHAPE_NONE)
            return i;
    return t->count;
}

/* The living floe of a number among all, -1 without one. */
static int32_t drawn_floe(const ice *r, random_stream *draw)
{
    int32_t from = r->floes.count > 0 ? (int32_t)random_uniform(draw, 0, r->floes.count - 0.001) : 0;
    for (int32_t i = from; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0)
            return i;
    return -1;
}

static void copy_ice(ice *to, const ice *from)
{
    ck_assert(table_copy(&to->ctx, &to->bodies, &from->bodies, &body_table_info));
    ck_assert(table_copy(&to->ctx, &to->floes, &from->floes, &floe_table_info));
    ck_assert(table_copy(&to->ctx, &to->shapes.shapes, &from->shapes.shapes, &shape_table_info));
    ck_assert(table_copy(&to->ctx, &to->shapes.pieces, &from->shapes.pieces, &piece_table_info));
    ck_assert(table_copy(&to->ctx, &to->shapes.vertices, &from->shapes.vertices, &shape_vertex_table_info));
    to->shapes.is_counted = false;
    to->next_number = from->next_number;
}

/* One thing that may happen to a world: a floe comes, one goes, a wall comes or goes, one breaks. */
static void happen(ice *r, random_stream *draw, double coming)
{
    fram_error e = {0};
    floe_definition d = definition(RECTANGLE, 4);
    double what = random_uniform(draw, 0, 1);
    int32_t victim = drawn_floe(r, draw), row;
    if (what < 0.1) { /* a slot, and none of the other rows */
        int32_t slot = body_searched(&r->bodies);
        ck_assert_int_eq(body_create(&r->ctx, &r->bodies, MOTION_STATIC, MATERIAL_WALL), slot);
        if (what < 0.03)
            body_remove(&r->bodies, slot);
        return;
    }
    if (what > coming && victim >= 0)
        floe_remove(&r->bodies, &r->shapes, &r->floes, victim);
    if (what > coming && what < 0.9)
        return;
    for (int i = 0; i < (what >= 0.9 ? 3 : 1); i++) {
        int32_t floe = floe_searched(&r->floes), slot = body_searched(&r->bodies),
                shape = shape_searched(&r->shapes.shapes);
        assert_ok(create(r, &d, &row, &e), e);
        ck_assert_int_eq(row, floe);
        ck_assert_int_eq(r->floes.body[row], slot);
        ck_assert_int_eq(r->bodies.shape[slot], shape);
    }
}

/* Through births, breaks, removals, compactions, tables that become those of another time (a fork, in both directions),
   and tables that lose their last rows. */
START_TEST(rows_are_those_of_a_search)
{
    random_stream draw = random_begin(31, 0, 0);
    ice now, other;
    ice_start(&now);
    ice_start(&other);
    for (int i = 0; i < 4000; i++) {
        happen(&now, &draw, i / 500 % 2 ? 0.3 : 0.7);
        if (i % 97 == 0)
            ck_assert_int_eq(shape_compact(&now.ctx, &now.shapes), FRAM_OK);
        if (i % 211 == 0)
            copy_ice(&other, &now);
        if (i % 211 > 150)
            happen(&other, &draw, 0.5);
        if (i % 633 == 400)
            copy_ice(&now, &other);
    }
    ck_assert_int_gt(now.floes.count, 100);
    int32_t kept = now.bodies.count / 2, slot;
    ck_assert(table_resize(&now.ctx, &now.bodies, &body_table_info, kept));
    ck_assert(table_resize(&now.ctx, &now.bodies, &body_table_info, kept + 20));
    do {
        slot = body_searched(&now.bodies);
        ck_assert_int_eq(body_create(&now.ctx, &now.bodies, MOTION_STATIC, MATERIAL_WALL), slot);
    } while (slot < kept + 20);
    ice_free(&now);
    ice_free(&other);
}
END_TEST

/* The state's hash must not remember what a free row once held. */
START_TEST(free_rows_are_blank)
{
    uint64_t hash[2];
    for (int turn = 0; turn < 2; turn++) {
        ice r;
        ice_start(&r);
        fram_error e = {0};
        int32_t row;
        floe_definition d = definition(turn == 0 ? RECTANGLE : HOOK, turn == 0 ? 4 : 6);
        assert_ok(create(&r, &d, &row, &e), e);
        floe_remove(&r.bodies, &r.shapes, &r.floes, row);
        hash[turn] = table_hash(&r.floes, &floe_table_info, 0);
        ice_free(&r);
    }
    ck_assert(hash[0] == hash[1]);
}
END_TEST

START_TEST(wrong_definitions)
{
    ice r;
    ice_start(&r);
    fram_error e = {0};
    int32_t row = -1;
    vec2 clockwise[3] = {{0, 0}, {0, 1}, {1, 0}};
    floe_definition d = definition(clockwise, 3);
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "counter-clockwise");
    d = definition(RECTANGLE, 4);
    d.thickness = 0;
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "thickness");
    d = definition(RECTANGLE, 4);
    d.thickness = (double)NAN;
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "thickness");
    d = definition(RECTANGLE, 4);
    d.material.density = -1;
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "density");
    d = definition(RECTANGLE, 4);
    d.elevation = HUGE_VAL;
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "elevation");
    d = definition(RECTANGLE, 4);
    d.motion = MOTION_NONE;
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "motion");
    overlay *plane = r.plane;
    r.plane = NULL;
    d = definition(HOOK, 6);
    assert_fails(create(&r, &d, &row, &e), e, FRAM_ERROR_INPUT, "overlay");
    r.plane = plane;
    ck_assert_int_eq(r.next_number, 0);
    ck_assert_int_eq(r.bodies.count, 0);
    /* A row that a failed call made stays free. */
    d = definition(RECTANGLE, 4);
    assert_ok(create(&r, &d, &row, &e), e);
    ck_assert_int_eq(row, 0);
    ice_free(&r);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        ice r = {.ctx = turn.ctx};
        int32_t row = -1;
        floe_definition d = definition(RECTANGLE, 4);
        turn.status = create(&r, &d, &row, &turn.error);
        if (turn.status != FRAM_OK) {
            ck_assert_int_eq(r.next_number, 0);
            for (int32_t i = 0; i < r.floes.count; i++)
                ck_assert_int_eq(r.floes.body[i], -1);
            for (int32_t i = 0; i < r.bodies.count; i++)
                ck_assert(!body_is_alive(&r.bodies, i));
        }
        ice_free(&r);
        ck_assert_int_eq(turn.error.status, turn.status);
    }
}
END_TEST

TEST_MAIN("floe", elevation_floats, mass_and_inertia, frame_and_products, rows_are_used_again,
          rows_are_those_of_a_search, free_rows_are_blank, wrong_definitions, memory_runs_out)
