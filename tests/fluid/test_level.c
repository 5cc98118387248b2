/* Level floes, eight at a time: against the walk over all faces of a prism, against a fine mesh, and the same bits in
   any company and with any instruction set. */
#include "field.h"

enum { FLOES = 600 };

/* Hydrostatics to rounding. */
START_TEST(hydrostatics)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(11, 0, 0);
    for (int i = 0; i < FLOES; i++)
        add_floe(&f, &r, i % OUTLINES, 0.02, 0.3);
    static const drag_coefficients none[MATERIAL_COUNT];
    fluid_load *loads = apply(&f, &still_water, none);
    for (int i = 0; i < FLOES; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        fluid_load_prism(&still_water, none, outline_of(i % OUTLINES), half_height, &state, &expected);
        double size = expected.hydrostatic.force.z;
        assert_vec3_close(loads[i].hydrostatic.force, expected.hydrostatic.force, 1e-14 * size);
        assert_vec3_close(loads[i].hydrostatic.moment, expected.hydrostatic.moment, 1e-13 * size);
        assert_relative(loads[i].submerged_volume, expected.submerged_volume, 1e-14);
        ck_assert(vec3_length(loads[i].water_drag.force) == 0 && vec3_length(loads[i].wind_drag.moment) == 0);
    }
    free(loads);
    field_close(&f);
}
END_TEST

/* Form drag: exact while no side turns around over its depth, which is so without roll and pitch; else the error of
   two points over the depth of a side. */
START_TEST(form_drag)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(12, 0, 0);
    for (int i = 0; i < FLOES; i++) {
        add_floe(&f, &r, i % OUTLINES, 0.02, 0.3);
        /* About the body's own axis. */
        if (i % 2)
            f.bodies.angular_velocity[i] =
                vec3_scale(mat3_column(quat_matrix(f.bodies.orientation[i]), 2), random_uniform(&r, -0.3, 0.3));
    }
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 0.8}};
    media moving = still_water;
    moving.current = vec3_make(0.3, -0.2, 0);
    fluid_load *loads = apply(&f, &moving, c);
    double worst = 0;
    for (int i = 0; i < FLOES; i++) {
        load_error e = error_of(&f, &moving, c, 1, &loads[i], i);
        if (i % 2)
            ck_assert_msg(e.water < 1e-14 && e.air < 1e-16, "floe %d: %g, %g", i, e.water, e.air);
        worst = testing_larger(worst, testing_larger(e.water, e.air));
    }
    ck_assert_msg(worst < 1e-4, "worst %g", worst);
    free(loads);
    field_close(&f);
}
END_TEST

/* A cap whose motion has one sign, and one that rests: the other branches of the cap's form drag. */
START_TEST(form_drag_of_caps)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(13, 0, 0);
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 0.8}};
    for (int i = 0; i < 16; i++) {
        int32_t slot = add_floe(&f, &r, i % OUTLINES, 0.01, 1e-3);
        f.bodies.velocity[slot] = vec3_make(0, 0, i % 4 < 2 ? -0.5 : 0.5);
        if (i % 2)
            f.bodies.angular_velocity[slot] = vec3_make(0, 0, 0);
        if (i >= 12)
            f.bodies.velocity[slot] = vec3_make(0, 0, 0);
    }
    fluid_load *loads = apply(&f, &still_water, c);
    for (int i = 0; i < 16; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        fluid_load_prism(&still_water, c, outline_of(i % OUTLINES), half_height, &state, &expected);
        assert_vec3_close(loads[i].water_drag.force, expected.water_drag.force, 1e-3);
        assert_vec3_close(loads[i].water_drag.moment, expected.water_drag.moment, 1e-2);
        assert_vec3_close(loads[i].wind_drag.force, expected.wind_drag.force, 1e-6);
        assert_vec3_close(loads[i].wind_drag.moment, expected.wind_drag.moment, 1e-5);
    }
    free(loads);
    field_close(&f);
}
END_TEST

