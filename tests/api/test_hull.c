/* Hulls through the public interface. */
#include "fram/hull.h"
#include "scratch.h"
#include <stdio.h>
#include <unistd.h>

static fram_context *open_context(void)
{
    fram_context *shared = NULL;
    fram_error error = {0};
    assert_ok(fram_context_create(NULL, &shared, &error), error);
    return shared;
}

static fram_hull *make_box(fram_context *shared)
{
    fram_hull_particulars p;
    fram_hull_particulars_default(&p);
    ck_assert_uint_eq(p.size, sizeof p);
    p.box = true;
    p.length = 40;
    p.beam = 10;
    p.draught = 3;
    p.freeboard = 2;
    fram_hull *hull = NULL;
    fram_error error = {0};
    assert_ok(fram_hull_make(shared, &p, &hull, &error), error);
    return hull;
}

START_TEST(a_box)
{
    fram_context *shared = open_context();
    fram_hull *hull = make_box(shared);
    fram_hull_surface s;
    fram_hull_surface_get(hull, &s);
    ck_assert_str_eq(s.format, "particulars");
    ck_assert_int_eq(s.triangles, 12);
    ck_assert_int_eq(s.vertices, 8);
    const double lo[3] = {-20, -5, -3}, hi[3] = {20, 5, 2}, centroid[3] = {0, 0, -0.5};
    assert_array_absolute(s.lo, lo, 3, 0);
    assert_array_absolute(s.hi, hi, 3, 0);
    assert_array_absolute(s.centroid, centroid, 3, 1e-14);
    assert_relative(s.enclosed_volume, 2000, 1e-14);

    fram_hull_floating f;
    fram_error error = {0};
    assert_ok(fram_hull_float(hull, NULL, &f, &error), error);
    assert_relative(f.volume, 1200, 1e-14);
    assert_relative(f.mass, 1230e3, 1e-14);
    assert_relative(f.c33, 1025 * 9.81 * 400, 1e-14);
    assert_relative(f.gm_transverse, 1.5 + 1000.0 / 360 - 3, 1e-13);
    for (int i = 0; i < 3; i++)
        assert_relative(f.volume_integrals[i], 1200, 1e-13);

    /* Half in fresh water, by mass, with its centre of mass off the middle. */
    fram_hull_condition c;
    fram_hull_condition_default(&c);
    c.mass = 1000e3;
    c.water_density = 1000;
    c.centre[2] = -2;
    assert_ok(fram_hull_float(hull, &c, &f, &error), error);
    assert_relative(f.volume, 1000, 1e-13);
    assert_absolute(f.level, -0.5, 1e-13);
    assert_absolute(f.kg, 1, 1e-14);
    c.centre[1] = 0.05;
    assert_ok(fram_hull_float(hull, &c, &f, &error), error);
    ck_assert(f.heel < 0 && f.heel > -0.05); /* port down */
    c.draught = 2;
    assert_fails(fram_hull_float(hull, &c, &f, &error), error, FRAM_ERROR_USAGE, "give one of them");
    c.mass = (double)NAN;
    c.water_density = 0;
    assert_fails(fram_hull_float(hull, &c, &f, &error), error, FRAM_ERROR_INPUT, "positive density");
    c.water_density = 1025;
    c.gravity = -1;
    assert_fails(fram_hull_float(hull, &c, &f, &error), error, FRAM_ERROR_INPUT, "positive acceleration");
    c.gravity = 9.81;
    c.draught = -2;
    assert_fails(fram_hull_float(hull, &c, &f, &error), error, FRAM_ERROR_INPUT, "positive draught");

    double vertices[8][3];
    int triangles[12][3];
    fram_hull_triangles(hull, &vertices[0][0], 8, &triangles[0][0], 12);
    assert_array_absolute(vertices[0], lo, 3, 0);
    for (int i = 0; i < 12; i++)
        for (int k = 0; k < 3; k++)
            ck_assert(triangles[i][k] >= 0 && triangles[i][k] < 8);
    fram_hull_triangles(hull, NULL, 0, NULL, 0);
    fram_hull_destroy(hull);
    fram_hull_destroy(NULL);
    fram_context_destroy(shared);
}
END_TEST

