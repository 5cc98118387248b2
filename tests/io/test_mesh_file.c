/* Readers and writers of meshes: what is in a file comes out, and goes back. */
#include "io/mesh_file.h"
#include "mesh_texts.h"
#include "scratch.h"

/* Four panels of three corners each, one of them twice. */
#define GDF_PANELS "0 0 0 0 1 0 1 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 1 0 0 0 0 0 1 0 1 0 0 1 0 1 0 0 0 1 0 0 0 1 0 0 1"

static mesh_file parse(context *ctx, const char *name, const char *text)
{
    mesh_file f;
    fram_error error = {0};
    assert_ok(mesh_file_parse(ctx, name, text, strlen(text), &f, &error), error);
    return f;
}

static void check_volume(const mesh *m, double volume)
{
    vec3 v = mesh_volume_integrals(m);
    assert_absolute(v.x, volume, 1e-14);
    assert_absolute(v.y, volume, 1e-14);
    assert_absolute(v.z, volume, 1e-14);
}

START_TEST(tetrahedra)
{
    context ctx;
    context_init(&ctx);
    const struct {
        const char *name, *text;
        mesh_format format;
    } cases[] = {
        {"t.stl", STL_TETRAHEDRON, MESH_STL_TEXT},
        {"T.STL",
         "\xef\xbb\xbfSOLID\r\nfacet normal nan nan nan\r\nouter loop\r\nVERTEX 0 0 0\r\nvertex 0 1e0 0\r\n"
         "vertex +1.0 0 -0.0\r\nendloop endfacet " STL_FACET(
             STL_O, STL_X, STL_Z) "endsolid\n solid part two\n" STL_FACET(STL_O, STL_Z, STL_Y)
             STL_FACET(STL_X, STL_Y, STL_Z) "endsolid part two",
         MESH_STL_TEXT},
        {"t.obj", OBJ_TETRAHEDRON, MESH_OBJ},
        {"t.obj",
         "# all forms of a corner\nmtllib a.mtl\no t\nvt 0 0\nvn 0 0 1\n" OBJ_POINTS
         "usemtl m\ng a b\ns off\nf 1/1 3/1 2/1\nf 1//1 2//1 4//1\nf 1/1/1 4/1/1 \\\n3/1/1\nf -3 -2 -1 # back\n",
         MESH_OBJ},
        /* Carriage returns alone, and in between. */
        {"t.obj", "# of a Mac\rv 0 0 0\rv 1 0 0\r\rv 0 1 0\nv 0 0 1\r\r\nf 1 3 2\rf 1 2 4 # side\rf 1 4 3\rf 2 3 4\r",
         MESH_OBJ},
        /* A backslash continues lines of numbers of OBJ alone. */
        {"t.obj",
         "# C:\\hulls\\\nmtllib C:\\a\\\no \\\n" OBJ_POINTS "usemtl C:\\\nf 1 3 2 # side \\\n"
         "f 1 2 \\\n4\ng a\\\nf 1 4 3\nvt 0 \\\n0\nf 2 3 4\n",
         MESH_OBJ},
        {"mesh", "# C:\\\n" OBJ_TETRAHEDRON, MESH_OBJ},
        {"t.stl",
         "solid C:\\a\\\n" STL_FACET(STL_O, STL_Y, STL_X) STL_FACET(STL_O, STL_X, STL_Z) STL_FACET(STL_O, STL_Z, STL_Y)
             STL_FACET(STL_X, STL_Y, STL_Z) "endsolid",
         MESH_STL_TEXT},
        {"mesh", "C:\\hulls\\\n1.0D+00,9.80665D+00\n0,0\n4\n" GDF_PANELS, MESH_GDF},
        {"mesh", STL_TETRAHEDRON, MESH_STL_TEXT},
        {"mesh", OBJ_TETRAHEDRON, MESH_OBJ},
        {"mesh", "# a comment\n\n" OBJ_TETRAHEDRON, MESH_OBJ},
        {"t.gdf",
         "a corner twice\n1 9.8\n0 0\n4\n0 0 0, 0,1,0 1 0 0 1 0 0\n0 0 0 1.D0 0 0 0 0 1d+0 0 0 "
         "1\n0 0 0 0 0 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 0 1 1 0 0\n",
         MESH_GDF},
        {"mesh", "exported\n1.000000 9.806650   ULEN GRAV\n0  0   ISX  ISY\r\n4 NPAN, panels\n" GDF_PANELS, MESH_GDF},
        /* IGDEF 0: flat patches are panels. */
        {"t.gdf", GDF_HEAD("0", "0", "4 0") GDF_PANELS, MESH_GDF},
        /* A remark after the last panel. */
        {"t.gdf", GDF_HEAD("0", "0", "4") GDF_PANELS "\n\n! end of file, 4 panels\n", MESH_GDF},
        {"t.gdf", GDF_HEAD("0", "0", "4") GDF_PANELS " 4 panels", MESH_GDF},
        {"t.gdf", GDF_HEAD("0", "0", "4") GDF_PANELS "\n12 panels, 2 refined\n2026-11-30\n", MESH_GDF},
        {"t.gdf", GDF_HEAD("0", "0", "4") GDF_PANELS "\n2026 11\n! 1 2 3\n4", MESH_GDF},
        {"mesh", GDF_HEAD("0", "0", "4") GDF_PANELS, MESH_GDF},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mesh_file f = parse(&ctx, cases[i].name, cases[i].text);
        ck_assert_str_eq(mesh_format_name(f.format), mesh_format_name(cases[i].format));
        ck_assert_int_eq(f.surface.vertex.count, 4);
        ck_assert_int_eq(f.surface.face.count, 4);
        ck_assert_int_eq(f.elements, 4);
        ck_assert_int_eq(f.dropped, 0);
        check_volume(&f.surface, 1.0 / 6);
        for (int32_t k = 0; k < 4; k++)
            ck_assert_int_eq(f.element.data[k], k + 1);
        mesh_file_free(&ctx, &f);
    }
}
END_TEST

