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

/* volume 0: any */
static void check_sound(context *ctx, const mesh *m, double volume)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, m, true, &report), FRAM_OK);
    ck_assert_int_eq(report.defect, MESH_CLOSED);
    if (volume > 0)
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
    /* The second is off its planes by 2 and 4 mm, within a two-thousandth of its length. */
    const char *const boxes[] = {"v 0 0 -1\nv 9 0 -1\nv 9 2 -1\nv 0 2 -1\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n",
                                 "v 4e-3 2e-3 -1\nv 9 2e-3 -1\nv 9 2 -1\nv 2e-3 2 -1\n"
                                 "v 2e-3 4e-3 1\nv 9 4e-3 1\nv 9 2 1\nv 2e-3 2 1\n"};
    const struct {
        const char *faces, *words;
        hull_half half;
    } cases[] = {{"f 4 1 5 8\n", "open along its centre plane y = 0: mirror it", HULL_HALF_Y},
                 {"f 1 2 6 5\n",
                  "open along x = 0: mirror it there in the program that made the file, or have it repaired (repair)",
                  HULL_HALF_X},
                 {"", "a quarter of a hull, open along x = 0 and y = 0: mirror it", HULL_QUARTER}};
    for (int i = 0; i < 12; i++) {
        const int deck = i % 2, c = i / 2 % 3;
        char text[400];
        snprintf(text, sizeof text, "%sf 4 3 2 1\nf 2 3 7 6\nf 3 4 8 7\n%s%s", boxes[i / 6], cases[c].faces,
                 deck ? "f 5 6 7 8\n" : "");
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

/* A box of 40 x 10 m from z = -3 to `top`, whose corners there are off by some of `off`; its faces are picked by
   letters: bottom, fore, aft, port, starboard, and the deck's two triangles d and e. */
static void write_box(char text[1024], double top, double off, const char *faces)
{
    static const double part[] = {1, -0.5, 0.25, -1};
    static const struct {
        char letter;
        const char *line;
    } face[] = {{'b', "f 4 3 2 1\n"}, {'f', "f 2 3 7 6\n"}, {'a', "f 4 1 5 8\n"}, {'p', "f 3 4 8 7\n"},
                {'s', "f 1 2 6 5\n"}, {'d', "f 5 6 7\n"},   {'e', "f 5 7 8\n"}};
    int n = snprintf(text, 1024, "v -20 -5 -3\nv 20 -5 -3\nv 20 5 -3\nv -20 5 -3\n");
    for (int i = 0; i < 4; i++)
        n += snprintf(text + n, 1024 - (size_t)n, "v %d %d %.17g\n", i == 0 || i == 3 ? -20 : 20, i < 2 ? -5 : 5,
                      top + off * part[i]);
    for (size_t i = 0; i < sizeof face / sizeof *face; i++)
        if (strchr(faces, face[i].letter))
            n += snprintf(text + n, 1024 - (size_t)n, "%s", face[i].line);
}

/* Half a hull that has a hole elsewhere too is not told as half, nor one that is farther off its plane than the reach;
   repair, which would close either there, is not named. */
START_TEST(half_with_a_hole)
{
    context ctx;
    context_init(&ctx);
    hull_file_options options = hull_file_defaults();
    mesh m = {0};
    hull_file_report report;
    fram_error error = {0};
    assert_fails(finish(&ctx, "half.obj",
                        "v 0 0 -1\nv 9 0 -1\nv 9 2 -1\nv 0 2 -1\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n"
                        "f 4 3 2 1\nf 2 3 7 6\nf 4 1 5 8\nf 5 6 7 8\nf 3 8 7\n",
                        &options, &m, &report, &error),
                 error, FRAM_ERROR_INPUT, "one of 7 open edges); it ends in its centre plane y = 0, or near it");
    options.repair = true;
    assert_ok(finish(&ctx, "half.obj",
                     "v 0 0 -1\nv 9 0 -1\nv 9 2 -1\nv 0 2 -1\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n"
                     "f 4 3 2 1\nf 2 3 7 6\nf 4 1 5 8\nf 5 6 7 8\nf 3 8 7\n",
                     &options, &m, &report, &error),
              error);
    ck_assert_int_eq(report.holes, 2);
    mesh_free(&ctx, &m);
    const struct {
        const char *text, *words;
    } off[] = {{"v -9 0.03 -1\nv 9 0.03 -1\nv 9 2 -1\nv -9 2 -1\nv -9 0.03 1\nv 9 0.03 1\nv 9 2 1\nv -9 2 1\n"
                "f 4 3 2 1\nf 2 3 7 6\nf 4 1 5 8\nf 3 4 8 7\nf 5 6 7 8\n",
                "; it ends in its centre plane y = 0, or near it: lay its corners there into that plane"},
               {"v 0.03 -2 -1\nv 9 -2 -1\nv 9 2 -1\nv 0.03 2 -1\nv 0.03 -2 1\nv 9 -2 1\nv 9 2 1\nv 0.03 2 1\n"
                "f 4 3 2 1\nf 2 3 7 6\nf 1 2 6 5\nf 3 4 8 7\nf 5 6 7 8\n",
                "; it ends in x = 0, or near it"}};
    options.repair = false;
    for (size_t i = 0; i < sizeof off / sizeof *off; i++)
        assert_fails(finish(&ctx, "off.obj", off[i].text, &options, &m, &report, &error), error, FRAM_ERROR_INPUT,
                     off[i].words);
}
END_TEST

#define OPEN_BOX "bfaps"

/* Corners of an open top that are off its plane, as far as cracks are sealed (20 mm here), are laid into it: topsides
   stand on z = 0, whether holes are to be filled or not; farther off it is not level, and repair is not named. */
START_TEST(tops_within_reach)
{
    context ctx;
    context_init(&ctx);
    const double offs[] = {1e-6, 5e-5, 5e-4, 0.0199, 0.021};
    for (int i = 0; i < 15; i++) {
        char text[1024];
        const double off = offs[i / 3];
        write_box(text, 0, off, OPEN_BOX);
        hull_file_options options = hull_file_defaults();
        options.repair = i % 3 == 1;
        options.freeboard = i % 3 == 2 ? 2 : (double)NAN;
        options.usual_freeboard = 4;
        mesh m = {0};
        hull_file_report report = {0};
        fram_error error = {0};
        fram_status status = finish(&ctx, "noise.obj", text, &options, &m, &report, &error);
        const double freeboard = i % 3 == 2 ? 2 : 4;
        if (off > 0.02) {
            ck_assert(i % 3 == 1 ? report.holes == 1 : status == FRAM_ERROR_INPUT);
            ck_assert(i % 3 == 1 || strstr(error.message, "; it ends in the water plane z = 0, or near it: "));
        } else {
            assert_ok(status, error);
            check_sound(&ctx, &m, 0);
            assert_relative(mesh_solid_properties(&m).volume, 400 * (3 + freeboard), 1e-6);
            assert_absolute(mesh_bounds(&m).hi.z, freeboard, 1e-5);
            ck_assert_int_eq(report.holes, 0);
            assert_absolute(report.freeboard, freeboard, 0);
        }
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Above the water they are as far off a plane between the highest and the lowest. */
START_TEST(tops_within_reach_above)
{
    context ctx;
    context_init(&ctx);
    const double offs[] = {1e-4, 0.0199, 0.021};
    for (int i = 0; i < 3; i++) {
        char text[1024];
        write_box(text, 2, offs[i], OPEN_BOX);
        hull_file_options options = hull_file_defaults();
        options.usual_freeboard = 4;
        mesh m = {0};
        hull_file_report report = {0};
        fram_error error = {0};
        fram_status status = finish(&ctx, "noise.obj", text, &options, &m, &report, &error);
        if (offs[i] > 0.02) {
            ck_assert_int_eq(status, FRAM_ERROR_INPUT);
            ck_assert_msg(strstr(error.message, "; have it repaired (repair)"), "%s", error.message);
        } else {
            assert_ok(status, error);
            assert_relative(mesh_solid_properties(&m).volume, 2000, 1e-12);
            assert_absolute(mesh_bounds(&m).hi.z, 2, 1e-12);
            assert_absolute(report.decked, 400, 1e-9);
        }
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A lid that is off the water plane by a millimetre is one; the upper strip of the sides, 10 mm high, is none. */
START_TEST(lids_within_reach)
{
    static const char *const panels =
        "-20 5 -3  20 5 -3  20 0 -3  -20 0 -3\n20 0 -3  20 5 -3  20 5 -0.01  20 0 -0.01\n"
        "20 5 -3  -20 5 -3  -20 5 -0.01  20 5 -0.01\n-20 5 -3  -20 0 -3  -20 0 -0.01  -20 5 -0.01\n"
        "20 0 -0.01  20 5 -0.01  20 5 %1$g  20 0 %1$g\n20 5 -0.01  -20 5 -0.01  -20 5 %1$g  20 5 %1$g\n"
        "-20 5 -0.01  -20 0 -0.01  -20 0 %1$g  -20 5 %1$g\n-20 0 %1$g  20 0 %1$g  20 5 %1$g  -20 5 %1$g\n";
    context ctx;
    context_init(&ctx);
    const double lids[] = {0, 0.001, -0.001, 0.019, 0.2};
    for (int i = 0; i < 5; i++) {
        char text[1024] = GDF_HEAD("0", "1", "8");
        snprintf(text + strlen(text), sizeof text - strlen(text), panels, lids[i]);
        hull_file_options options = hull_file_defaults();
        options.freeboard = 2;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        assert_ok(finish(&ctx, "lid.gdf", text, &options, &m, &report, &error), error);
        const bool is_lid = lids[i] < 0.1; /* else a deck */
        ck_assert_int_eq(report.lids, is_lid ? 4 : 0);
        check_sound(&ctx, &m, 0);
        assert_relative(mesh_solid_properties(&m).volume, 400 * (3 + lids[i] + (is_lid ? 2 : 0)), 1e-12);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Lids of two boxes, one behind the other, are at one height, or none is a lid. */
START_TEST(lids_of_two_parts)
{
    context ctx;
    context_init(&ctx);
    const double heights[] = {0.001, 0.005};
    for (int i = 0; i < 2; i++) {
        char text[2048] = GDF_HEAD("0", "1", "10");
        for (int part = 0; part < 2; part++) {
            const double a = part ? 2 : -20, b = a + 18, z = part ? heights[i] : heights[0];
            const struct {
                double x, y, z;
            } corner[5][4] = {{{a, 5, -3}, {b, 5, -3}, {b, 0, -3}, {a, 0, -3}},
                              {{b, 0, -3}, {b, 5, -3}, {b, 5, z}, {b, 0, z}},
                              {{b, 5, -3}, {a, 5, -3}, {a, 5, z}, {b, 5, z}},
                              {{a, 5, -3}, {a, 0, -3}, {a, 0, z}, {a, 5, z}},
                              {{a, 0, z}, {b, 0, z}, {b, 5, z}, {a, 5, z}}};
            for (int k = 0; k < 20; k++)
                snprintf(text + strlen(text), sizeof text - strlen(text), "%g %g %g\n", corner[k / 4][k % 4].x,
                         corner[k / 4][k % 4].y, corner[k / 4][k % 4].z);
        }
        hull_file_options options = hull_file_defaults();
        options.freeboard = 2;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        assert_ok(finish(&ctx, "two.gdf", text, &options, &m, &report, &error), error);
        ck_assert_int_eq(report.lids, i == 0 ? 8 : 0);
        check_sound(&ctx, &m, 180 * (6 + heights[0] + heights[i] + (i == 0 ? 4 : 0)));
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A quarter of a hull between levels, each a rectangle of half a length and half a breadth; `lid` closes it at the
   last, whose corners are off by `off`. */
typedef struct level {
    double z, x, y;
} level;
enum { MOST_LEVELS = 6, PANELS_ROOM = 4096 };

static void write_levels(char text[PANELS_ROOM], const level *at, int count, bool lid, double off)
{
    const double x = at[0].x, y = at[0].y, z = at[0].z;
    int n = snprintf(text, PANELS_ROOM, GDF_HEAD("1", "1", "%d"), 1 + lid + 2 * (count - 1));
    n += snprintf(text + n, PANELS_ROOM - (size_t)n, "0 0 %.17g  0 %.17g %.17g  %.17g %.17g %.17g  %.17g 0 %.17g\n", z,
                  y, z, x, y, z, x, z);
    for (int i = 0; i + 1 < count; i++) {
        level a = at[i], b = at[i + 1];
        double d = i + 2 == count ? off : 0;
        n += snprintf(text + n, PANELS_ROOM - (size_t)n,
                      "%.17g 0 %.17g  %.17g %.17g %.17g  %.17g %.17g %.17g  %.17g 0 %.17g\n", a.x, a.z, a.x, a.y, a.z,
                      b.x, b.y, b.z, b.x, b.z + d);
        n += snprintf(text + n, PANELS_ROOM - (size_t)n,
                      "%.17g %.17g %.17g  0 %.17g %.17g  0 %.17g %.17g  %.17g %.17g %.17g\n", a.x, a.y, a.z, a.y, a.z,
                      b.y, b.z - d, b.x, b.y, b.z);
    }
    level top = at[count - 1];
    if (lid)
        snprintf(text + n, PANELS_ROOM - (size_t)n, "0 0 %.17g  %.17g 0 %.17g  %.17g %.17g %.17g  0 %.17g %.17g\n",
                 top.z, top.x, top.z + off, top.x, top.y, top.z, top.y, top.z - off);
}

static double volume_of_levels(const level *at, int count)
{
    double volume = 0;
    for (int i = 0; i + 1 < count; i++) {
        double x = at[i].x, y = at[i].y, dx = at[i + 1].x - x, dy = at[i + 1].y - y;
        volume += 4 * (at[i + 1].z - at[i].z) * (x * y + 0.5 * (x * dy + y * dx) + dx * dy / 3);
    }
    return volume;
}

/* Level parts of the wetted hull near the water plane (within 20 mm here) are no lids: all of it is where it is open
   there, and where there is doubt.  Lids off the plane close the hull, are level and at one height. */
START_TEST(wetted_parts_near_the_water)
{
    const struct {
        const char *what;
        level at[MOST_LEVELS];
        double off;
        int levels;
        bool closed, lid;
    } cases[] = {
        {"sponson", {{-3, 18, 4}, {-0.005, 18, 4}, {-0.005, 20, 5}, {0, 20, 5}}, 0, 4, false, false},
        {"low sponson", {{-3, 18, 4}, {-0.015, 18, 4}, {-0.015, 20, 5}, {0, 20, 5}}, 0, 4, false, false},
        {"ledge", {{-3, 20, 5}, {-0.005, 20, 5}, {-0.005, 18, 4}, {0, 18, 4}}, 0, 4, false, false},
        {"dish",
         {{-3, 3, 2}, {-0.4, 17.6, 9.3}, {-0.1, 19.4, 10.4}, {-0.02, 19.9, 10.7}, {0, 20, 10.8}},
         0,
         5,
         false,
         false},
        {"flat rim", {{-3, 18, 3}, {-0.019, 18, 3}, {-0.01, 19, 4}, {0, 20, 5}}, 0, 4, false, false},
        {"lid", {{-3, 20, 5}, {0, 20, 5}}, 0, 2, true, true},
        {"lid on a ledge", {{-3, 20, 5}, {-0.005, 20, 5}, {-0.005, 18, 4}, {0, 18, 4}}, 0, 4, true, true},
        {"high lid", {{-3, 20, 5}, {0.001, 20, 5}}, 0, 2, true, true},
        {"uneven lid", {{-3, 20, 5}, {-1, 20, 5}, {0, 20, 5}}, 0.002, 3, true, true},
        {"high lid on an overhang", {{-3, 10, 2}, {-1, 10, 2}, {0.001, 20, 5}}, 0, 3, true, true},
        {"high lid and ledge", {{-3, 20, 5}, {-0.005, 20, 5}, {-0.005, 18, 4}, {0.001, 18, 4}}, 0, 4, true, false},
        {"camber", {{-3, 20, 5}, {-0.1, 20, 5}, {-0.01, 19, 4}, {0.001, 10, 1}}, 0, 4, true, false},
        {"deck with rounded edges", {{-3, 20, 5}, {-0.015, 20, 5}, {0.01, 19.9, 4.9}}, 0, 3, true, false},
    };
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[PANELS_ROOM];
        const level *at = cases[i].at, top = at[cases[i].levels - 1];
        write_levels(text, at, cases[i].levels, cases[i].closed, cases[i].off);
        hull_file_options options = hull_file_defaults();
        options.freeboard = 2;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        fram_status status = finish(&ctx, cases[i].what, text, &options, &m, &report, &error);
        ck_assert_msg(status == FRAM_OK, "%s: %s", cases[i].what, error.message);
        ck_assert_msg(report.lids == (cases[i].lid ? 8 : 0), "%s: %d lids", cases[i].what, report.lids);
        check_sound(&ctx, &m, 0);
        const bool raised = !cases[i].closed || cases[i].lid;
        assert_relative(mesh_solid_properties(&m).volume,
                        volume_of_levels(at, cases[i].levels) + (raised ? 8 * top.x * top.y : 0), 1e-12);
        assert_absolute(mesh_bounds(&m).hi.z, top.z + (raised ? 2 : 0), 1e-12);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A hole of a deck is none of its top: it is filled on request, and no tower is built on it.  In the water plane that
   leaves a hull awash, and is not named. */
START_TEST(holes_of_decks)
{
    context ctx;
    context_init(&ctx);
    const double tops[] = {2, 0}, offs[] = {0, 5e-4};
    for (int i = 0; i < 4; i++) {
        char text[1024];
        write_box(text, tops[i / 2], offs[i % 2], OPEN_BOX "d");
        hull_file_options options = hull_file_defaults();
        options.freeboard = 2;
        options.usual_freeboard = 4;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        ck_assert_int_eq(finish(&ctx, "hole.obj", text, &options, &m, &report, &error), FRAM_ERROR_INPUT);
        const char *words =
            i / 2 ? "; it ends in the water plane z = 0" : "; have it repaired (repair): it is sound then";
        ck_assert_msg(strstr(error.message, words), "%s", error.message);
        options.repair = true;
        assert_ok(finish(&ctx, "hole.obj", text, &options, &m, &report, &error), error);
        assert_relative(mesh_solid_properties(&m).volume, 400 * (3 + tops[i / 2]), 1e-3);
        ck_assert_int_eq(report.holes, 1);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A hull that ends at the water is raised by what is usual, one that ends above it is decked there, about a well too;
   what is given is added.  Without either an OBJ file is refused, with both that it may be. */
START_TEST(freeboards_left_to_fram)
{
    static const char *const well = "v -2 -1 -3\nv 2 -1 -3\nv 2 1 -3\nv -2 1 -3\nv -2 -1 2\nv 2 -1 2\nv 2 1 2\n"
                                    "v -2 1 2\nf 9 10 2 1\nf 10 11 3 2\nf 11 12 4 3\nf 12 9 1 4\n"
                                    "f 9 13 14 10\nf 10 14 15 11\nf 11 15 16 12\nf 12 16 13 9\n";
    const struct {
        double top, given, usual, deck, area;
        bool well;
    } cases[] = {{0, (double)NAN, 4, 4, 400, false},       {0.019, (double)NAN, 4, 4.019, 400, false},
                 {-1, (double)NAN, 4, 3, 400, false},      {2, (double)NAN, 4, 2, 400, false},
                 {0.03, (double)NAN, 4, 0.03, 400, false}, {2, 4, 4, 6, 400, false},
                 {2, (double)NAN, 4, 2, 392, true},        {2, (double)NAN, (double)NAN, 0, 400, false}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        write_box(text, cases[i].top, 0, cases[i].well ? "faps" : OPEN_BOX);
        if (cases[i].well)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%s", well);
        hull_file_options options = hull_file_defaults();
        options.freeboard = cases[i].given;
        options.usual_freeboard = cases[i].usual;
        mesh m = {0};
        hull_file_report report;
        fram_error error = {0};
        fram_status status = finish(&ctx, "open.obj", text, &options, &m, &report, &error);
        if (isnan(cases[i].usual)) {
            ck_assert_int_eq(status, FRAM_ERROR_INPUT);
            ck_assert_ptr_nonnull(strstr(error.message, "it is sound with 2 m); as it ends 2 m above the water"));
            options.repair = true;
            assert_ok(finish(&ctx, "open.obj", text, &options, &m, &report, &error), error);
            check_sound(&ctx, &m, 2000);
        } else {
            assert_ok(status, error);
            check_sound(&ctx, &m, cases[i].area * (3 + cases[i].deck));
            assert_relative(mesh_bounds(&m).hi.z, cases[i].deck, 1e-12);
            assert_absolute(report.decked, cases[i].deck > cases[i].top ? 0 : cases[i].area, 1e-9);
        }
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
        {{.scale = 0, .seal_width = 1, .freeboard = 1}, "scale"},
        {{.scale = -1, .seal_width = 1, .freeboard = 1}, "scale"},
        {{.scale = 1, .seal_width = -0.1, .freeboard = 1}, "seal_width"},
        {{.scale = 1, .seal_width = HUGE_VAL, .freeboard = 1}, "seal_width"},
        {{.scale = 1, .seal_width = 1, .freeboard = 0}, "freeboard"},
        {{.scale = 1, .seal_width = 1, .freeboard = HUGE_VAL}, "freeboard"},
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

TEST_MAIN("hull_file", topsides, scale, repair, inner_parts, open_boat, half, half_with_a_hole, tops_within_reach,
          tops_within_reach_above, wetted_parts_near_the_water, lids_within_reach, lids_of_two_parts, holes_of_decks,
          freeboards_left_to_fram, options_are_checked, memory_runs_out)
