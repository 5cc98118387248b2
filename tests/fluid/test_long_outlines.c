/* Outlines of any number of corners, level, sunken and tilted: against the walk over all faces of a prism, the same
   bits in any company and with any instruction set, and drag that is held. */
#include "field.h"

#include "fluid/held_drag.h"
#include "fluid/prism_room.h"

/* Each alone, and together with shorter ones that come after it in a batch, and long ones. */
static const int32_t corners[] = {24, 25, 31, 32, 39, 38, 64, 150, 601, 2048, 2049};
enum { LONG = sizeof corners / sizeof corners[0], EACH = 12, FLOES = LONG * EACH };

static const drag_coefficients all[MATERIAL_COUNT] = {{1, 0.01, 0.8, 0.003}};
static const drag_coefficients form[MATERIAL_COUNT] = {{.water_form = 1, .air_form = 0.8}};

static void field_open_long(field *f)
{
    *f = (field){0};
    context_init(&f->ctx);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f->ctx);
    ck_assert_ptr_nonnull(cutter);
    random_stream r = random_begin(40, 0, 0);
    for (int i = 0; i < LONG; i++) {
        vec2 room[2049];
        polygon star = outline_star(&r, vec2_make(0, 0), 4.6, 5.4, corners[i], room);
        vec2 centre = polygon_moments_of(star).centroid;
        for (int32_t k = 0; k < star.count; k++)
            room[k] = vec2_sub(room[k], centre);
        int32_t row;
        assert_ok(shape_add_prism(&f->ctx, &f->shapes, cutter, star, half_height, 0, &row, &error), error);
        ck_assert_int_eq(row, i);
    }
    overlay_free(cutter);
}

/* Of each outline as many; a third of them level, a third sunken, a third in any pose. */
static void add_floes(field *f)
{
    random_stream r = random_begin(41, 0, 0);
    for (int i = 0; i < FLOES; i++) {
        int32_t slot = add_floe(f, &r, i % LONG, i / LONG % 3 == 0 ? 0.02 : 1.5, 0.2);
        if (i / LONG % 3 == 1)
            f->bodies.position[slot].z = -12;
    }
}

static void load_by_walk(const field *f, const drag_coefficients *c, int i, fluid_load *out)
{
    fluid_motion state = motion_of(f, i);
    fluid_load_prism(&still_water, c, shape_outline(&f->shapes, f->bodies.shape[i]), half_height, &state, out);
}

/* Hydrostatics to rounding.  Form drag but for what level sides have at the middle of their depth, all drag but for the
   quadrature of skin, both in terms of the drag of a face at the floe's largest speed. */
START_TEST(loads_are_the_walk_s)
{
    field f;
    field_open_long(&f);
    add_floes(&f);
    fluid_load *whole = apply(&f, &still_water, all), *without_skin = apply(&f, &still_water, form);
    for (int i = 0; i < FLOES; i++) {
        fluid_motion state = motion_of(&f, i);
        double speed = largest_speed(&state, vec3_make(0, 0, 0), 5.4), face = PI * 25 * speed * speed;
        fluid_load expected;
        load_by_walk(&f, form, i, &expected);
        double buoyancy = 1025 * 9.81 * PI * 25 * 2 * half_height;
        assert_vec3_close(without_skin[i].hydrostatic.force, expected.hydrostatic.force, 1e-13 * buoyancy);
        assert_vec3_close(without_skin[i].hydrostatic.moment, expected.hydrostatic.moment, 1e-12 * buoyancy);
        assert_absolute(without_skin[i].submerged_volume, expected.submerged_volume, 1e-12 * PI * 25 * half_height);
        double water = apart(&without_skin[i].water_drag, &expected.water_drag, 5.4) / (0.5 * 1025 * face);
        double air = apart(&without_skin[i].wind_drag, &expected.wind_drag, 5.4) / (0.5 * 1.25 * 0.8 * face);
        ck_assert_msg(water < 1e-3 && air < 1e-3, "%d corners, floe %d: form %g, %g", corners[i % LONG], i, water, air);
        fluid_load all_of_it;
        load_by_walk(&f, all, i, &all_of_it);
        water = fabs(apart(&whole[i].water_drag, &all_of_it.water_drag, 5.4) / (0.5 * 1025 * face));
        ck_assert_msg(water < 1.2e-3, "%d corners, floe %d: %g", corners[i % LONG], i, water);
    }
    free(whole);
    free(without_skin);
    field_close(&f);
}
END_TEST