START_TEST(places)
{
    context ctx;
    context_init(&ctx);
    mesh_file f = parse(&ctx, "t.stl", STL_TETRAHEDRON);
    ck_assert_int_eq(f.line.data[0], 2);
    ck_assert_int_eq(f.line.data[3], 23);
    mesh_file_free(&ctx, &f);
    f = parse(&ctx, "t.obj", OBJ_TETRAHEDRON);
    ck_assert_int_eq(f.line.data[2], 7);
    mesh_file_free(&ctx, &f);
    f = parse(&ctx, "t.gdf", GDF_BOX);
    ck_assert_int_eq(f.line.data[f.line.count - 1], 7);
    mesh_file_free(&ctx, &f);
}
END_TEST

/* Facets that name a point twice go, and the others keep their numbers. */
START_TEST(flat_facets_are_dropped)
{
    context ctx;
    context_init(&ctx);
    mesh_file f =
        parse(&ctx, "t.stl", "solid\n" STL_FACET(STL_O, STL_X, STL_O) STL_FACET(STL_O, STL_X, STL_Y) "endsolid\n");
    ck_assert_int_eq(f.dropped, 1);
    ck_assert_int_eq(f.elements, 2);
    ck_assert_int_eq(f.surface.face.count, 1);
    ck_assert_int_eq(f.element.data[0], 2);
    mesh_file_free(&ctx, &f);
    f = parse(&ctx, "t.obj", OBJ_POINTS "f 1 1 2\nf 1 2 2 3 3 1\n");
    ck_assert_int_eq(f.dropped, 1);
    ck_assert_int_eq(f.surface.face.count, 1);
    mesh_file_free(&ctx, &f);
}
END_TEST

