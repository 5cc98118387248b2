/* Where a hull floats and how stiffly: closed forms of boxes, righting levers, equilibrium found from anywhere. */
#include "samples.h"
#include "vessel/hydrostatics.h"

static mesh box_of(context *ctx, vec3 lo, vec3 hi)
{
    mesh m = {0};
    ck_assert(mesh_make_box(ctx, lo, hi, &m));
    return m;
}

/* Box 10 x 4 x 2 at half density, centre of mass in its middle: the oracle's GM and righting levers. */
START_TEST(righting_levers)
{
    context ctx;
    context_init(&ctx);
    mesh m = box_of(&ctx, vec3_make(-5, -2, -1), vec3_make(5, 2, 1));
    const vec3 centre = {0, 0, 0};
    const hull_attitude upright = {0, 0, 0};
    hull_stability s;
    fram_error error = {0};
    assert_ok(hull_stability_of(&ctx, &m, &upright, centre, &s, &error), error);
    assert_absolute(s.gm_transverse, 0.8333333333333333, 1e-14);
    ck_assert(s.stable);
    const double heel[] = {5, 15, 26}, lever[] = {0.0730745278, 0.2280707852, 0.4348300074};
    for (int i = 0; i < 3; i++)
        for (int side = -1; side <= 1; side += 2) {
            const hull_attitude a = {0, side * radians(heel[i]), 0};
            hull_hydrostatics h;
            assert_ok(hull_hydrostatics_in(&ctx, &m, &a, &h, &error), error);
            assert_relative(h.volume, 40, 1e-13);
            /* Starboard down: buoyancy moves to starboard. */
            assert_absolute(-side * h.centre_of_buoyancy.y, lever[i], 1e-10);
            /* A centre of mass off the middle by just that much heels it by that angle. */
            hull_attitude found;
            double off = -side * lever[i] / real_cos(radians(heel[i]));
            assert_ok(hull_float(&ctx, &m, 40, vec3_make(0, off, 0), &found, &error), error);
            assert_absolute(degrees(found.heel), side * heel[i], 1e-7);
            assert_absolute(found.trim, 0, 1e-12);
            assert_absolute(found.level, 0, 1e-10);
        }
    mesh_free(&ctx, &m);
}
END_TEST

/* All numbers of a box off the origin, by hand. */
START_TEST(box_by_hand)
{
    context ctx;
    context_init(&ctx);
    mesh m = box_of(&ctx, vec3_make(10, -3, -2), vec3_make(30, 5, 6));
    const hull_attitude a = {1, 0, 0};
    hull_stability s;
    fram_error error = {0};
    assert_ok(hull_stability_of(&ctx, &m, &a, vec3_make(18, 0.5, 2), &s, &error), error);
    assert_relative(s.at.volume, 20 * 8 * 3, 1e-13);
    assert_relative(s.enclosed_volume, 20 * 8 * 8, 1e-13);
    assert_vec3_close(s.centre_of_buoyancy, vec3_make(20, 1, -0.5), 1e-13);
    assert_vec3_close(s.centre_of_flotation, vec3_make(20, 1, 1), 1e-13);
    assert_relative(s.at.wetted_area, 160 + 2 * 28 * 3, 1e-13);
    assert_absolute(s.kb, 1.5, 1e-13);
    assert_absolute(s.kg, 4, 0);
    assert_relative(s.bm_transverse, 20 * 512 / 12.0 / 480, 1e-12);
    assert_relative(s.bm_longitudinal, 8 * 8000 / 12.0 / 480, 1e-12);
    assert_relative(s.gm_transverse, s.bm_transverse - 2.5, 1e-12);
    ck_assert(!s.stable);
    assert_relative(s.c33, 160, 1e-13);
    assert_relative(s.c34, 160 * 0.5, 1e-12);
    assert_relative(s.c35, -160 * 2, 1e-12);
    assert_relative(s.c44, 20 * 512 / 12.0 + 160 * 0.25 - 480 * 2.5, 1e-12);
    assert_relative(s.c45, -160, 1e-11);
    assert_relative(s.c55, 8 * 8000 / 12.0 + 160 * 4 - 480 * 2.5, 1e-12);
    const double lengths[] = {s.length_overall,    s.breadth_overall, s.depth,        s.length_waterline,
                              s.breadth_waterline, s.draught,         s.draught_fore, s.draught_aft,
                              s.midships,          s.midship_area};
    const double expected[] = {20, 8, 8, 20, 8, 3, 3, 3, 20, 24};
    assert_array_relative(lengths, expected, 10, 1e-14);
    const double coefficients[] = {s.block, s.waterplane, s.midship, s.prismatic}, one[] = {1, 1, 1, 1};
    assert_array_relative(coefficients, one, 4, 1e-13);
    mesh_free(&ctx, &m);
}
END_TEST

