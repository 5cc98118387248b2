/* Hulls from files: sealed, given topsides, repaired on request, and the observed numbers of a real one. */
#include "io/hull_file.h"
#include "mesh_texts.h"
#include "testing.h"

static fram_status finish(context *ctx, const char *name, const char *text, const hull_file_options *options,
                          mesh *surface, hull_file_report *report, fram_error *error)
{
    mesh_file file;
    fram_status status = mesh_file_parse(ctx, name, text, strlen(text), &file, error);
    return status == FRAM_OK ? hull_file_finish(ctx, name, &file, options, surface, report, error) : status;
}

static void check_sound(context *ctx, const mesh *m, double volume)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, m, true, &report), FRAM_OK);
    ck_assert_int_eq(report.defect, MESH_CLOSED);
    assert_relative(mesh_solid_properties(m).volume, volume, 1e-12);
}

START_TEST(topsides)
{
    context ctx;
    context_init(&ctx);
    /* The mirrored box of 2 x 2 x 1; its lid in the water plane, which is left out; and a flat bottom in z = 0, which
       is none. */
    enum { BOX, LID, KEEL, TEXTS };
    const char *const texts[TEXTS] = {GDF_BOX, GDF_HEAD("1", "1", "4") GDF_QUARTER "0 0 0  1 0 0  1 1 0  0 1 0\n",
                                      GDF_HEAD("1", "1", "3") "0 0 0  0 1 0  1 1 0  1 0 0\n"
                                                              "1 0 0  1 1 0  1 1 1  1 0 1\n"
                                                              "1 1 0  0 1 0  0 1 1  1 1 1\n"};
    const double freeboards[] = {(double)NAN, 0.5, 2};
    for (size_t t = 0; t < TEXTS; t++)
        for (size_t i = 0; i < 3; i++) {
            hull_file_options options = hull_file_defaults();
            options.freeboard = freeboards[i];
            double height = isnan(freeboards[i]) ? 1.0 / 3 : freeboards[i];
            mesh m = {0};
            hull_file_report report;
            fram_error error = {0};
            assert_ok(finish(&ctx, "box.gdf", texts[t], &options, &m, &report, &error), error);
            check_sound(&ctx, &m, 4 * (1 + height));
            assert_relative(report.freeboard, height, 1e-15);
            ck_assert_int_eq(report.lids, t == LID ? 8 : 0);
            ck_assert(report.mirror_x && report.mirror_y);
            assert_absolute(mesh_bounds(&m).hi.z, height + (t == KEEL), 1e-15);
            mesh_free(&ctx, &m);
        }
}
END_TEST

START_TEST(scale)
{
    context ctx;
    context_init(&ctx);
    hull_file_options options = hull_file_defaults();
    options.scale = 0.001;
    mesh m = {0};
    hull_file_report report;
    fram_error error = {0};
    assert_ok(finish(&ctx, "mm.obj",
                     "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", &options, &m,
                     &report, &error),
              error);
    check_sound(&ctx, &m, 1.0 / 6);
    mesh_free(&ctx, &m);
}
END_TEST