/* A pole that was computed anew for each triangle, as a sine of pi leaves it, is one vertex.  In a file with a triangle
   as small as that, nothing is joined: it would go. */
START_TEST(points_that_rounding_set_apart_are_one)
{
    static const char pole[] = "v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\n"
                               "v 1e-16 0 -1\nv 0 1e-16 -1\nv -1e-16 0 -1\nv 0 -1e-16 -1\n"
                               "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\nf 6 3 2\nf 7 4 3\nf 8 5 4\nf 9 2 5\n";
    static const char tiny[] = "v 1e-16 0 -2\nv 0 1e-16 -2\nv 0 0 -2\nf 10 11 12\n";
    context ctx;
    context_init(&ctx);
    mesh_file f = parse(&ctx, "pole.obj", pole);
    ck_assert_int_eq(f.surface.vertex.count, 6);
    ck_assert_int_eq(f.surface.face.count, 8);
    check_volume(&f.surface, 4.0 / 3);
    mesh_file_free(&ctx, &f);
    char both[sizeof pole + sizeof tiny];
    snprintf(both, sizeof both, "%s%s", pole, tiny);
    f = parse(&ctx, "tiny.obj", both);
    ck_assert_int_eq(f.surface.face.count, 9);
    ck_assert_int_eq(f.element.count, 9);
    ck_assert_int_eq(f.surface.vertex.count, 12);
    mesh_file_free(&ctx, &f);
}
END_TEST

/* Points so near that the square of their distance is 0 are two, and the triangle between them stays. */
START_TEST(only_equal_points_are_one)
{
    context ctx;
    context_init(&ctx);
    mesh_file f = parse(&ctx, "t.obj", OBJ_POINTS "v 0 -1e-301 0\nf 1 3 2\nf 1 4 5\nf 2 3 4\n");
    ck_assert_int_eq(f.surface.vertex.count, 5);
    ck_assert_int_eq(f.surface.face.count, 3);
    ck_assert_int_eq(f.element.count, 3);
    mesh_file_free(&ctx, &f);
}
END_TEST

START_TEST(polygons)
{
    context ctx;
    context_init(&ctx);
    /* An L extruded: two faces of six corners with a dent, and an unused vertex far away. */
    mesh_file f = parse(&ctx, "l.obj",
                        "v 900 900 900\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
                        "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n"
                        "f 7 6 5 4 3 2\nf 8 9 10 11 12 13\n"
                        "f 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 7 13 12\nf 7 2 8 13\n");
    ck_assert_int_eq(f.surface.vertex.count, 12);
    ck_assert_int_eq(f.surface.face.count, 2 * 4 + 6 * 2);
    check_volume(&f.surface, 4);
    mesh_report report;
    ck_assert_int_eq(mesh_check(&ctx, &f.surface, true, &report), FRAM_OK);
    ck_assert_int_eq(report.defect, MESH_CLOSED);
    mesh_file_free(&ctx, &f);
}
END_TEST