/* The stiffness is what a small change of the attitude does to force and moment. */
START_TEST(stiffness_is_the_derivative)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    p.block_coefficient = 0.52;
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error = {0};
    assert_ok(hull_make(&ctx, &p, &m, &pieces, &error), error);
    const vec3 centre = {1, 0.4, -0.5};
    const hull_attitude at = {0.3, 0.05, -0.02};
    hull_stability s;
    assert_ok(hull_stability_of(&ctx, &m, &at, centre, &s, &error), error);
    /* Turned about the centre of mass, in the frame of the water: columns heave, roll, pitch. */
    const double c[3][3] = {{s.c33, s.c34, s.c35}, {s.c34, s.c44, s.c45}, {s.c35, s.c45, s.c55}}, e = 1e-5;
    for (int k = 0; k < 3; k++) {
        double load[2][3];
        for (int side = 0; side < 2; side++) {
            double by = side ? e : -e;
            mat3 turn = quat_matrix(quat_unit((quat){1, k == 1 ? by / 2 : 0, k == 2 ? by / 2 : 0, 0}));
            mat3 r = mat3_mul(turn, hull_rotation(&at));
            vec3 before = mat3_mul_vec(hull_rotation(&at), centre), after = mat3_mul_vec(r, centre);
            vec3 angles = quat_roll_pitch_yaw(quat_from_matrix(r));
            hull_attitude a = {at.level + after.z - before.z - (k == 0 ? by : 0), angles.x, angles.y};
            hull_hydrostatics h;
            assert_ok(hull_hydrostatics_in(&ctx, &m, &a, &h, &error), error);
            /* quat_roll_pitch_yaw leaves out the yaw, which turns the frame of the water. */
            vec3 g = mat3_mul_vec(hull_rotation(&a), centre);
            vec3 arm = vec3_sub(h.centre_of_buoyancy, g);
            double cy = real_cos(angles.z), sy = real_sin(angles.z);
            load[side][0] = h.volume;
            load[side][1] = h.volume * (arm.x * sy + arm.y * cy);
            load[side][2] = -h.volume * (arm.x * cy - arm.y * sy);
        }
        for (int i = 0; i < 3; i++)
            assert_absolute((load[1][i] - load[0][i]) / (-2 * e), c[i][k], 1e-6 * s.c55);
        /* The short axis by itself. */
        assert_absolute((load[1][1] - load[0][1]) / (-2 * e), c[1][k], 2e-5 * s.c44 + 1e-5 * fabs(s.c45));
    }
    free_hull(&ctx, &m, &pieces);
}
END_TEST

/* An icebreaker loaded off its middle: the centre of buoyancy ends under the centre of mass. */
START_TEST(equilibrium)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error = {0};
    assert_ok(hull_make(&ctx, &p, &m, &pieces, &error), error);
    double enclosed = mesh_solid_properties(&m).volume;
    for (int i = 1; i < 10; i++) {
        double volume = enclosed * i / 10;
        const vec3 centre = {4 - 0.7 * i, 0.15 * i - 0.6, -4 + 0.1 * i};
        hull_attitude a;
        hull_hydrostatics h;
        assert_ok(hull_float(&ctx, &m, volume, centre, &a, &error), error);
        assert_ok(hull_hydrostatics_in(&ctx, &m, &a, &h, &error), error);
        vec3 g = mat3_mul_vec(hull_rotation(&a), centre);
        assert_relative(h.volume, volume, 1e-12);
        assert_absolute(h.centre_of_buoyancy.x, g.x, 1e-10);
        assert_absolute(h.centre_of_buoyancy.y, g.y, 1e-10);
        double level;
        assert_ok(hull_level_of(&ctx, &m, volume, &level, &error), error);
        assert_ok(hull_hydrostatics_at(&ctx, &m, level, &h, &error), error);
        assert_relative(h.volume, volume, 1e-13);
    }
    free_hull(&ctx, &m, &pieces);
}
END_TEST