START_TEST(pieces_and_files)
{
    fram_context *shared = open_context();
    fram_hull *hull = make_box(shared), *back = NULL;
    fram_hull_pieces pieces;
    fram_error error = {0};
    assert_ok(fram_hull_cut(hull, (double)NAN, 8, &pieces, &error), error);
    ck_assert_int_eq(pieces.count, 1);
    assert_absolute(pieces.tolerance, 0.1, 1e-15);
    assert_absolute(pieces.concavity, 0, 1e-3);
    assert_relative(pieces.volume, 2000, 1e-12);
    for (int most = 0; most <= FRAM_HULL_PIECES + 1; most += FRAM_HULL_PIECES + 1)
        assert_fails(fram_hull_cut(hull, (double)NAN, most, &pieces, &error), error, FRAM_ERROR_USAGE,
                     "expected 1 to 4096 pieces");
    assert_fails(fram_hull_cut(hull, -1, 8, &pieces, &error), error, FRAM_ERROR_USAGE, "positive distance");

    char folder[SCRATCH_FOLDER], path[SCRATCH_PATH];
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/box.obj", folder);
    assert_ok(fram_hull_save(hull, path, &error), error);
    fram_hull_file_definition d;
    fram_hull_file_default(&d);
    d.scale = 0.5;
    assert_ok(fram_hull_load(shared, path, &d, &back, &error), error);
    fram_hull_surface s;
    fram_hull_surface_get(back, &s);
    ck_assert_str_eq(s.format, "OBJ");
    assert_relative(s.enclosed_volume, 250, 1e-14);
    assert_fails(fram_hull_save(back, path, &error), error, FRAM_ERROR_USAGE, "a file of its own");
    assert_fails(fram_hull_draw(back, NULL, NULL, path, &error), error, FRAM_ERROR_USAGE, "a file of its own");
    unlink(path);
    ck_assert_int_eq(fram_hull_load(shared, path, NULL, &back, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.file, path);

    snprintf(path, sizeof path, "%s/box.png", folder);
    fram_status drawn = fram_hull_draw(back, NULL, NULL, path, &error);
    ck_assert(drawn == FRAM_OK || drawn == FRAM_ERROR_UNSUPPORTED);
    fram_hull_condition c;
    fram_hull_condition_default(&c);
    c.draught = 100;
    ck_assert_int_eq(fram_hull_draw(back, &c, "box", path, &error), FRAM_ERROR_INPUT);
    unlink(path);
    ck_assert_int_eq(rmdir(folder), 0);
    fram_hull_destroy(back);
    fram_hull_destroy(hull);
    fram_context_destroy(shared);
}
END_TEST

/* A context whose memory runs out: every call fails with that, and nothing is left behind.  Short: in every fifth
   place. */
START_TEST(memory_runs_out)
{
    for (failing_turn turn = {.stride = getenv("FRAM_TEST_SHORT") ? 5 : 1}; failing_next(&turn);) {
        fram_context_definition definition;
        fram_context_default(&definition);
        definition.memory = failing_memory_resize;
        definition.memory_user = &turn.memory;
        fram_context *shared = NULL;
        fram_hull *hull = NULL;
        fram_hull_pieces pieces;
        fram_hull_floating floating;
        fram_hull_particulars p;
        fram_hull_particulars_default(&p);
        p.block_coefficient = 0.5;
        fram_hull_condition c;
        fram_hull_condition_default(&c);
        c.mass = 7e6;
        turn.status = fram_context_create(&definition, &shared, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = fram_hull_make(shared, &p, &hull, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = fram_hull_cut(hull, (double)NAN, 4, &pieces, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = fram_hull_float(hull, &c, &floating, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = fram_hull_draw(hull, &c, "hull", "/nonexistent/hull.png", &turn.error);
        fram_hull_destroy(hull);
        fram_context_destroy(shared);
        if (turn.status == FRAM_ERROR_IO || turn.status == FRAM_ERROR_INPUT || turn.status == FRAM_ERROR_UNSUPPORTED)
            turn.status = FRAM_OK; /* the picture has nowhere to go */
        else
            ck_assert(turn.memory.failed);
    }
}
END_TEST

/* What is left to the form is what is usual for it: the same hull comes of the defaults and of those numbers. */
START_TEST(defaults_are_those_of_the_form)
{
    const double degree = 3.14159265358979323846 / 180;
    fram_context *shared = open_context();
    fram_error error = {0};
    for (int ship = 0; ship < 2; ship++) {
        double volume[2];
        for (int given = 0; given < 2; given++) {
            fram_hull *hull = NULL;
            fram_hull_surface surface;
            fram_hull_particulars p;
            fram_hull_particulars_default(&p);
            p.ship = ship;
            p.length = 220, p.beam = 42, p.draught = 12;
            if (given) {
                p.stem_angle = (ship ? 75 : 30) * degree;
                p.stern_angle = (ship ? 45 : 30) * degree;
                p.flare_angle = (ship ? 0 : 8) * degree;
            }
            if (given && !ship) {
                p.entrance_angle = 30 * degree;
                p.parallel_midbody = 0.4;
            }
            assert_ok(fram_hull_make(shared, &p, &hull, &error), error);
            fram_hull_surface_get(hull, &surface);
            volume[given] = surface.enclosed_volume;
            fram_hull_destroy(hull);
        }
        assert_relative(volume[1], volume[0], 1e-12);
    }
    fram_context_destroy(shared);
}
END_TEST

/* An icebreaker of the usual angles, whose bow and stern differ: heave turns it in pitch and not in roll; its pieces
   fill it together; and no more is copied than there is room for. */
START_TEST(an_icebreaker)
{
    fram_context *shared = open_context();
    fram_hull *hull = NULL;
    fram_hull_particulars p;
    fram_hull_particulars_default(&p);
    const double found[] = {p.stem_angle,       p.entrance_angle, p.flare_angle, p.stern_angle,
                            p.parallel_midbody, p.bilge_radius,   p.transom};
    for (int i = 0; i < 7; i++)
        ck_assert_msg(isnan(found[i]), "member %d of the defaults says %g before the form is known", i, found[i]);
    fram_error error = {0};
    assert_ok(fram_hull_make(shared, &p, &hull, &error), error);
    fram_hull_floating f;
    assert_ok(fram_hull_float(hull, NULL, &f, &error), error);
    double couple = 1025 * 9.81 * f.waterplane_area * (f.centre_of_flotation[0] - f.centre[0]);
    ck_assert(fabs(couple) > 1e6);
    assert_relative(fabs(f.c35), fabs(couple), 1e-6);
    assert_absolute(f.c34, 0, 1e-6 * fabs(couple));

    fram_hull *bulb = NULL;
    fram_hull_pieces pieces;
    fram_hull_surface s;
    assert_ok(fram_hull_load(shared, "examples/hulls/ship_with_bulb.obj", NULL, &bulb, &error), error);
    fram_hull_surface_get(bulb, &s);
    assert_ok(fram_hull_cut(bulb, (double)NAN, 16, &pieces, &error), error);
    ck_assert_int_gt(pieces.count, 1);
    assert_relative(pieces.volume, s.enclosed_volume, 0.1);
    fram_hull_destroy(bulb);

    double vertices[3 * 4];
    int triangles[3 * 6];
    for (int i = 0; i < 12; i++)
        vertices[i] = -77;
    for (int i = 0; i < 18; i++)
        triangles[i] = -77;
    fram_hull_triangles(hull, vertices, 3, triangles, 5);
    ck_assert(vertices[8] != -77 && vertices[9] == -77);
    ck_assert(triangles[14] >= 0 && triangles[15] == -77);
    fram_hull_triangles(hull, NULL, 0, NULL, 0);
    fram_hull_destroy(hull);
    fram_context_destroy(shared);
}
END_TEST

TEST_MAIN("hull", an_icebreaker, defaults_are_those_of_the_form, a_box, pieces_and_files, memory_runs_out)
