/* Tilted floes, eight at a time: against the walk over all faces of a prism, against a fine mesh, in poses that are
   none in particular and in those where corners and caps lie in the water plane. */
#include "field.h"

enum { FLOES = 900 };

static bool turns(int floe) { return floe / OUTLINES % 2; }

/* Floes in any pose that the water plane cuts somewhere, or nearly; every other one of an outline does not turn. */
static void add_tilted(field *f, random_stream *r, double tilt, double spin)
{
    for (int i = 0; i < FLOES; i++) {
        int32_t slot = add_floe(f, r, i % OUTLINES, tilt, turns(i) ? spin : 0);
        f->bodies.position[slot].z = random_uniform(r, -4, 4);
    }
}

/* In terms of the whole floe's weight in water. */
static double buoyancy_apart(const fluid_load *a, const fluid_load *b, int outline)
{
    double reach = 0.5 * polygon_diameter(outline_of(outline));
    return apart(&a->hydrostatic, &b->hydrostatic, reach) /
           (1025 * 9.81 * 2 * half_height * polygon_area(outline_of(outline)));
}

/* Neither level, with one cap in the water and the other not, nor sunken. */
static bool is_tilted(const fluid_motion *s, polygon outline)
{
    double rise = half_height * s->rotation.m[2][2], low = HUGE_VAL, high = -HUGE_VAL;
    for (int32_t k = 0; k < outline.count; k++) {
        double z = s->position.z + vec3_dot(mat3_tmul_vec(s->rotation, vec3_make(0, 0, 1)),
                                            vec3_make(outline.vertex[k].x, outline.vertex[k].y, 0));
        low = fmin(low, z);
        high = fmax(high, z);
    }
    return high + fabs(rise) > 0 && !(low + rise >= 0 && high - rise <= 0);
}

/* Hydrostatics of all floes and drag of those that are tilted, to rounding. */
static void assert_exact(double tilt, const media *m)
{
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 0.8}};
    field f;
    field_open(&f);
    random_stream r = random_begin(31, 0, 0);
    add_tilted(&f, &r, tilt, 0.3);
    fluid_load *loads = apply(&f, m, c);
    int tilted = 0;
    for (int i = 0; i < FLOES; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        fluid_load_prism(m, c, outline_of(i % OUTLINES), half_height, &state, &expected);
        ck_assert_double_lt(buoyancy_apart(&loads[i], &expected, i % OUTLINES), 1e-14);
        assert_absolute(loads[i].submerged_volume, expected.submerged_volume, 1e-12);
        load_error e = error_of(&f, m, c, 1, &loads[i], i);
        double air = e.air * m->water_density / m->air_density;
        if (!is_tilted(&state, outline_of(i % OUTLINES)))
            continue;
        ck_assert_msg(e.water < 1e-10 && air < 1e-10, "floe %d: %g, %g", i, e.water, air);
        tilted++;
    }
    ck_assert_int_gt(tilted, FLOES / 3);
    free(loads);
    field_close(&f);
}

START_TEST(hydrostatics_and_form_drag)
{
    media moving = still_water;
    moving.current = vec3_make(0.3, -0.2, 0);
    moving.wind = vec3_make(-2, 1, 0);
    assert_exact(0.2, &moving);
    assert_exact(3, &moving);
}
END_TEST

START_TEST(a_current_that_changes_with_depth)
{
    media m = still_water;
    m.profile = (current_profile){.count = 2, .depth = {0, 4}, .velocity = {{0.4, 0, 0}, {-0.2, 0.3, 0}}};
    assert_exact(0.5, &m);
}
END_TEST

/* A fine mesh of a prism; the caller frees it. */
static mesh fine_prism(context *ctx, polygon outline, double half)
{
    mesh fine = prism_mesh(ctx, outline, half);
    for (int level = 0; level < 4; level++) {
        mesh finer = refined_mesh(ctx, &fine);
        mesh_free(ctx, &fine);
        fine = finer;
    }
    return fine;
}

/* Skin drag against a fine mesh, in terms of the drag of the whole face at the largest speed; to rounding without
   rotation. */
START_TEST(skin_drag)
{
    static const double bound[OUTLINES] = {2.5e-3, 2.5e-3, 3e-3, 2.5e-3, 1e-2, 1e-2};
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_skin = 0.01, .air_skin = 0.003}};
    field f;
    field_open(&f);
    random_stream r = random_begin(33, 0, 0);
    add_tilted(&f, &r, 3, 0.5);
    fluid_load *loads = apply(&f, &still_water, c);
    for (int k = 0; k < OUTLINES; k++) {
        mesh fine = fine_prism(&f.ctx, outline_of(k), half_height);
        for (int i = k; i < 300; i += OUTLINES) {
            fluid_motion state = motion_of(&f, i);
            fluid_load expected = {0};
            fluid_load_mesh(&still_water, c, &fine, &state, &expected);
            double reach = 0.5 * polygon_diameter(outline_of(k));
            double speed = largest_speed(&state, vec3_make(0, 0, 0), reach);
            double area = polygon_area(outline_of(k)) * speed * speed, most = turns(i) ? bound[k] : 1e-11;
            double water = apart(&loads[i].water_drag, &expected.water_drag, reach) / (0.5 * 1025 * 0.01 * area);
            double air = apart(&loads[i].wind_drag, &expected.wind_drag, reach) / (0.5 * 1.25 * 0.003 * area);
            ck_assert_msg(water < most && air < most, "floe %d: %g in water, %g in air", i, water, air);
        }
        mesh_free(&f.ctx, &fine);
    }
    free(loads);
    field_close(&f);
}
END_TEST