START_TEST(what_does_not_float)
{
    context ctx;
    context_init(&ctx);
    mesh m = box_of(&ctx, vec3_make(-5, -2, -1), vec3_make(5, 2, 1));
    hull_attitude a;
    hull_stability s;
    fram_error error = {0};
    const double volumes[] = {0, -1, 80, 81, HUGE_VAL, (double)NAN};
    for (int i = 0; i < 6; i++) {
        assert_fails(hull_float(&ctx, &m, volumes[i], (vec3){0, 0, 0}, &a, &error), error, FRAM_ERROR_INPUT,
                     "encloses 80 m3");
        ck_assert_str_eq(error.key, "mass");
    }
    const double levels[] = {-1, -3, 1, 5};
    for (int i = 0; i < 4; i++) {
        a = (hull_attitude){levels[i], 0, 0};
        assert_fails(hull_stability_of(&ctx, &m, &a, (vec3){0, 0, 0}, &s, &error), error, FRAM_ERROR_INPUT,
                     "does not cut the hull");
    }
    /* Top-heavy but exactly upright: an equilibrium, and not a stable one.  Tipped by a hair, it turns away. */
    assert_ok(hull_float(&ctx, &m, 40, vec3_make(0, 0, 3), &a, &error), error);
    assert_absolute(a.heel, 0, 0);
    assert_ok(hull_stability_of(&ctx, &m, &a, vec3_make(0, 0, 3), &s, &error), error);
    ck_assert(!s.stable);
    assert_ok(hull_float(&ctx, &m, 40, vec3_make(0, 0.01, 3), &a, &error), error);
    ck_assert(fabs(a.heel) > 1);
    assert_ok(hull_stability_of(&ctx, &m, &a, vec3_make(0, 0.01, 3), &s, &error), error);
    ck_assert(s.stable);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(slices)
{
    context ctx;
    context_init(&ctx);
    mesh m = box_of(&ctx, vec3_make(0, 0, 0), vec3_make(2, 3, 5));
    const double areas[] = {15, 10, 6};
    for (int axis = 0; axis < 3; axis++) {
        hull_slicer slicer;
        polygon_list rings = {0};
        fram_error error = {0};
        assert_ok(hull_slicer_make(&ctx, &m, axis, &slicer, &error), error);
        assert_ok(hull_slice(&ctx, &slicer, 0.7, &rings, &error), error);
        ck_assert_int_eq(polygon_list_count(&rings), 1);
        assert_absolute(polygon_area(polygon_list_get(&rings, 0)), areas[axis], 1e-14);
        polygon_list_free(&ctx, &rings);
        hull_slicer_free(&ctx, &slicer);
    }
    mesh_free(&ctx, &m);
}
END_TEST

/* A block coefficient is met by the hull's own volume, whatever was asked for, and the waterline stays. */
START_TEST(block_coefficients)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    double least, most;
    hull_block_range(&p, &least, &most);
    ck_assert(least > 0.2 && least < 0.45 && most > 0.5 && most < 1);
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error = {0};
    for (int i = 0; i <= 16; i++) {
        p.block_coefficient = least + (most - least) * i / 16;
        assert_ok(hull_make(&ctx, &p, &m, &pieces, &error), error);
        mesh_report report;
        ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
        ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
        hull_hydrostatics h;
        assert_ok(hull_hydrostatics_at(&ctx, &m, 0, &h, &error), error);
        assert_relative(h.volume, p.block_coefficient * p.length * p.beam * p.draught, 2e-9);
        assert_absolute(h.waterline.hi.x - h.waterline.lo.x, p.length, 1e-11);
        assert_absolute(h.waterline.hi.y - h.waterline.lo.y, p.beam, 1e-11);
        ck_assert_int_eq(pieces.count, 1);
        assert_relative(polyhedron_volume(&pieces.data[0]), mesh_solid_properties(&m).volume, 1e-9);
        free_hull(&ctx, &m, &pieces);
        m = (mesh){0};
        pieces = (polyhedron_array){0};
    }
    const double beyond[] = {least - 0.001, most + 0.001, -1, 2, (double)NAN};
    for (int i = 0; i < 5; i++) {
        p.block_coefficient = beyond[i];
        assert_fails(hull_make(&ctx, &p, &m, &pieces, &error), error, FRAM_ERROR_INPUT, "block coefficient can be");
        ck_assert_str_eq(error.key, "block_coefficient");
    }
    p = box_particulars;
    p.block_coefficient = 0.9;
    assert_fails(hull_make(&ctx, &p, &m, &pieces, &error), error, FRAM_ERROR_INPUT, "expected 1, that of a box");
    p.block_coefficient = 1;
    assert_ok(hull_make(&ctx, &p, &m, &pieces, &error), error);
    free_hull(&ctx, &m, &pieces);
}
END_TEST

START_TEST(memory_runs_out)
{
    context plain;
    context_init(&plain);
    mesh m = box_of(&plain, vec3_make(-5, -2, -1), vec3_make(5, 2, 1));
    for (failing_turn turn = {0}; failing_next(&turn);) {
        hull_attitude a;
        hull_stability s;
        polyhedron_array pieces = {0};
        double tolerance = (double)NAN, concavity;
        turn.status = hull_float(&turn.ctx, &m, 30, vec3_make(0.1, 0.1, 0), &a, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = hull_stability_of(&turn.ctx, &m, &a, vec3_make(0.1, 0.1, 0), &s, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = hull_cut(&turn.ctx, &m, &tolerance, 8, &pieces, &concavity, &turn.error);
        polyhedron_array_free(&turn.ctx, &pieces);
        if (!turn.memory.failed)
            assert_absolute(tolerance, 0.04, 1e-15);
    }
    mesh_free(&plain, &m);
}
END_TEST

TEST_MAIN("hydrostatics", righting_levers, box_by_hand, stiffness_is_the_derivative, equilibrium, what_does_not_float,
          slices, block_coefficients, memory_runs_out)