START_TEST(a_load_is_a_floe_s_own)
{
    field f;
    field_open_long(&f);
    add_floes(&f);
    fluid_load *together = apply(&f, &still_water, all);
    const long numbers = (long)(sizeof *together / sizeof(double));
    for (int set = ISA_BASELINE; set <= (int)isa_best(); set++) {
        f.ctx.isa = (isa)set;
        fluid_load *again = apply(&f, &still_water, all);
        assert_array_bits(&again[0].hydrostatic.force.x, &together[0].hydrostatic.force.x, FLOES * numbers);
        free(again);
    }
    for (int i = 0; i < FLOES; i += 5) {
        field g;
        field_open(&g); /* whose outlines have eight corners at most */
        fram_error error = {0};
        overlay *cutter = overlay_create(&g.ctx);
        int32_t row;
        assert_ok(shape_add_prism(&g.ctx, &g.shapes, cutter, shape_outline(&f.shapes, f.bodies.shape[i]), half_height,
                                  0, &row, &error),
                  error);
        overlay_free(cutter);
        random_stream other = random_begin(42, 0, 0);
        int32_t slot = add_floe(&g, &other, row, 0, 0);
        g.bodies.position[slot] = f.bodies.position[i];
        g.bodies.orientation[slot] = f.bodies.orientation[i];
        g.bodies.velocity[slot] = f.bodies.velocity[i];
        g.bodies.angular_velocity[slot] = f.bodies.angular_velocity[i];
        fluid_load *alone = apply(&g, &still_water, all);
        assert_array_bits(&alone[slot].hydrostatic.force.x, &together[i].hydrostatic.force.x, numbers);
        free(alone);
        field_close(&g);
    }
    free(together);
    field_close(&f);
}
END_TEST

/* Level ones are held, and are loaded by what is held as by what is computed. */
START_TEST(level_ones_are_held)
{
    field f;
    field_open_long(&f);
    random_stream r = random_begin(43, 0, 0);
    for (int i = 0; i < LONG; i++)
        add_floe(&f, &r, i, 0.005, 0.05);
    held_drag_table held = {0};
    wrench first[LONG], again[LONG];
    fram_error error = {0};
    assert_ok(fluid_apply(&f.ctx, &still_water, all, &f.bodies, &f.shapes, &held, first, NULL, &error), error);
    for (int i = 0; i < LONG; i++) {
        bool is_held = held.generation[i / HELD_LANES].lane[i % HELD_LANES] == f.bodies.generation[i];
        ck_assert_msg(is_held == (corners[i] <= PRISM_MOST_POINTS), "%d corners", corners[i]);
    }
    for (int i = 0; i < LONG; i++)
        f.bodies.velocity[i] = vec3_scale(f.bodies.velocity[i], 1 + 1e-9);
    assert_ok(fluid_apply(&f.ctx, &still_water, all, &f.bodies, &f.shapes, &held, again, NULL, &error), error);
    for (int i = 0; i < LONG; i++) {
        double speed = largest_speed(&(fluid_motion){.velocity = f.bodies.velocity[i]}, vec3_make(0, 0, 0), 5.4);
        assert_vec3_close(again[i].force, first[i].force, 1e-6 * 0.5 * 1025 * PI * 25 * speed * speed);
    }
    table_free(&f.ctx, &held, &held_drag_table_info);
    field_close(&f);
}
END_TEST

TEST_MAIN("long_outlines", loads_are_the_walk_s, a_load_is_a_floe_s_own, level_ones_are_held)