static const drag_coefficients all_kinds[MATERIAL_COUNT] = {{1, 0.01, 0.8, 0.003}};

/* Corners and whole caps in the water plane, a quarter of a turn and half a one: what of a floe lies in the plane
   counts once, and a cap as wet. */
START_TEST(poses_in_the_plane)
{
    static const double quarter = 0.70710678118654752; /* sin of half a right angle */
    const quat turn[] = {
        {1, 0, 0, 0}, {quarter, quarter, 0, 0}, {quarter, 0, -quarter, 0}, {0, 1, 0, 0}, {0.8, 0.6, 0, 0}};
    const double height[] = {-4.5, -half_height, -0.25, 0.25, half_height, 4.5};
    enum { TURNS = sizeof turn / sizeof *turn, HEIGHTS = sizeof height / sizeof *height };
    field f;
    field_open(&f);
    random_stream r = random_begin(34, 0, 0);
    for (int i = 0; i < OUTLINES * TURNS * HEIGHTS; i++) {
        int32_t slot = add_floe(&f, &r, i % OUTLINES, 0, 0);
        f.bodies.position[slot].z = height[i / OUTLINES % HEIGHTS];
        f.bodies.orientation[slot] = turn[i / OUTLINES / HEIGHTS];
    }
    fluid_load *loads = apply(&f, &still_water, all_kinds);
    for (int i = 0; i < f.bodies.count; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        state.position.z -= 1e-9;
        fluid_load_prism(&still_water, all_kinds, outline_of(i % OUTLINES), half_height, &state, &expected);
        ck_assert_double_lt(buoyancy_apart(&loads[i], &expected, i % OUTLINES), 1e-8);
        double reach = 0.5 * polygon_diameter(outline_of(i % OUTLINES)), speed = vec3_length(state.velocity);
        double size = polygon_area(outline_of(i % OUTLINES)) * speed * speed;
        ck_assert_double_lt(apart(&loads[i].water_drag, &expected.water_drag, reach), 1e-6 * size);
        ck_assert_double_lt(apart(&loads[i].wind_drag, &expected.wind_drag, reach), 1e-9 * size);
    }
    free(loads);
    field_close(&f);
}
END_TEST

/* A block thicker than it is wide, cut and sunken, that rolls: its sides' motion changes its sign over their depth. */
START_TEST(thick_blocks)
{
    static const drag_coefficients form[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 1}};
    static const drag_coefficients skin[MATERIAL_COUNT] = {{.water_skin = 1, .air_skin = 1}};
    static const vec2 block[] = {{-1, -4}, {1, -4}, {1, 4}, {-1, 4}};
    enum { BLOCKS = 120 };
    const double half = 2;
    field f;
    field_open(&f);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f.ctx);
    int32_t shape;
    assert_ok(shape_add_prism(&f.ctx, &f.shapes, cutter, OUTLINE(block), half, 0, &shape, &error), error);
    overlay_free(cutter);
    random_stream r = random_begin(37, 0, 0);
    for (int i = 0; i < BLOCKS; i++) {
        int32_t slot = add_floe(&f, &r, shape, 0, 0.4);
        f.bodies.position[slot].z = i % 2 ? random_uniform(&r, -3, 3) : -10;
        f.bodies.orientation[slot] = quat_from_roll_pitch_yaw(random_uniform(&r, 0.6, 2.5), 0.3, i);
        if (i % 3)
            f.bodies.velocity[slot] = random_vector(&r, 0.05);
    }
    mesh fine = fine_prism(&f.ctx, OUTLINE(block), half);
    fluid_load *by_form = apply(&f, &still_water, form), *by_skin = apply(&f, &still_water, skin);
    double worst = 0, mean = 0;
    for (int i = 0; i < BLOCKS; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        double reach = 0.5 * polygon_diameter(OUTLINE(block));
        double speed = largest_speed(&state, vec3_make(0, 0, 0), reach);
        double size = 0.5 * 1025 * polygon_area(OUTLINE(block)) * speed * speed;
        fluid_load_prism(&still_water, form, OUTLINE(block), half, &state, &expected);
        ck_assert_double_lt(apart(&by_form[i].water_drag, &expected.water_drag, reach), 1e-12 * size);
        fluid_load_mesh(&still_water, skin, &fine, &state, &expected);
        double e = apart(&by_skin[i].water_drag, &expected.water_drag, reach) / size;
        worst = testing_larger(worst, e);
        mean += e / BLOCKS;
    }
    ck_assert_msg(worst < 2e-2 && mean < 5e-3, "worst %g, mean %g", worst, mean);
    mesh_free(&f.ctx, &fine);
    free(by_form);
    free(by_skin);
    field_close(&f);
}
END_TEST