/* Skin drag against a fine mesh, in terms of the drag of the whole face at the largest speed. */
START_TEST(skin_drag)
{
    static const double bound[OUTLINES] = {1e-3, 1.5e-3, 1.2e-3, 1.5e-3, 1e-2, 1e-2};
    field f;
    field_open(&f);
    random_stream r = random_begin(14, 0, 0);
    for (int i = 0; i < 300; i++)
        add_floe(&f, &r, i % OUTLINES, 0.02, 0.5);
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_skin = 0.01, .air_skin = 0.003}};
    fluid_load *loads = apply(&f, &still_water, c);
    for (int k = 0; k < OUTLINES; k++) {
        mesh surface = prism_mesh(&f.ctx, outline_of(k), half_height), fine = refined_mesh(&f.ctx, &surface);
        for (int level = 0; level < 3; level++) {
            mesh finer = refined_mesh(&f.ctx, &fine);
            mesh_free(&f.ctx, &fine);
            fine = finer;
        }
        double worst = 0, worst_air = 0;
        for (int i = k; i < 300; i += OUTLINES) {
            fluid_motion state = motion_of(&f, i);
            fluid_load expected = {0};
            fluid_load_mesh(&still_water, c, &fine, &state, &expected);
            double reach = 0.5 * polygon_diameter(outline_of(k)),
                   speed = largest_speed(&state, vec3_make(0, 0, 0), reach);
            double area = polygon_area(outline_of(k)) * speed * speed;
            worst = testing_larger(worst, apart(&loads[i].water_drag, &expected.water_drag, reach) /
                                              (0.5 * 1025 * 0.01 * area));
            worst_air = testing_larger(worst_air, apart(&loads[i].wind_drag, &expected.wind_drag, reach) /
                                                      (0.5 * 1.25 * 0.003 * area));
        }
        ck_assert_msg(worst < bound[k] && worst_air < 2 * bound[k], "outline %d: %g in water, %g in air", k, worst,
                      worst_air);
        mesh_free(&f.ctx, &fine);
        mesh_free(&f.ctx, &surface);
    }
    free(loads);
    field_close(&f);
}
END_TEST

static const drag_coefficients all_kinds[MATERIAL_COUNT] = {{1, 0.01, 0.8, 0.003}};

/* A floe's load is its own: whoever shares its batch, and whatever instruction set runs it. */
START_TEST(company_and_instructions)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(15, 0, 0);
    /* Tilts up to where a good part is no longer level. */
    for (int i = 0; i < FLOES; i++)
        add_floe(&f, &r, i % OUTLINES, i % 7 ? 0.03 : 0.2, 0.3);
    for (int i = 0; i < FLOES; i += 5)
        f.bodies.position[i].z -= 12; /* sunken, among them floes of all kinds */
    fluid_load *together = apply(&f, &still_water, all_kinds);
    const isa best = isa_best();
    for (int set = ISA_BASELINE; set <= (int)best; set++) {
        f.ctx.isa = (isa)set;
        fluid_load *again = apply(&f, &still_water, all_kinds);
        assert_array_bits(&again[0].hydrostatic.force.x, &together[0].hydrostatic.force.x,
                          FLOES * (long)(sizeof *again / sizeof(double)));
        free(again);
    }
    for (int i = 0; i < FLOES; i += 7) {
        field g;
        field_open(&g);
        random_stream other = random_begin(16, 0, 0);
        for (int k = 0; k < i % 5; k++)
            add_floe(&g, &other, 5, 0.01, 1);
        int32_t slot = add_floe(&g, &other, i % OUTLINES, 0.01, 1);
        g.bodies.position[slot] = f.bodies.position[i];
        g.bodies.orientation[slot] = f.bodies.orientation[i];
        g.bodies.velocity[slot] = f.bodies.velocity[i];
        g.bodies.angular_velocity[slot] = f.bodies.angular_velocity[i];
        fluid_load *alone = apply(&g, &still_water, all_kinds);
        assert_array_bits(&alone[slot].hydrostatic.force.x, &together[i].hydrostatic.force.x,
                          (long)(sizeof *alone / sizeof(double)));
        free(alone);
        field_close(&g);
    }
    free(together);
    field_close(&f);
}
END_TEST

/* Where the water plane begins to cut a cap, one way of reckoning takes over from the other without a jump. */
START_TEST(no_jump)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(17, 0, 0);
    for (int i = 0; i < 2000; i++) {
        add_floe(&f, &r, 0, 0, 0);
        /* The corner (5, 5) touches at 10 sin(roll) / 2 + ... = 0.6; a fine sweep across that. */
        f.bodies.position[i] = vec3_make(0, 0, 0.1);
        f.bodies.orientation[i] = quat_from_roll_pitch_yaw(0.05, -0.045 - 1e-5 * i, 0);
        f.bodies.velocity[i] = vec3_make(0.3, 0.1, -0.05);
        f.bodies.angular_velocity[i] = vec3_make(0.01, 0.02, 0.05);
    }
    fluid_load *loads = apply(&f, &still_water, all_kinds);
    for (int i = 1; i < 2000; i++) {
        assert_absolute(loads[i].hydrostatic.force.z, loads[i - 1].hydrostatic.force.z, 150);
        assert_vec3_close(loads[i].water_drag.force, loads[i - 1].water_drag.force, 0.5);
        assert_vec3_close(loads[i].water_drag.moment, loads[i - 1].water_drag.moment, 2);
    }
    free(loads);
    field_close(&f);
}
END_TEST

/* ---- sunken floes ---- */

/* Floes wholly in the water in any pose, between 2 and 12 m deep; half of them do not turn. */
static void add_sunken(field *f, random_stream *r, int count, double spin)
{
    for (int i = 0; i < count; i++) {
        int32_t slot = add_floe(f, r, i % OUTLINES, 3, i % 2 ? spin : 0);
        f->bodies.position[slot].z = -12 - random_uniform(r, 0, 10);
    }
}

