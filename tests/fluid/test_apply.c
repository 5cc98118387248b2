/* Fluid and gravity on a table of bodies: which slots, which coefficients, the same on any number of threads. */
#include "base/pool.h"
#include "samples.h"

static const drag_coefficients coefficients[MATERIAL_COUNT] = {
    [MATERIAL_ICE] = {1, 0.01, 0.5, 0.003}, [MATERIAL_HULL] = {0.5, 0.004, 0.3, 0.001}, [MATERIAL_WALL] = {9, 9, 9, 9}};

typedef struct scene {
    body_table bodies;
    solid_array solids;
    shape_store shapes;
} scene;

static void scene_free(context *ctx, scene *s)
{
    table_free(ctx, &s->bodies, &body_table_info);
    shape_store_free(ctx, &s->shapes);
    solid_array_free(ctx, &s->solids);
}

static int32_t add_prism(context *ctx, scene *s, polygon outline, double half_height)
{
    int32_t row = -1;
    fram_error error = {0};
    assert_ok(shape_add_prism(ctx, &s->shapes, NULL, outline, half_height, 0, &row, &error), error);
    return row;
}

static int32_t add_body(context *ctx, scene *s, int how, material made_of, int32_t shape, random_stream *r)
{
    int32_t slot = body_create(ctx, &s->bodies, (motion)how, made_of);
    ck_assert_int_ge(slot, 0);
    s->bodies.shape[slot] = shape;
    s->bodies.mass[slot] = random_uniform(r, 1e4, 1e5);
    s->bodies.position[slot] = random_vector(r, 0.4);
    s->bodies.velocity[slot] = random_vector(r, 1);
    s->bodies.angular_velocity[slot] = random_vector(r, 0.2);
    s->bodies.orientation[slot] = quat_from_roll_pitch_yaw(0.1 * random_unit(r), 0.1 * random_unit(r), random_unit(r));
    return slot;
}