/* From under the water to over it: no jump where a corner crosses the plane, and one formula takes over from another.
 */
START_TEST(no_jump_on_the_way_out)
{
    enum { STEPS = 4000 };
    field f;
    field_open(&f);
    random_stream r = random_begin(35, 0, 0);
    const double step = 8.0 / STEPS;
    for (int i = 0; i < STEPS; i++) {
        add_floe(&f, &r, 1, 0, 0);
        f.bodies.position[i] = vec3_make(0, 0, -4 + step * i);
        f.bodies.orientation[i] = quat_from_roll_pitch_yaw(0.6, -0.5, 0);
        f.bodies.velocity[i] = vec3_make(0.3, 0.1, -0.05);
        f.bodies.angular_velocity[i] = vec3_make(0.01, 0.02, 0.05);
    }
    fluid_load *loads = apply(&f, &still_water, all_kinds);
    /* A step wets at most an area of 40 m2 by its height. */
    for (int i = 1; i < STEPS; i++) {
        assert_absolute(loads[i].submerged_volume, loads[i - 1].submerged_volume, 40 * step);
        assert_vec3_close(loads[i].water_drag.force, loads[i - 1].water_drag.force, 200 * step);
        assert_vec3_close(loads[i].water_drag.moment, loads[i - 1].water_drag.moment, 1000 * step);
        assert_vec3_close(loads[i].wind_drag.force, loads[i - 1].wind_drag.force, 0.3 * step);
    }
    assert_relative(loads[0].submerged_volume, 2 * half_height * polygon_area(outline_of(1)), 1e-14);
    ck_assert(loads[STEPS - 1].submerged_volume == 0);
    free(loads);
    field_close(&f);
}
END_TEST

/* An outline with more crossings than a batch has room for, and one of more vertices than a level floe may have, in one
   field with others: the walk over its faces, to the bit, and the lanes, to rounding. */
START_TEST(outlines_of_many_corners)
{
    enum { TEETH = 12, ROUND = 30 };
    vec2 saw[2 * TEETH], wheel[ROUND];
    for (int i = 0; i < TEETH; i++) {
        saw[i] = (vec2){i, i % 2 ? 6 : 0};
        saw[2 * TEETH - 1 - i] = (vec2){i, i % 2 ? 6.5 : 0.5};
    }
    for (int i = 0; i < ROUND; i++)
        wheel[i] = (vec2){4 * real_cos(2 * PI / ROUND * i), 4 * real_sin(2 * PI / ROUND * i)};
    const polygon outline[2] = {{saw, 2 * TEETH}, {wheel, ROUND}};
    field f;
    field_open(&f);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f.ctx);
    for (int i = 0; i < 2; i++) {
        int32_t row;
        assert_ok(shape_add_prism(&f.ctx, &f.shapes, cutter, outline[i], half_height, 0, &row, &error), error);
    }
    overlay_free(cutter);
    random_stream r = random_begin(36, 0, 0);
    for (int i = 0; i < 24; i++) {
        int32_t slot = add_floe(&f, &r, i % (OUTLINES + 2), 0, 0);
        f.bodies.position[slot].z = 0;
        f.bodies.orientation[slot] = quat_from_roll_pitch_yaw(0.5, 0, 0);
    }
    fluid_load *loads = apply(&f, &still_water, all_kinds);
    for (int i = 0; i < 24; i++) {
        int32_t shape = f.bodies.shape[i];
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        fluid_load_prism(&still_water, all_kinds, shape_outline(&f.shapes, shape), half_height, &state, &expected);
        double size = expected.hydrostatic.force.z, most = shape == OUTLINES ? 0 : 1e-13 * size;
        assert_absolute(loads[i].hydrostatic.force.z, expected.hydrostatic.force.z, most);
        assert_vec3_close(loads[i].hydrostatic.moment, expected.hydrostatic.moment, most);
        assert_vec3_close(loads[i].water_drag.force, expected.water_drag.force, most);
        assert_vec3_close(loads[i].wind_drag.moment, expected.wind_drag.moment, most);
    }
    free(loads);
    field_close(&f);
}
END_TEST

TEST_MAIN("tilted", hydrostatics_and_form_drag, a_current_that_changes_with_depth, skin_drag, poses_in_the_plane,
          thick_blocks, no_jump_on_the_way_out, outlines_of_many_corners)