START_TEST(symmetry_planes)
{
    context ctx;
    context_init(&ctx);
    const struct {
        const char *text;
        int triangles;
        vec3 lo;
        double volume; /* by z, which an open top at z = 0 does not change */
    } cases[] = {
        {GDF_HEAD("0", "0", "3") GDF_QUARTER, 6, {0, 0, -1}, 1},
        {GDF_HEAD("1", "0", "3") GDF_QUARTER, 12, {-1, 0, -1}, 2},
        {GDF_HEAD("0", "1", "3") GDF_QUARTER, 12, {0, -1, -1}, 2},
        {GDF_BOX, 24, {-1, -1, -1}, 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mesh_file f = parse(&ctx, "box.gdf", cases[i].text);
        ck_assert_int_eq(f.surface.face.count, cases[i].triangles);
        assert_vec3_close(mesh_bounds(&f.surface).lo, cases[i].lo, 0);
        assert_absolute(mesh_volume_integrals(&f.surface).z, cases[i].volume, 1e-14);
        mesh_file_free(&ctx, &f);
    }
}
END_TEST

/* What is written is read back: to the bit as text, to 4-byte floats in binary STL. */
START_TEST(round_trips)
{
    context ctx;
    context_init(&ctx);
    mesh_file f = parse(&ctx, "t.obj",
                        "v 0.1 0.2 0.3\nv 1.00000000001 0 1e-7\nv 0 123456.789012345 0\nv 0 0 1\n"
                        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    scratch s = scratch_make();
    for (int format = 0; format < MESH_FORMAT_COUNT; format++) {
        static const char *const names[] = {"a.stl", "b.stl", "c.obj", "d.gdf"};
        const char *path = scratch_path(&s, names[format]);
        mesh_file back;
        fram_error error = {0};
        assert_ok(mesh_file_write_as(&ctx, path, (mesh_format)format, &f.surface, &error), error);
        assert_ok(mesh_file_read(&ctx, path, &back, &error), error);
        ck_assert_int_eq((int)back.format, format);
        ck_assert_int_eq(back.surface.face.count, 4);
        ck_assert_int_eq(back.surface.vertex.count, 4);
        for (int32_t i = 0; i < 4; i++) {
            vec3 p[3], q[3];
            mesh_face_points(&f.surface, i, p);
            mesh_face_points(&back.surface, i, q);
            if (format == MESH_STL_BINARY)
                assert_array_relative(&q[0].x, &p[0].x, 9, 6e-8);
            else
                assert_array_bits(&q[0].x, &p[0].x, 9);
        }
        mesh_file_free(&ctx, &back);
        unlink(path);
    }
    /* The ending names the format. */
    fram_error error = {0};
    assert_ok(mesh_file_write(&ctx, scratch_path(&s, "e.OBJ"), &f.surface, &error), error);
    unlink(s.path);
    assert_ok(mesh_file_write(&ctx, scratch_path(&s, "e.gdf"), &f.surface, &error), error);
    unlink(s.path);
    assert_fails(mesh_file_write(&ctx, scratch_path(&s, "e.ply"), &f.surface, &error), error, FRAM_ERROR_USAGE,
                 ".stl, .obj or .gdf");
    assert_ok(mesh_file_write(&ctx, scratch_path(&s, "e.stl"), &f.surface, &error), error);
    scratch_remove(&s, "e.stl");
    mesh_file_free(&ctx, &f);
}
END_TEST

START_TEST(files_that_cannot_be_read)
{
    context ctx;
    context_init(&ctx);
    mesh_file f;
    fram_error error = {0};
    assert_fails(mesh_file_read(&ctx, "no/such/hull.stl", &f, &error), error, FRAM_ERROR_INPUT, "No such file");
    ck_assert_str_eq(error.file, "no/such/hull.stl");
    assert_fails(mesh_file_read(&ctx, "tests", &f, &error), error, FRAM_ERROR_INPUT, "regular file");
    ck_assert_int_eq(f.surface.face.count, 0);
}
END_TEST

START_TEST(memory_runs_out)
{
    const struct {
        const char *name, *text;
    } cases[] = {{"t.stl", STL_TETRAHEDRON}, {"t.obj", OBJ_POINTS "f 1 2 3 4\n"}, {"t.gdf", GDF_BOX}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (failing_turn turn = {0}; failing_next(&turn);) {
            mesh_file f;
            turn.status =
                mesh_file_parse(&turn.ctx, cases[i].name, cases[i].text, strlen(cases[i].text), &f, &turn.error);
            mesh_file_free(&turn.ctx, &f);
        }
}
END_TEST

TEST_MAIN("mesh_file", tetrahedra, places, flat_facets_are_dropped, points_that_rounding_set_apart_are_one,
          only_equal_points_are_one, polygons, symmetry_planes, round_trips, files_that_cannot_be_read, memory_runs_out)