/* All loads of sunken floes: hydrostatics to rounding, nothing of the air, drag of what does not turn to rounding and
   of what turns within bounds. */
static void assert_sunken(const field *f, const media *m, const drag_coefficients *c, double coefficient,
                          const fluid_load *loads, double worst_bound, double mean_bound)
{
    double worst = 0, mean = 0;
    for (int i = 0; i < FLOES; i++) {
        load_error e = error_of(f, m, c, coefficient, &loads[i], i);
        ck_assert_double_lt(e.hydrostatic, 1e-12);
        ck_assert_double_lt(e.volume, 1e-14);
        ck_assert(vec3_length(loads[i].wind_drag.force) == 0 && vec3_length(loads[i].wind_drag.moment) == 0);
        if (i % 2 == 0)
            ck_assert_msg(e.water < 1e-13, "floe %d: %g", i, e.water);
        worst = testing_larger(worst, e.water);
        mean += e.water / FLOES;
    }
    ck_assert_msg(worst < worst_bound && mean < mean_bound, "worst %g, mean %g", worst, mean);
}

/* Hydrostatics to rounding; form drag of what does not turn too.  Of what turns, the sides' part that moves into the
   water is found at the middle of their height: the error is of the square of the turn over the thickness.  Nothing of
   the air. */
START_TEST(sunken_form_drag)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(18, 0, 0);
    add_sunken(&f, &r, FLOES, 0.3);
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 0.8}};
    media moving = still_water;
    moving.current = vec3_make(0.3, -0.2, 0);
    fluid_load *loads = apply(&f, &moving, c);
    assert_sunken(&f, &moving, c, 1, loads, 2e-4, 1e-5);
    free(loads);
    field_close(&f);
}
END_TEST

/* A floe upside down with a part over the water is not sunken. */
START_TEST(capsized_floes_float)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(21, 0, 0);
    for (int i = 0; i < OUTLINES; i++) {
        add_floe(&f, &r, i, 0, 0.3);
        f.bodies.position[i].z = -0.3;
        f.bodies.orientation[i] = quat_from_roll_pitch_yaw(PI, 0.01, 0.3);
    }
    fluid_load *loads = apply(&f, &still_water, all_kinds);
    for (int i = 0; i < OUTLINES; i++) {
        fluid_motion state = motion_of(&f, i);
        fluid_load expected;
        fluid_load_prism(&still_water, all_kinds, outline_of(i), half_height, &state, &expected);
        assert_vec3_close(loads[i].hydrostatic.force, expected.hydrostatic.force, 1e-14 * expected.hydrostatic.force.z);
        ck_assert_double_gt(vec3_length(expected.wind_drag.force), 0.01);
        assert_vec3_close(loads[i].wind_drag.force, expected.wind_drag.force, 1e-3);
    }
    free(loads);
    field_close(&f);
}
END_TEST

/* Skin drag of sunken floes as of level ones. */
START_TEST(sunken_skin_drag)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(19, 0, 0);
    add_sunken(&f, &r, FLOES, 0.5);
    static const drag_coefficients c[MATERIAL_COUNT] = {{.water_skin = 0.01}};
    fluid_load *loads = apply(&f, &still_water, c);
    assert_sunken(&f, &still_water, c, 0.01, loads, 3e-2, 3e-3);
    free(loads);
    field_close(&f);
}
END_TEST

/* Where the last corner goes under, a floe that floats is as one that has sunk. */
START_TEST(no_jump_where_it_sinks)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(20, 0, 0);
    for (int i = 0; i < 2000; i++) {
        add_floe(&f, &r, 0, 0, 0);
        f.bodies.position[i] = vec3_make(0, 0, -0.59 - 1e-5 * i);
        f.bodies.orientation[i] = quat_from_roll_pitch_yaw(0, 0, 0);
        f.bodies.velocity[i] = vec3_make(0.3, 0.1, -0.05);
        f.bodies.angular_velocity[i] = vec3_make(0.01, 0.02, 0.05);
    }
    static const drag_coefficients sides[MATERIAL_COUNT] = {{.water_form = 1}};
    fluid_load *loads = apply(&f, &still_water, sides);
    for (int i = 1; i < 2000; i++) {
        assert_absolute(loads[i].hydrostatic.force.z, loads[i - 1].hydrostatic.force.z, 15);
        assert_absolute(loads[i].water_drag.force.x, loads[i - 1].water_drag.force.x, 0.5);
    }
    free(loads);
    field_close(&f);
}
END_TEST

TEST_MAIN("level", hydrostatics, form_drag, form_drag_of_caps, skin_drag, company_and_instructions, no_jump,
          sunken_form_drag, capsized_floes_float, sunken_skin_drag, no_jump_where_it_sinks)