/* What is refused without repair is mended with it. */
START_TEST(repair)
{
    context ctx;
    context_init(&ctx);
    const struct {
        const char *name, *text;
        double volume, freeboard;
        int holes, flipped, dropped;
    } cases[] = {
        {"hole.obj", OBJ_POINTS "f 1 3 2\nf 1 2 4\nf 1 4 3\n", 1.0 / 6, (double)NAN, 1, 0, 0},
        {"turned.obj", OBJ_POINTS "f 1 3 2\nf 2 1 4\nf 1 4 3\nf 2 3 4\n", 1.0 / 6, (double)NAN, 0, 1, 0},
        {"inside_out.obj", OBJ_POINTS "f 2 3 1\nf 4 2 1\nf 3 4 1\nf 4 3 2\n", 1.0 / 6, (double)NAN, 0, 4, 0},
        {"flat.obj", OBJ_POINTS "v 0.5 0.5 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 5 3\n", 1.0 / 6, (double)NAN, 0,
         0, 1},
        {"inside_out.gdf",
         GDF_HEAD("1", "1", "3") "1 0 -1 1 1 -1 0 1 -1 0 0 -1\n1 0 0 1 1 0 1 1 -1 1 0 -1\n1 1 0 0 1 0 0 1 -1 1 1 -1\n",
         8, 1, 0, 24, 0},
        {"gap.gdf", GDF_HEAD("1", "1", "2") "1 0 -1  1 1 -1  1 1 0  1 0 0\n1 1 -1  0 1 -1  0 1 0  1 1 0\n", 8, 1, 1, 0,
         0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        hull_file_options options = hull_file_defaults();
        options.freeboard = cases[i].freeboard;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        ck_assert_int_eq(finish(&ctx, cases[i].name, cases[i].text, &options, &m, &report, &error), FRAM_ERROR_INPUT);
        options.repair = true;
        assert_ok(finish(&ctx, cases[i].name, cases[i].text, &options, &m, &report, &error), error);
        check_sound(&ctx, &m, cases[i].volume);
        ck_assert_int_eq(report.holes, cases[i].holes);
        ck_assert_msg(report.flipped == cases[i].flipped, "%s: %d turned", cases[i].name, report.flipped);
        ck_assert_int_eq(report.dropped, cases[i].dropped);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A tetrahedron with a cavity in which another one stands: water comes to the outer skin alone. */
START_TEST(inner_parts)
{
    context ctx;
    context_init(&ctx);
    hull_file_options options = hull_file_defaults();
    mesh m = {0};
    hull_file_report report;
    fram_error error = {0};
    assert_ok(finish(&ctx, "tank.obj",
                     "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\nv 1 1 1\nv 3 1 1\nv 1 3 1\nv 1 1 3\n"
                     "v 1.5 1.5 1.5\nv 1.75 1.5 1.5\nv 1.5 1.75 1.5\nv 1.5 1.5 1.75\n"
                     "f 9 11 10\nf 9 10 12\nf 9 12 11\nf 10 11 12\n"
                     "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 5 6 7\nf 5 8 6\nf 5 7 8\nf 6 8 7\n",
                     &options, &m, &report, &error),
              error);
    check_sound(&ctx, &m, 512.0 / 6);
    ck_assert_int_eq(m.vertex.count, 4);
    ck_assert_int_eq(report.inner_parts, 2);
    assert_relative(report.inner_volume, (8 - 1.0 / 64) / 6, 1e-12);
    mesh_free(&ctx, &m);
}
END_TEST

/* A cup of 8 x 8 x 3 with walls and bottom of 0.5: full of water. */
START_TEST(open_boat)
{
    static const char *const text =
        "v -4 -4 -2\nv 4 -4 -2\nv 4 4 -2\nv -4 4 -2\nv -4 -4 1\nv 4 -4 1\nv 4 4 1\nv -4 4 1\n"
        "v -3.5 -3.5 -1.5\nv 3.5 -3.5 -1.5\nv 3.5 3.5 -1.5\nv -3.5 3.5 -1.5\n"
        "v -3.5 -3.5 1\nv 3.5 -3.5 1\nv 3.5 3.5 1\nv -3.5 3.5 1\n"
        "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
        "f 9 10 11 12\nf 13 14 10 9\nf 14 15 11 10\nf 15 16 12 11\nf 16 13 9 12\n"
        "f 5 6 14 13\nf 6 7 15 14\nf 7 8 16 15\nf 8 5 13 16\n";
    context ctx;
    context_init(&ctx);
    hull_file_options options = hull_file_defaults();
    mesh m = {0};
    hull_file_report report;
    fram_error error = {0};
    assert_ok(finish(&ctx, "boat.obj", text, &options, &m, &report, &error), error);
    check_sound(&ctx, &m, 8 * 8 * 3 - 7 * 7 * 2.5);
    assert_relative(report.well, 49.0 / 64, 1e-12);
    ck_assert(report.well > OPEN_BOAT);
    mesh_free(&ctx, &m);
    assert_ok(finish(&ctx, "tetrahedron.obj", OBJ_POINTS "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", &options, &m, &report,
                     &error),
              error);
    ck_assert(report.well == 0);
    mesh_free(&ctx, &m);
}
END_TEST

/* What closes half a hull makes half a ship of it: it is refused as half, and told where repair is asked for. */
START_TEST(half)
{
    context ctx;
    context_init(&ctx);
    const char *const box = "v 0 0 -1\nv 9 0 -1\nv 9 2 -1\nv 0 2 -1\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n"
                            "f 4 3 2 1\nf 2 3 7 6\nf 3 4 8 7\n";
    const struct {
        const char *faces, *words;
        hull_half half;
    } cases[] = {{"f 4 1 5 8\n", "open along its centre plane y = 0: mirror it", HULL_HALF_Y},
                 {"f 1 2 6 5\n",
                  "open along x = 0: mirror it there in the program that made the file, or have it repaired (repair)",
                  HULL_HALF_X},
                 {"", "a quarter of a hull, open along x = 0 and y = 0: mirror it", HULL_QUARTER}};
    for (int i = 0; i < 6; i++) {
        const int deck = i % 2, c = i / 2;
        char text[400];
        snprintf(text, sizeof text, "%s%s%s", box, cases[c].faces, deck ? "f 5 6 7 8\n" : "");
        hull_file_options options = hull_file_defaults();
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        ck_assert_int_eq(finish(&ctx, "half.obj", text, &options, &m, &report, &error), FRAM_ERROR_INPUT);
        ck_assert_msg(strstr(error.message, cases[c].words) != NULL, "%s", error.message);
        options.repair = true;
        fram_status status = finish(&ctx, "half.obj", text, &options, &m, &report, &error);
        const bool closes = deck && cases[c].half != HULL_QUARTER; /* the rim of a quarter is too crooked */
        ck_assert_int_eq(status, closes ? FRAM_OK : FRAM_ERROR_INPUT);
        ck_assert(report.half == (closes ? cases[c].half : HULL_WHOLE));
        mesh_free(&ctx, &m);
    }
}
END_TEST

START_TEST(options_are_checked)
{
    context ctx;
    context_init(&ctx);
    const struct {
        hull_file_options options;
        const char *key;
    } cases[] = {
        {{0, (double)NAN, false, (double)NAN}, "scale"}, {{-1, (double)NAN, false, (double)NAN}, "scale"},
        {{1, -0.1, false, (double)NAN}, "seal_width"},   {{1, HUGE_VAL, false, (double)NAN}, "seal_width"},
        {{1, (double)NAN, false, 0}, "freeboard"},       {{1, (double)NAN, false, HUGE_VAL}, "freeboard"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        ck_assert_int_eq(finish(&ctx, "t.obj", OBJ_TETRAHEDRON, &cases[i].options, &m, &report, &error),
                         FRAM_ERROR_INPUT);
        ck_assert_str_eq(error.key, cases[i].key);
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    const char *const cases[][2] = {{"box.gdf", GDF_BOX}, {"hole.obj", OBJ_POINTS "f 1 3 2\nf 1 2 4\nf 1 4 3\n"}};
    for (int i = 0; i < 2; i++)
        for (failing_turn turn = {0}; failing_next(&turn);) {
            hull_file_options options = hull_file_defaults();
            options.repair = true;
            mesh m = {0};
            hull_file_report report;
            turn.status = finish(&turn.ctx, cases[i][0], cases[i][1], &options, &m, &report, &turn.error);
            mesh_free(&turn.ctx, &m);
        }
}
END_TEST

TEST_MAIN("hull_file", topsides, scale, repair, inner_parts, open_boat, half, options_are_checked, memory_runs_out)
