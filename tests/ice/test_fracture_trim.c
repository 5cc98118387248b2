/* How far a hull has drawn back from static ice: what decides when the crushed ice goes. */
#include "fracture_rig.h"

static const double SPEED = 0.5;

/* A static plate, and a hull that stands clear of it and is said to touch it with two patches. */
static int32_t start(fracture_rig *r, solid_array *solids)
{
    fram_error e = {0};
    fracture_rig_make(r);
    r->settings.crush_trims = true;
    const vec2 corner[4] = {{-20, -20}, {20, -20}, {20, 20}, {-20, 20}};
    int32_t row = fracture_rig_floe(r, (polygon){corner, 4}, 1, MOTION_STATIC), index, shape;
    mesh box = {0};
    ck_assert(mesh_make_box(&r->ctx, (vec3){-5, -5, -5}, (vec3){5, 5, 5}, &box));
    polyhedron_array pieces = {0};
    ck_assert(array_push(&r->ctx, &pieces, (polyhedron){.radius = 0}));
    assert_ok(polyhedron_hull(&r->ctx, box.vertex.data, box.vertex.count, 1e-9, &pieces.data[0], &e), e);
    r->shapes.solids = solids;
    assert_ok(solid_add(&r->ctx, solids, &box, &pieces, 0, &index, &e), e);
    assert_ok(shape_add_solid(&r->ctx, &r->shapes, index, &shape, &e), e);
    r->bodies.shape[r->hull] = shape;
    r->bodies.position[r->hull] = (vec3){-100, 0, 0};
    return row;
}

/* One step in which the hull moves along x and its two patches carry nothing. */
static vec3 step(fracture_rig *r, int32_t row, double speed)
{
    r->bodies.velocity[r->hull] = (vec3){speed, 0, 0};
    for (int i = 0; i < 2; i++) {
        ck_assert(fracture_rig_load(r, row, (vec2){-20, i ? 4 : -4}, 0, 0.5));
        r->patches.data[i].normal = (vec3){1, 0, 0};
    }
    ck_assert_int_eq(fracture_rig_break(r), 0);
    return r->floes.retreat[row];
}

/* The way back is the hull's own, however many patches it has on the floe, and starts anew where it presses on. */
START_TEST(retreat_is_the_way_of_the_hull)
{
    fracture_rig r;
    solid_array solids = {0};
    int32_t row = start(&r, &solids);
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 1; i <= 10; i++)
            assert_vec3_close(step(&r, row, -SPEED), ((vec3){-SPEED * i * r.settings.time_step, 0, 0}), 1e-15);
        for (int i = 0; i < 3; i++)
            assert_vec3_close(step(&r, row, SPEED), ((vec3){0, 0, 0}), 0);
    }
    fracture_rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

TEST_MAIN("fracture trim", retreat_is_the_way_of_the_hull)