START_TEST(slots)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    random_stream r = random_begin(5, 0, 0);
    int32_t prism = add_prism(&ctx, &s, OUTLINE(hexagon_outline), 0.5), solid_row, shape;
    fram_error error = {0};
    mesh surface = {0};
    ck_assert(mesh_make_box(&ctx, vec3_make(-5, -2, -1), vec3_make(5, 2, 1), &surface));
    mesh copy = {0};
    ck_assert(mesh_copy(&ctx, &copy, &surface));
    polyhedron_array pieces = {0};
    s.shapes.solids = &s.solids;
    assert_ok(solid_add(&ctx, &s.solids, &copy, &pieces, 0, &solid_row, &error), error);
    assert_ok(shape_add_solid(&ctx, &s.shapes, solid_row, &shape, &error), error);

    int32_t floe = add_body(&ctx, &s, MOTION_DYNAMIC, MATERIAL_ICE, prism, &r);
    int32_t ship = add_body(&ctx, &s, MOTION_DYNAMIC, MATERIAL_HULL, shape, &r);
    int32_t wall = add_body(&ctx, &s, MOTION_STATIC, MATERIAL_WALL, prism, &r);
    int32_t driven = add_body(&ctx, &s, MOTION_PRESCRIBED, MATERIAL_HULL, shape, &r);
    int32_t bare = add_body(&ctx, &s, MOTION_DYNAMIC, MATERIAL_ICE, -1, &r);
    int32_t gone = add_body(&ctx, &s, MOTION_DYNAMIC, MATERIAL_ICE, prism, &r);
    body_remove(&s.bodies, gone);

    wrench loads[6];
    fluid_load detail[6], hull;
    double volume[6];
    memset(volume, 0xff, sizeof volume);
    memset(loads, 0xff, sizeof loads);
    memset(detail, 0xff, sizeof detail);
    media windy = still_water;
    windy.wind.x = 8;
    assert_ok(fluid_apply(&ctx, &windy, coefficients, &s.bodies, &s.shapes, NULL, loads,
                          &(fluid_details){.volume = volume, .solids = &hull, .all = detail}, &error),
              error);

    for (int k = 0; k < 2; k++) {
        int32_t slot = k ? ship : floe;
        fluid_motion state = {s.bodies.position[slot], quat_matrix(s.bodies.orientation[slot]), s.bodies.velocity[slot],
                              s.bodies.angular_velocity[slot]};
        fluid_load load;
        if (slot == floe) {
            fluid_load_prism(&windy, &coefficients[MATERIAL_ICE], OUTLINE(hexagon_outline), 0.5, &state, &load);
        } else {
            fluid_load_mesh(&windy, &coefficients[MATERIAL_HULL], &surface, &state, &load);
        }
        const fluid_load *got = &detail[slot];
        assert_relative(got->submerged_volume, load.submerged_volume, 1e-13);
        ck_assert(volume[slot] == got->submerged_volume);
        assert_vec3_close(got->hydrostatic.force, load.hydrostatic.force, 1e-13 * load.hydrostatic.force.z);
        assert_vec3_close(got->hydrostatic.moment, load.hydrostatic.moment, 1e-12 * load.hydrostatic.force.z);
        assert_vec3_close(got->water_drag.force, load.water_drag.force, 3e-3 * vec3_length(load.water_drag.force));
        assert_vec3_close(got->wind_drag.force, load.wind_drag.force, 3e-3 * vec3_length(load.wind_drag.force));
        vec3 force = vec3_add(got->hydrostatic.force, vec3_add(got->water_drag.force, got->wind_drag.force));
        force.z -= s.bodies.mass[slot] * 9.81;
        assert_vec3_close(loads[slot].force, force, 0);
        ck_assert(vec3_length(load.wind_drag.force) > 0 && vec3_length(load.water_drag.moment) > 0);
    }
    static const double nothing[sizeof(fluid_load) / sizeof(double)] = {0};
    const int32_t unloaded[3] = {wall, driven, gone};
    for (int k = 0; k < 3; k++) {
        assert_array_bits(&loads[unloaded[k]].force.x, nothing, 6);
        ck_assert(volume[unloaded[k]] == 0);
        assert_array_bits(&detail[unloaded[k]].hydrostatic.force.x, nothing, sizeof nothing / sizeof *nothing);
    }
    assert_array_bits(&hull.hydrostatic.force.x, &detail[ship].hydrostatic.force.x, sizeof nothing / sizeof *nothing);
    assert_vec3_close(loads[bare].force, vec3_make(0, 0, -9.81 * s.bodies.mass[bare]), 0);

    /* Without detail the same loads. */
    wrench again[6];
    assert_ok(fluid_apply(&ctx, &windy, coefficients, &s.bodies, &s.shapes, NULL, again, NULL, &error), error);
    assert_array_bits(&again[0].force.x, &loads[0].force.x, 36);
    mesh_free(&ctx, &surface);
    scene_free(&ctx, &s);
}
END_TEST

START_TEST(threads_do_not_matter)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    random_stream r = random_begin(6, 0, 0);
    int32_t shapes[2] = {add_prism(&ctx, &s, OUTLINE(hexagon_outline), 0.5),
                         add_prism(&ctx, &s, OUTLINE(square_outline), 0.6)};
    enum { BODIES = 333 };
    for (int i = 0; i < BODIES; i++)
        add_body(&ctx, &s, MOTION_DYNAMIC, MATERIAL_ICE, shapes[i % 2], &r);
    static wrench alone[BODIES], together[BODIES];
    fram_error error = {0};
    assert_ok(fluid_apply(&ctx, &still_water, coefficients, &s.bodies, &s.shapes, NULL, alone, NULL, &error), error);
    for (int threads = 2; threads <= 5; threads += 3) {
        ctx.threads = pool_create(&ctx, threads);
        ck_assert_ptr_nonnull(ctx.threads);
        memset(together, 0, sizeof together);
        assert_ok(fluid_apply(&ctx, &still_water, coefficients, &s.bodies, &s.shapes, NULL, together, NULL, &error),
                  error);
        assert_array_bits(&together[0].force.x, &alone[0].force.x, 6 * BODIES);
        pool_free(&ctx, ctx.threads);
        ctx.threads = NULL;
    }
    scene_free(&ctx, &s);
}
END_TEST

START_TEST(no_bodies)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    fram_error error = {0};
    assert_ok(fluid_apply(&ctx, &still_water, coefficients, &s.bodies, &s.shapes, NULL, NULL, NULL, &error), error);
}
END_TEST

TEST_MAIN("apply", slots, threads_do_not_matter, no_bodies)
